// Checks a scene before anything is computed.
#pragma once

#include <string_view>

#include "scene.h"

namespace pbd {

/// Largest coefficient of friction: beyond, rounding of mu |u_T| hides u_N in Coulomb's law.
inline constexpr double most_friction = 1e7;

/// Least mass (kg): products of lighter ones underflow.
inline constexpr double least_mass = 1e-100;

/// Largest speed at the start (m/s): beyond, rounding of a velocity exceeds 1 m/s.
inline constexpr double most_speed = 1e15;

/// Largest ratio of finite masses: beyond, what a step misses at the light ones is rounding beside the heavy
/// ones.
inline constexpr double most_mass_ratio = 1e15;

/// Least step (s): one over its fourth power is a number. What refuses a step spells it out.
inline constexpr double least_step = 1e-75;

/// Throws SetupError naming effect, entry, value and what is allowed: sizes that do not match, node indices
/// out of range or repeated, masses <= 0 or NaN, masses and speeds beyond the bounds above, compliances and
/// damping times < 0, non-finite numbers, degenerate or inverted rest elements, elastic constants out of
/// range, principal moments of inertia that no body has, axes that are not of length 1, links of rest length
/// 0 without compliance (their direction is undefined), anchors on nodes of infinite mass (nothing moves
/// these).
void validate(const Scene& scene);

/// Throws SetupError for a step of `scene` that is not finite or below `least_step`, for a state of another
/// size, and for quaternions whose norm is not 1. Other numbers that are not finite pass: a step from them
/// ends as diverged.
void validate(const Scene& scene, double h, const State& state);

/// Throws SetupError, beginning with `what` and the index, unless a rest tetrahedron has a positive volume
/// (or a rest triangle an area) above rounding: 1e-12 of its longest edge cubed (squared).
void require_proper(const Eigen::Matrix<double, 3, 4>& rest, std::string_view what, std::size_t index);
void require_proper(const Eigen::Matrix3d& rest, std::string_view what, std::size_t index);

}  // namespace pbd
