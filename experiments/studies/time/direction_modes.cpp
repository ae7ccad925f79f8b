// What a step leaves of the energy of the taut chain's modes: 1/(1 + b h^2 w^2) of it.
#include <cmath>

#include "harness/measure.h"
#include "studies/time/direction.h"

namespace pbdcheck {

using namespace pbd;

void direction_modes(Context& context) {
  Table table = direction_table(
      context, "modes",
      {"mode", "step_s", "predicted_left", "measured_left", "error", "row_updates", "status", "reason"});
  constexpr double amplitude = 1e-6;  // m
  constexpr double slope = 2 * amplitude / TautChain::length;
  Worst worst;
  for (const auto& scheme : default_schemes())
    for (const int mode : {5, 10, 20}) {
      const double w = TautChain::frequency(mode), h = 1 / w;
      DirectionScene scene = taut_chain(0);
      for (int node = 1; node <= TautChain::links; ++node)
        scene.scene.initial.v.col(node) = amplitude * w * TautChain::shape(mode, node);
      scene.energy_scale = 1;  // the start has none of its own
      Method method = scheme.method;
      method.tolerance = 1e-12;
      std::vector<double> q;
      const DirectionRun run = simulate(scene, method, h, 4 * h, [&](const State& state) {
        q.push_back(TautChain::coordinate(mode, state.x));
      });
      const double predicted = 1 / (1 + method.direction_blend);
      const double left =
          q.size() < 4 ? std::nan("") : (q[3] * q[1] - q[2] * q[2]) / (q[2] * q[0] - q[1] * q[1]);
      const double error = std::abs(left / predicted - 1);
      worst.add(run.status == Status::ok ? error : std::nan(""));
      add_row(
          table, scene.name, scheme,
          {std::int64_t{mode}, h, predicted, left, error, std::int64_t(std::llround(run.work_per_s * 4 * h))},
          run);
    }
  table.close();
  // N links that turn by `slope` shorten by N d slope^2/2; that pulls N masses within h = sqrt(m d/T)/2 or
  // more, and so changes the tension by 2 N^2 slope^2 of it.
  context.verdict(Basis::theory, "direction.mode",
                  "a step leaves 1/(1 + b h^2 w^2) of a mode's energy, all of it where b = 0",
                  "largest |measured/predicted - 1|", worst.value(),
                  2 * TautChain::links * TautChain::links * slope * slope);
}

}  // namespace pbdcheck
