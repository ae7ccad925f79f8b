#include "step/turns.h"

#include <algorithm>
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
  const double d = system.problem.map.d, h = system.problem.map.h;
  for (const Slot& slot : system.slots)
    if (slot.source->drives_round(h)) return true;
  constexpr double least = 1;  // rad: two that turn over each other turn by more than twice this
  const bool fast = std::max(d * bodies.largest_spin(system.at.v), bodies.largest_spin(system.at.x)) > least;
  const auto has_period = [](const Slot& slot) { return slot.source->has_period(); };
  if (!fast && std::none_of(system.slots.begin(), system.slots.end(), has_period)) return false;
  double turn = 0;  // rad, of a body that something holds
  if (fast) {
    const Points changed = system.at.v - system.problem.map.v_free;
    const std::vector<bool> held = held_rotations(system);
    for (int b = 0; b < bodies.count(); ++b) {
      if (!held[static_cast<std::size_t>(b)]) continue;
      turn = std::max(turn, bodies.spin(b, system.at.x));
      if (d * bodies.spin(b, system.at.v) > std::numbers::pi &&
          d * bodies.spin(b, changed) > std::numbers::pi)
        return true;
    }
  }
  TurnedWay way(bodies, system.at.x, turn, system.problem.start_time);
  return way.places() == 0 || std::any_of(system.slots.begin(), system.slots.end(), [&](const Slot& slot) {
           return (turn > least || has_period(slot)) && slot.source->turns_over(h, way);
         });
}

}  // namespace pbd
