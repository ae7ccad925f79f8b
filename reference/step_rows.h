// The rows of a claim: which unknowns a block moves, where it is evaluated, and the forces that are told.
#pragma once

#include "step_equations.h"

namespace pbd::reference {

/// First unknown of each three coordinates of a block in turns, or -1.
inline int unknown_of(const RigidModel& model, const Block::Part& part, bool turn) {
  if (turn) return part.body < 0 ? -1 : model.rotors[static_cast<std::size_t>(part.body)].unknown;
  return model.nodes.first[static_cast<std::size_t>(part.node)];
}

/// f(unknown, offset) for each three coordinates of a block that can move.
template <class F>
void each_moving(const RigidModel& model, const Block& block, F&& f) {
  for (const Block::Part& part : block.parts) {
    if (const int i = unknown_of(model, part, false); i >= 0) f(i, part.offset);
    if (const int i = unknown_of(model, part, true); i >= 0) f(i, part.offset + 3);
  }
}

/// J W J^T h^2 + A, the matrix of a block in whose inverse what it misses is measured.
RowMatrix metric_of(const RigidModel& model, const Block& block, double h);

inline Placement placement_of(const State& state) {
  return {state.x, state.orientation, state.time};
}

/// Multipliers of all rows, in the scene's order; false if they are not as many.
inline bool gather_forces(const StepClaim& claim, const RigidModel& model, Vector& gamma) {
  std::vector<double> all;
  for (const auto& own : claim.forces) all.insert(all.end(), own.begin(), own.end());
  gamma = Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
  return gamma.size() == model.rows();
}

}  // namespace pbd::reference
