#include "step/turns.h"

#include <algorithm>
#include <numbers>

namespace pbd {
namespace {

/// Of each body: whether a row acts on its rotation that is no contact's, or a limit waits for it.
std::vector<bool> held_rotations(const StepSystem& system) {
  const Bodies& bodies = system.problem.bodies;
  std::vector<bool> held(static_cast<std::size_t>(bodies.count()), false);
  for (const Slot& slot : system.slots) {
    if (slot.source->kind().contacts) continue;
    slot.source->add_bodies_that_wait(held);
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
  const double extension = system.problem.coefficients.extension;
  constexpr double least = TurnedWay::slow;  // two that turn over each other turn by more than twice this
  const double turned = extension * bodies.largest_spin(system.at.x);
  const bool fast = std::max(d * bodies.largest_spin(system.at.v), turned) > least;
  const Configuration start = system.problem.start(), reached{system.at.x, system.at.poses, start.time};
  const auto twists_far = [&](const Slot& slot) {
    return slot.source->twists_far(h, start, reached, extension);
  };
  if (!fast && std::none_of(system.slots.begin(), system.slots.end(), twists_far)) return false;
  double turn = 0;  // rad, of a body that something holds
  if (fast) {
    const Points changed = system.at.v - system.problem.map.v_free;
    const std::vector<bool> held = held_rotations(system);
    for (int b = 0; b < bodies.count(); ++b) {
      if (!held[static_cast<std::size_t>(b)]) continue;
      turn = std::max(turn, extension * bodies.spin(b, system.at.x));
      if (d * bodies.spin(b, system.at.v) > std::numbers::pi &&
          d * bodies.spin(b, changed) > std::numbers::pi)
        return true;
    }
  }
  TurnedWay way(bodies, system.at.x, extension, turn, start.time);
  return way.places() == 0 || std::any_of(system.slots.begin(), system.slots.end(), [&](const Slot& slot) {
           return (turn > least || twists_far(slot)) && slot.source->turns_over(h, way);
         });
}

}  // namespace pbd
