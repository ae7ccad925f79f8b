// What the program's users see of sources.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "geometry.h"

namespace pbd {

/// What one effect cost: rows and bytes as the last step left them, seconds of all steps so far, without
/// those of finding contacts.
struct EffectCost {
  std::string_view effect;
  std::int64_t rows = 0;
  std::int64_t bytes = 0;  // of its rows
  double seconds = 0;      // linearising, and relaxing as the first of each outer iteration's sweeps took;
                           // the sparse solvers work on all rows in common, in no effect's share: `ldlt`,
                           // `semismooth_newton`, `augmented_lagrangian`, and of them `direct`
  double contraction = 0;  // bound of the effect's own geometric stiffness over inertia, last step
};

/// How the bodies and nodes of a contact stood to each other where they met on the way of a step, in the
/// world; of a triangle and of surfaces nothing.
struct MetOnWay {
  std::array<Vec3, 2> arm{Vec3::Zero(), Vec3::Zero()};  // m, from a and b to where they touched
  std::array<Eigen::Matrix3d, 2> rotation{Eigen::Matrix3d::Identity(),
                                          Eigen::Matrix3d::Identity()};  // body to world
};

/// What a contact does at the end of a step, in the world: `force` acts on a, its opposite on b. What has met
/// on the way was pushed there, and `gap` goes on from there by the rates of bodies and surfaces' nodes.
struct ContactForce {
  std::array<int, 2> collider;  // a and b: colliders, then the effect's nodes, then (surfaces) the scene's
  Vec3 point;                   // m
  Vec3 normal;                  // from b to a
  Vec3 force;                   // N
  Vec3 slip;                    // m/s, of a against b across the normal
  double gap;                   // m
  std::optional<MetOnWay> met{};
};

/// Measures of an effect's constraints as a state has them.
struct ConstraintMeasure {
  double energy = 0;  // J, sum of 1/2 c^T A^-1 c where A > 0; with bounds, what they let it hold
  double missed = 0;  // largest |c| where A = 0, in the unit of c; as far as an unlimited force prevents it
};

}  // namespace pbd
