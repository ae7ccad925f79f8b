// Scenes with one damped oscillating coordinate whose frequency and retardation are known.
#pragma once

#include <string>

#include "scene.h"

namespace pbdcheck {

inline constexpr double spring_stiffness = 100, damping_coefficient = 1;  // N/m, N s/m, of 1 kg

/// A scene with one oscillating coordinate of `frequency` (rad/s) and `retardation` (s).
struct Oscillator {
  std::string name;
  pbd::Scene scene;
  double frequency, retardation;
  double (*coordinate)(const pbd::Scene& scene, const pbd::Points& x);
};

/// A mass of 1 kg between two walls.
Oscillator damped_springs();
/// Ten masses of 1 kg between walls in their lowest mode, x_i = sin(pi i/11), which moves like the one mass.
Oscillator damped_chain();
/// A free regular tetrahedron that breathes or shears, with moduli of elasticity and of damping of its own.
Oscillator breathing_tetrahedron();
Oscillator shearing_tetrahedron();

}  // namespace pbdcheck
