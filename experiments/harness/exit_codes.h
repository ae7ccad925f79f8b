// What the program's exit codes say.
#pragma once

namespace pbdcheck {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;  // a verdict failed, a step missed its tolerance or was refuted
inline constexpr int exit_usage = 2;
inline constexpr int exit_interrupted = 3;

}  // namespace pbdcheck
