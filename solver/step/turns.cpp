#include "step/turns.h"

#include <numbers>

namespace pbd {
namespace {

/// Of each body: whether a row acts on its rotation that is no contact's.
std::vector<bool> held_rotations(const StepSystem& system) {
  const Bodies& bodies = system.problem.bodies;
  std::vector<bool> held(static_cast<std::size_t>(bodies.count()), false);
  for (const Slot& slot : system.slots) {
    if (slot.source->kind().contacts) continue;
    for_each_block(slot.view(system.rows), [&](const auto& block) {
      for (const auto& columns : block.node)
        for (const int column : columns)
          if (column >= bodies.nodes()) held[static_cast<std::size_t>(column - bodies.nodes())] = true;
    });
  }
  return held;
}

}  // namespace

bool turned_round(const StepSystem& system) {
  const Bodies& bodies = system.problem.bodies;
  const double d = system.problem.map.d;
  if (!(d * bodies.largest_spin(system.at.v) > std::numbers::pi)) return false;
  const Points changed = system.at.v - system.problem.map.v_free;
  const std::vector<bool> held = held_rotations(system);
  for (int b = 0; b < bodies.count(); ++b)
    if (held[static_cast<std::size_t>(b)] && d * bodies.spin(b, system.at.v) > std::numbers::pi &&
        d * bodies.spin(b, changed) > std::numbers::pi)
      return true;
  return false;
}

}  // namespace pbd
