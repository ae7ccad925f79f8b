// Rigid bodies with a formula. Angular velocities are in the body's frame (rad/s), moments of inertia
// principal ones (kg m^2); g is a positive acceleration (m/s^2).
//
// A torque-free body keeps 2 T = sum I w^2 and L^2 = sum I^2 w^2. Its w circles the axis of least or largest
// moment, index 3 below, 2 the middle moment's and 1 the last:
//   w = (a1 cn, +-a2 sn, +-a3 dn)(rate t + phase),  a_i^2 = (L^2 - 2 T I_k)/(I_i (I_i - I_k)), k = 3 for
//   i = 1, 2 and k = 1 for i = 3,   rate^2 = (I3 - I2) (L^2 - 2 T I1)/(I1 I2 I3)
// of parameter m = a1^2 I1 (I2 - I1)/(a3^2 I3 (I3 - I2)) (landau1976mechanics, section 37).
#pragma once

#include "scene.h"

namespace pbd::reference {

/// Angular velocity at `time` (s) of a torque-free body; the moments in any order, equal ones allowed. Near
/// the separatrix its phase is right to 1e-16/(1 - m) of a period.
Vec3 free_body_spin(const Vec3& inertia, const Vec3& spin, double time);
/// Period 4 K/rate of that; infinite where the angular velocity is constant or on the separatrix.
double free_body_period(const Vec3& inertia, const Vec3& spin);
/// Of a symmetric body, I1 = I2: rates at which w circles the axis in the body, (I3 - I1)/I1 w3, and the axis
/// circles the angular momentum in space, L/I1.
double body_precession(double across, double along, const Vec3& spin);
double space_precession(double across, double along, const Vec3& spin);

/// Symmetric body on a fixed point of its axis: moments there across and along the axis, m g times the
/// centre's distance.
struct HeavyTop {
  double across, along;  // kg m^2
  double weight_moment;  // N m
};
/// Least spin about the upright axis at which it sleeps: 2 sqrt(across m g l)/along, rad/s.
double sleeping_spin(const HeavyTop& top);
/// Steady precession at a tilt (rad) from the upright and a spin w3 (rad/s) about the axis: roots of
/// across cos(tilt) W^2 - along w3 W + m g l = 0, rad/s. Throws std::runtime_error where there is none.
struct Precession {
  double slow, fast;
};
Precession steady_precession(const HeavyTop& top, double tilt, double spin);

/// Equivalent length I/(m d) (m) of a uniform rod about its end: 2 l/3, the length of the mathematical
/// pendulum it moves as.
double rod_pendulum_length(double length);
/// Rate at the horizontal of a rod let fall upright about its end: sqrt(3 g/l), rad/s.
double falling_rod_rate(double length, double g);

/// A pendulum of equivalent length l that goes over the top, with rate `top` (rad/s) there at time 0:
/// sin(angle/2) = sn, angle from the lowest point; its direction after `time`.
struct Direction {
  double sine, cosine;  // of the angle from the lowest point
  double rate;          // rad/s
};
Direction circling_pendulum(double length, double g, double top, double time);

}  // namespace pbd::reference
