#include "studies/robustness/judged_worlds.h"

#include <fmt/format.h>

#include <cmath>

#include "contact_newton.h"
#include "error.h"
#include "harness/measure.h"
#include "harness/rows_of_step.h"
#include "harness/step_checks.h"
#include "harness/step_judge.h"
#include "studies/robustness/generated_world.h"

namespace pbdcheck {
namespace {

using namespace pbd;

bool is_judgeable(const World& world) {
  if (world.method.integrator != "implicit_euler") return false;
  try {
    reference::require_judged(world.scene, world.scene.initial, world.h,
                              friction_by_name(world.method.friction));
  } catch (const SetupError&) {
    return false;
  }
  return true;
}

std::vector<std::int64_t> judgeable_worlds(std::int64_t count) {
  std::vector<std::int64_t> found;
  for (std::int64_t i = 0; std::ssize(found) < count; ++i)
    if (is_judgeable(generated_world(i))) found.push_back(i);
  return found;
}

struct JudgedWorld {
  int step = 0;
  double h = 0, tolerance = 0, error_per_residual = std::nan("");
  Report report{};
  JudgedClaim judged{};

  bool ok() const { return report.status == Status::ok; }
  /// What the tolerances of both leave, of the step's scale.
  double allowed() const { return error_per_residual * (tolerance + judged.reference.residual); }
};

JudgedWorld judged_step_of(std::int64_t index) {
  const World world = generated_world(index);
  constexpr std::int64_t first_steps = 4;
  JudgedWorld each{static_cast<int>(1 + index % first_steps), world.h, world.method.tolerance};
  Workspace workspace(world.scene, world.method);
  State state = world.scene.initial, begun = state;
  for (int k = 0; k < each.step && each.report.status != Status::diverged; ++k) {
    begun = state;
    each.report = step(workspace, world.h, state);
  }
  if (!each.ok()) return each;
  const auto claim = claim_of(world.scene, workspace, begun, state, world.h, each.report);
  each.judged = pbdcheck::judge_claim("cone_interior_point", claim);
  each.error_per_residual = error_per_residual(world.scene, begun, state, world.h, claim.friction);
  return each;
}

}  // namespace

void judge_worlds(Context& context, std::int64_t count) {
  const auto worlds = judgeable_worlds(count);
  std::vector<JudgedWorld> all(worlds.size());
  context.parallel(count, [&](std::int64_t i) {
    all[static_cast<std::size_t>(i)] = judged_step_of(worlds[static_cast<std::size_t>(i)]);
  });
  Table table =
      context.table("judged", {"world", "step", "step_s", "tolerance", "error_of_scale", "nearest_start",
                               "nearest_error_m", "nearest_error_of_scale", "allowed", "reference_status",
                               "reference_residual", "status", "reason"});
  Worst worst;
  std::int64_t judged = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const JudgedWorld& each = all[i];
    const double nearest = each.judged.nearest.of_scale;
    table.row({worlds[i], std::int64_t{each.step}, each.h, each.tolerance, each.judged.own.of_scale,
               std::string(judge_start_names[static_cast<std::size_t>(each.judged.start)]),
               each.judged.nearest.metres, nearest, each.allowed(), each.judged.reference.status,
               each.judged.reference.residual,
               std::string(status_names[static_cast<std::size_t>(each.report.status)]),
               std::string(each.report.reason)});
    if (!each.ok() || std::isnan(nearest)) continue;
    ++judged;
    worst.add(nearest / each.allowed(), fmt::format("world {}, step {}", worlds[i], each.step));
  }
  table.close();
  context.verdict(
      Basis::goal, "worlds.judged",
      "a step that says ok is as near to a solution that the judge finds as linear rows would be "
      "by its tolerance",
      fmt::format(
          "distance over what the tolerances leave, of {} steps that the judge solves of {} worlds ({})",
          judged, count, worst.owner()),
      worst.value(), 1);
}

}  // namespace pbdcheck
