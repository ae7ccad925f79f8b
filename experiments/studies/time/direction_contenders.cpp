// The taut chain beyond its explicit limit, by directions of the step's begin, refreshed ones, and refreshed
// ones with a bound of the geometric stiffness added to M.
#include <cmath>

#include "studies/time/direction.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Refreshed directions, in `iterations` outer iterations at most.
Scheme refreshed(std::string_view family, std::string_view outer, int iterations) {
  Scheme scheme{std::string(family)};
  scheme.method.outer = outer;
  scheme.method.relaxation = "direct";
  scheme.method.max_outer = iterations;
  return scheme;
}

std::vector<Scheme> contenders() {
  return {velocity_schemes().back(), refreshed("position", "plain", 200),
          refreshed("stiffness, one linearisation", "proximal", 1), refreshed("stiffness", "proximal", 4000)};
}

}  // namespace

void direction_contenders(Context& context) {
  Table table = direction_table(context, "contenders",
                                {"step_s", "of_explicit_limit", "energy_highest", "energy_end", "error",
                                 "row_updates_per_s", "missed_steps", "steps", "status", "reason"});
  const double limit = 2 / TautChain::frequency(TautChain::links);
  const DirectionScene scene = taut_chain(1e-4);
  for (const Scheme& scheme : contenders())
    for (const double share : {0.25, 0.45, 0.9, 1.1, 2.0, 4.0, 8.0}) {
      const double h = share * limit;
      const DirectionRun run = simulate(scene, scheme.method, h, (context.full() ? 400 : 100) * h);
      add_row(table, scene.name, scheme,
              {h, share, run.energy_highest, run.energy_end, run.violation_largest, run.work_per_s,
               std::int64_t{run.missed}, std::int64_t{run.steps}},
              run);
    }
  table.close();
}

}  // namespace pbdcheck
