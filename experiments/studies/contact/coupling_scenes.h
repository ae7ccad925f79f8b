// Scenes of `coupling`. SI units, z up.
#pragma once

#include "scene.h"

namespace pbdcheck {

/// Of the soft cubes, m, kg; and the speed at which things meet, m/s.
inline constexpr double cube_size = 0.2, cube_mass = 8, impact_speed = 1;

/// A ball of `ratio` times the mass of a free soft cube strikes it askew and turning, without gravity.
pbd::Scene ball_strikes_cube(double ratio);

/// Two free soft cubes of different stiffness strike each other off centre, without gravity.
pbd::Scene cubes_meet();

/// A plate, body 1 and node 1, is pressed on a cube on the ground by `share` of Young's modulus times its
/// face, without friction or gravity: the stress is uniform.
pbd::Scene pressed_cube(pbd::Strain strain, double poisson, double share);

/// A box, body 1, of `ratio` times the cube's mass lies on it, and it on the ground. Both together press it
/// by about that strain.
pbd::Scene box_on_cube(double ratio, double strain);

/// A rope of hard links lies half round a cylinder, `arc` links on it and as many hanging on each side, and
/// is pulled at its ends by 1 N and by `pull`; the last node is pulled by that. Without gravity.
pbd::Scene rope_on_cylinder(int arc, double friction, double pull);

}  // namespace pbdcheck
