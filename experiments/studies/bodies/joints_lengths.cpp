// What a chain of bodies costs over its length.
#include <algorithm>
#include <cmath>
#include <ctime>

#include "harness/order_fit.h"
#include "linear/linear_names.h"
#include "scenes/mechanisms.h"
#include "step/step.h"
#include "studies/bodies/joints.h"

namespace pbdcheck {

using namespace pbd;

/// Processor's seconds a step of a chain of bodies at four linearisations of one sweep each (fewer where
/// only rounding is left), and for one of these; at so small a step that the solver needs no estimate of
/// plain's contraction, whose sweeps would count.
void joint_lengths(Context& context) {
  constexpr double h = 1e-4;  // s
  const std::vector<int> counts{50, 200, 800, 3200};
  Table table = context.table("lengths", {"relaxation", "bodies", "cpu_s_per_step", "cpu_s_per_sweep",
                                          "exponent_step", "exponent_sweep", "status", "reason"});
  for (const auto relaxation : general_solver_names()) {
    std::vector<double> size, step_time, sweep_time;
    for (const int count : counts) {
      const Scene scene = rod_chain(count);
      Method method;
      method.relaxation = relaxation;
      method.outer = "plain";
      method.tolerance = 0;
      method.max_outer = 4;
      method.max_sweeps = 1;
      double step_best = infinity, sweep_best = infinity;
      Workspace workspace(scene, method);
      for (int repeat = 0; repeat < 6; ++repeat) {
        State state = scene.initial;
        const std::clock_t start = std::clock();
        const Report report = step(workspace, h, state);
        const double spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        if (repeat == 0) continue;  // the memory is touched for the first time
        step_best = std::min(step_best, spent);
        sweep_best =
            std::min(sweep_best, spent / static_cast<double>(std::max<std::int64_t>(report.sweeps, 1)));
        if (report.status == Status::diverged) step_best = sweep_best = std::nan("");
      }
      size.push_back(count);
      step_time.push_back(step_best);
      sweep_time.push_back(sweep_best);
    }
    const double by_step = fitted_order(size, step_time), by_sweep = fitted_order(size, sweep_time);
    for (std::size_t i = 0; i < size.size(); ++i)
      table.row({std::string(relaxation), static_cast<std::int64_t>(size[i]), step_time[i], sweep_time[i],
                 by_step, by_sweep, std::string(std::isnan(step_time[i]) ? "diverged" : "ok"),
                 std::string("fixed work")});
    context.verdict("joints.linear." + std::string(relaxation),
                    "a linearisation of a chain, and a sweep, cost time linear in its length",
                    "exponent from 50 to 3200 bodies", by_sweep, 1.1);
  }
  table.close();
}

}  // namespace pbdcheck
