// Seconds that parts of a step take.
#pragma once

#include <chrono>

namespace pbd::rivals {

using Clock = std::chrono::steady_clock;

inline double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Adds the time that `work` takes to `seconds`.
template <class Work>
void timed(double& seconds, const Work& work) {
  const auto start = Clock::now();
  work();
  seconds += since(start);
}

}  // namespace pbd::rivals
