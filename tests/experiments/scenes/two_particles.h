// What scenes with a mistake begin with.
#pragma once

#include <string>

namespace pbdcheck::test {

/// Lines 1 to 9 of a scene.
inline const std::string two_particles = R"([[particle]]
position_m = [0, 0, 0]
mass_kg = 1
[[particle]]
position_m = [1, 0, 0]
mass_kg = 1
[step]
step_s = 0.01
steps = 2
)";

/// The rest of a dotted key.
inline std::string deep(int parts) {
  std::string text;
  for (int i = 0; i < parts; ++i) text += ".\"b.c\"";
  return text;
}

}  // namespace pbdcheck::test
