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

/// True if a joint is open far on the way. Two bodies that turn steadily half a turn over each other open it
/// by more than 60 degrees for a third of the half turn, in which they turn against each other by 60: places
/// are looked at between which each turns by less than half of that. What turns so far that there would be
/// too many counts as turned over.
bool turned_over(const StepSystem& system, double turn) {
  constexpr double apart = 0.5;  // rad
  constexpr int fewest = 16, most = 10000;
  if (!(turn < most * apart)) return true;
  const int places = std::max(fewest, static_cast<int>(turn / apart) + 1);
  const Bodies& bodies = system.problem.bodies;
  std::vector<Pose> start, pose;
  const Points at_start = 0 * system.at.x;
  bodies.place(at_start, start);
  for (int k = 1; k < places; ++k) {
    const Points x =
        static_cast<double>(k) / places * system.at.x;  // of rotations, which are zero as a step begins
    bodies.place(x, pose);
    const Configuration begin{at_start, start, 0}, between{x, pose, 0};
    if (std::any_of(system.slots.begin(), system.slots.end(),
                    [&](const Slot& slot) { return slot.source->turns_over(begin, between); }))
      return true;
  }
  return false;
}

}  // namespace

bool turned_round(const StepSystem& system) {
  const Bodies& bodies = system.problem.bodies;
  const double d = system.problem.map.d, h = system.problem.map.h;
  for (const Slot& slot : system.slots)
    if (slot.source->drives_round(h)) return true;
  constexpr double least = 1;  // rad: two that turn over each other turn by more than twice this
  if (!(std::max(d * bodies.largest_spin(system.at.v), bodies.largest_spin(system.at.x)) > least))
    return false;
  const Points changed = system.at.v - system.problem.map.v_free;
  const std::vector<bool> held = held_rotations(system);
  double turn = 0;  // rad, of a body that something holds
  for (int b = 0; b < bodies.count(); ++b) {
    if (!held[static_cast<std::size_t>(b)]) continue;
    turn = std::max(turn, bodies.spin(b, system.at.x));
    if (d * bodies.spin(b, system.at.v) > std::numbers::pi && d * bodies.spin(b, changed) > std::numbers::pi)
      return true;
  }
  return turn > least && turned_over(system, turn);
}

}  // namespace pbd
