// The energy of a pendulum (1 m, 1 kg) by each scheme at 1/60 s, and how far it leaves its circle.
#include <algorithm>
#include <cmath>

#include "harness/measure.h"
#include "scenes/standard.h"
#include "studies/time/direction.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct Swing {
  DirectionRun run;
  double squares = 0;  // sum of h^2 |v|^2, m^2
  double fastest = 0;  // m/s
  double square = 0;   // of the length at the end, m^2
};

Swing swing(const Scheme& scheme, double h, double duration, Table* table) {
  const DirectionScene scene = hard_pendulum();
  Swing found;
  int k = 0;
  struct Sample {
    double time, energy;
  };
  std::vector<Sample> samples{{0, 0}};
  found.run = simulate(scene, scheme.method, h, duration, [&](const State& state) {
    const double speed = state.v.col(1).norm();
    found.squares += h * h * speed * speed;
    found.fastest = std::max(found.fastest, speed);
    found.square = state.x.col(1).squaredNorm();
    if (++k % 3 == 0) samples.push_back({state.time, speed * speed / 2 + gravity * state.x(2, 1)});
  });
  if (table)
    for (const auto& [time, energy] : samples)
      add_row(*table, scene.name, scheme, {h, time, energy, found.run.work_per_s}, found.run);
  return found;
}

}  // namespace

void direction_energy(Context& context) {
  Table table = direction_table(context, "energy",
                                {"step_s", "time_s", "energy_j", "row_updates_per_s", "status", "reason"});
  constexpr double duration = 10;  // s
  // An explicit step's velocity is that of its middle: it lacks h/2 of the change of kinetic energy, at most
  // m g times the largest rate of fall, sqrt(2 g l cos a) sin a at cos^2 a = 1/3; the next order is smaller
  // by h sqrt(g/l).
  const double fall = std::sqrt(2 * gravity / std::sqrt(3.0)) * std::sqrt(2.0 / 3);
  const double band = direction_frame / 2 * gravity * fall * (1 + direction_frame * std::sqrt(gravity));
  Worst explicit_band, rise, leaves, stabilised;
  for (const auto& scheme : default_schemes()) {
    const Method& m = scheme.method;
    const auto [run, squares, fastest, square] = swing(scheme, direction_frame, duration, &table);
    const bool usable = run.status == Status::ok;
    const auto added = [&](double value) { return usable ? value : std::nan(""); };
    if (m.outer == "frozen") {
      if (m.stabilisation == 0) leaves.add(added(std::abs((square - 1) / squares - 1)));
      if (m.stabilisation == 1)
        stabilised.add(
            added(run.violation_largest / (direction_frame * direction_frame * fastest * fastest / 2)));
      continue;
    }
    if (m.direction_blend == 0)
      explicit_band.add(added(gravity * std::max(run.energy_highest, -run.energy_lowest)));
    if (m.direction_blend == 1) rise.add(added(run.largest_rise));
  }
  table.close();
  const double tolerance = Method{}.tolerance;
  context.verdict(Basis::theory, "direction.explicit_energy",
                  "explicit directions keep the pendulum's energy in the band of velocities half a step late",
                  "largest change (J)", explicit_band.value(), band);
  // The link pulls all the time; then a step changes the energy by -m |v_l+1 - v_l|^2/2 - T l (1 -
  // cos(turn)).
  context.verdict(Basis::theory, "direction.implicit_energy",
                  "implicit directions let the pendulum's energy fall every step",
                  "largest rise in a step, of m g l", rise.value(), tolerance);
  context.verdict(
      Basis::theory, "direction.velocity_leaves",
      "velocity time stepping leaves the circle: the square of the length grows by (h v)^2 a step",
      "|growth/sum of (h v)^2 - 1|", leaves.value(), 1e-10);
  context.verdict(Basis::theory, "direction.velocity_stabilised",
                  "stabilised in full, velocity time stepping violates the link by (h v)^2/2 l, a step's own",
                  "largest violation over (h v)^2/2 l of the fastest step", stabilised.value(), 1);
}

}  // namespace pbdcheck
