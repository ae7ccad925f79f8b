// Random scenes by the default method with each relaxation: nothing may break, and a step that says ok must
// be one by the judge's own residual (reference/residual.h).
#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "harness/judges.h"
#include "harness/measure.h"
#include "linear/linear_names.h"
#include "studies/experiments.h"
#include "studies/robustness/gates.h"
#include "studies/robustness/generated.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// One step of one scene by one relaxation.
struct Solved {
  std::string relaxation;
  Report report;
  bool finite = true;
  std::string thrown;            // what the step threw; empty if nothing
  double judged = std::nan("");  // the judge's residual as part of the step's scale
  double claim = std::nan("");   // and as part of what status ok allows
  double error = std::nan("");   // against primal_newton, see relative_error

  std::string status() const {
    return thrown.empty() ? std::string(status_names[static_cast<std::size_t>(report.status)]) : "diverged";
  }
  std::string reason() const { return thrown.empty() ? std::string(report.reason) : thrown; }
  bool says_ok() const { return thrown.empty() && report.status == Status::ok; }
  bool false_claim() const { return says_ok() && !(claim <= 1); }
};

void judge_claim(const Case& each, const Method& method, const State& end, Solved& solved) {
  const auto found = reference::residual_of(each.scene, each.scene.initial, each.h, end);
  solved.judged = found.scale > 0 ? found.residual / found.scale : found.residual;
  solved.claim = claim_share(found, method.tolerance);
}

Solved solve_scene(const Case& each, std::string_view relaxation, const std::optional<Judged>& exact) {
  Solved solved;
  solved.relaxation = relaxation;
  Method method;
  method.relaxation = relaxation;
  State end = each.scene.initial;
  try {
    Workspace workspace(each.scene, method);
    solved.report = step(workspace, each.h, end);
    solved.finite = end.x.allFinite() && end.v.allFinite();
    if (solved.finite && solved.report.status != Status::diverged) judge_claim(each, method, end, solved);
  } catch (const std::exception& thrown) {
    solved.thrown = thrown.what();
  }
  if (exact) solved.error = relative_error(end.x, exact->x, each.scene.initial.x);
  return solved;
}

struct Tally {
  std::int64_t steps = 0;
  double largest_claim = 0;
};

}  // namespace

void generated_scenes(Context& context) {
  const std::int64_t count = context.full() ? 5000 : 500, compared = context.full() ? 200 : 40;
  const auto relaxations = general_solver_names();
  context.begin(count);
  std::vector<std::vector<Solved>> all(static_cast<std::size_t>(count));
  std::vector<std::string> judge_says(all.size());
  std::mutex mutex;
  context.parallel(count, [&](std::int64_t i) {
    const Case each = generated_case(i);
    std::optional<Judged> exact;
    if (i % (count / compared) == 0) {
      exact = judge_step("primal_newton", each.scene, each.scene.initial, each.h);
      judge_says[static_cast<std::size_t>(i)] = exact->status;
    }
    for (const auto relaxation : relaxations)
      all[static_cast<std::size_t>(i)].push_back(solve_scene(each, relaxation, exact));
    const std::lock_guard lock(mutex);
    context.advance(each.name);
  });

  Table sample = context.table(
      "sample", {"scene", "nodes", "step_s", "outer", "relaxation", "outer_iterations", "sweeps", "residual",
                 "residual_judged", "claim", "error", "reference_status", "status", "reason"});
  std::map<std::array<std::string, 3>, Tally> tallies;
  double not_finite = 0, thrown = 0, false_claims = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const Solved& solved : all[i]) {
      not_finite += !solved.finite;
      thrown += !solved.thrown.empty();
      false_claims += solved.false_claim();
      Tally& tally = tallies[{solved.relaxation, solved.status(), solved.reason()}];
      ++tally.steps;
      if (!std::isnan(solved.claim)) tally.largest_claim = std::max(tally.largest_claim, solved.claim);
      if (judge_says[i].empty() && !solved.false_claim()) continue;
      const Case each = generated_case(static_cast<std::int64_t>(i));
      sample.row({each.name, std::int64_t{each.scene.nodes()}, each.h, Method{}.outer, solved.relaxation,
                  std::int64_t{solved.report.outer_iterations}, solved.report.sweeps,
                  solved.report.residual(), solved.judged, solved.claim, solved.error, judge_says[i],
                  solved.status(), solved.reason()});
    }
  Table outcomes = context.table("outcomes", {"relaxation", "steps", "claim_largest", "status", "reason"});
  for (const auto& [key, tally] : tallies)
    outcomes.row({key[0], tally.steps, tally.largest_claim, key[1], key[2]});

  const auto of = fmt::format(" of {} steps", count * std::ssize(relaxations));
  context.verdict(Basis::robustness, "generated.finite", "no state ceases to be finite", "states" + of,
                  not_finite, 0);
  context.verdict(Basis::robustness, "generated.throws", "no step throws", "throws" + of, thrown, 0);
  context.verdict(Basis::robustness, "generated.claims",
                  "no step says ok where the judge's residual is larger than ok allows", "false claims" + of,
                  false_claims, 0);
  sample.close();
  outcomes.close();
}

}  // namespace pbdcheck
