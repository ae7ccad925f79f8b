// What the program's users see of sources.
#pragma once

#include <array>
#include <cstdint>
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

/// What a contact does at the end of a step, in the world: `force` acts on a, its opposite on b.
struct ContactForce {
  std::array<int, 2> collider;  // a and b: colliders, then the effect's nodes, then (surfaces) the scene's
  Vec3 point;                   // m
  Vec3 normal;                  // from b to a
  Vec3 force;                   // N
  Vec3 slip;                    // m/s, of a against b across the normal
  double gap;                   // m
};

/// Measures of an effect's constraints as a state has them.
struct ConstraintMeasure {
  double energy = 0;  // J, sum of 1/2 c^T A^-1 c where A > 0; with bounds, what they let it hold
  double missed = 0;  // largest |c| where A = 0, in the unit of c; as far as an unlimited force prevents it
};

}  // namespace pbd
