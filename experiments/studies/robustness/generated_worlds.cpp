// Random scenes of everything, each by a method of its own. Code that shares nothing with the solver's rows
// judges every step that says ok. The first step is made again of the same scene turned, mirrored, in other
// units, in another order and by other methods: it has to end alike, unless it turns a body so far that it
// may have several solutions.
#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "error.h"
#include "harness/processor_time.h"
#include "harness/step_checks.h"
#include "studies/experiments.h"
#include "studies/robustness/judged_worlds.h"
#include "studies/robustness/same_step.h"
#include "validate.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr int steps = 8;  // of each scene

// rad: a body that turns by less in a step is turned nearly as its linearisation says; by more, and a step's
// equations may well have several solutions.
constexpr double large_turn = 0.5;

struct Refutation {
  std::string variant;
  int step;
  reference::Finding finding;
};

struct Outcome {
  std::string refused, thrown;
  bool finite = true;
  std::array<int, status_names.size()> ended{};
  std::vector<Refutation> refuted;
  double slowest = 0;  // s of the processor, of a step
  std::vector<Comparison> compared;
};

void simulate(const World& world, Outcome& outcome) {
  Workspace workspace(world.scene, world.method);
  State state = world.scene.initial;
  StepChecks checks;
  for (int k = 1; k <= steps; ++k) {
    const State begun = state;
    const double start = processor_seconds();
    const Report report = step(workspace, world.h, state);
    outcome.slowest = std::max(outcome.slowest, processor_seconds() - start);
    ++outcome.ended[static_cast<std::size_t>(report.status)];
    outcome.finite = outcome.finite && state.x.allFinite() && state.v.allFinite() && state.spin.allFinite();
    const bool flies = !(state.v.cwiseAbs().maxCoeff() <= most_speed);  // no scene may begin so
    if (!outcome.finite || flies || report.status == Status::diverged) break;
    checks.add(k, claim_of(world.scene, workspace, begun, state, world.h, report), report.status, false);
  }
  for (const auto& [k, finding] : checks.refuted())
    outcome.refuted.push_back({"as it is", static_cast<int>(k), finding});
}

Outcome outcome_of(std::int64_t index) {
  Outcome outcome;
  const World world = generated_world(index);
  try {
    simulate(world, outcome);
    const FirstStep own = first_step(world.scene, world.method, world.h);
    Random random(seed + static_cast<std::uint64_t>(index));
    for (const Variant& variant : variants_of(world, random)) {
      outcome.compared.push_back(compare(world, own, variant));
      for (const auto& finding : outcome.compared.back().refuted)
        outcome.refuted.push_back({variant.name, 1, finding});
    }
  } catch (const SetupError& refused) {
    outcome.refused = refused.what();
  } catch (const std::exception& thrown) {
    outcome.thrown = thrown.what();
  }
  return outcome;
}

}  // namespace

void generated_worlds(Context& context) {
  const std::int64_t count = context.full() ? 20000 : 500;
  context.begin(count);
  std::vector<Outcome> all(static_cast<std::size_t>(count));
  std::mutex mutex;
  context.parallel(count, [&](std::int64_t i) {
    all[static_cast<std::size_t>(i)] = outcome_of(i);
    const std::lock_guard lock(mutex);
    context.advance(fmt::format("world {}", i));
  });

  Table refuted = context.table("refuted", {"world", "variant", "step", "check", "what", "number", "bound"});
  Table broken = context.table("broken", {"world", "kind", "reason"});
  Table ends = context.table("ends", {"status", "steps"});
  Table apart = context.table("apart", {"world", "variant", "difference", "turn_rad", "outcome"});
  Table agreement = context.table("agreement", {"variant", "first_steps", "outcome"});
  std::array<std::int64_t, status_names.size()> ended{};
  std::map<std::pair<std::string, Agreement>, std::int64_t> agreements;
  double refutations = 0, not_finite = 0, thrown = 0, refused = 0, unexplained = 0;
  std::pair<double, std::int64_t> slowest{0, 0};  // s, and its world
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Outcome& outcome = all[i];
    const auto world = static_cast<std::int64_t>(i);
    for (const auto& [variant, at, finding] : outcome.refuted)
      refuted.row(
          {world, variant, std::int64_t{at}, finding.check, finding.what, finding.number, finding.bound});
    refutations += outcome.refuted.empty() ? 0 : 1;
    if (!outcome.refused.empty()) broken.row({world, "refused", outcome.refused}), ++refused;
    if (!outcome.thrown.empty()) broken.row({world, "thrown", outcome.thrown}), ++thrown;
    if (!outcome.finite) broken.row({world, "not finite", ""}), ++not_finite;
    for (std::size_t k = 0; k < ended.size(); ++k) ended[k] += outcome.ended[k];
    slowest = std::max(slowest, {outcome.slowest, world});
    for (const Comparison& each : outcome.compared) {
      ++agreements[{each.variant, each.agreement}];
      if (each.agreement == Agreement::same || each.agreement == Agreement::missed) continue;
      apart.row({world, each.variant, each.apart, each.turn,
                 agreement_names[static_cast<std::size_t>(each.agreement)]});
      unexplained += each.agreement != Agreement::conditioning && !(each.turn > large_turn);
    }
  }
  for (std::size_t k = 0; k < ended.size(); ++k) ends.row({std::string(status_names[k]), ended[k]});
  for (const auto& [key, first_steps] : agreements)
    agreement.row({key.first, first_steps, agreement_names[static_cast<std::size_t>(key.second)]});

  const auto of = fmt::format(" of {} scenes", count);
  context.verdict(Basis::code, "worlds.refuted",
                  "no step that says ok is refuted by code that shares nothing with it", "refuted" + of,
                  refutations, 0);
  context.verdict(Basis::robustness, "worlds.finite", "no state ceases to be finite", "states" + of,
                  not_finite, 0);
  context.verdict(Basis::robustness, "worlds.throws", "no step throws", "throws" + of, thrown, 0);
  context.verdict(Basis::robustness, "worlds.refused", "no scene is refused", "refused" + of, refused, 0);
  context.verdict(Basis::robustness, "worlds.agree",
                  "where no body turns by half a radian, the same scene in other words or by another method "
                  "ends alike wherever both say ok",
                  "first steps that end apart and no tighter tolerance brings together", unexplained, 0);
  context.verdict(Basis::goal, "worlds.slowest", "no step takes longer than a minute",
                  fmt::format("s of the processor, the slowest step (of world {})", slowest.second),
                  slowest.first, 60);
  for (Table* table : {&refuted, &broken, &ends, &apart, &agreement}) table->close();
  judge_worlds(context, context.full() ? 200 : 20);
}

}  // namespace pbdcheck
