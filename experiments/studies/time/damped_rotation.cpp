// A pair of masses of 1 kg on a damped spring of 1 m drifts and spins: damping ends its vibration, and the
// energies of drift and of the steady rotation with its angular momentum stay.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "harness/measure.h"
#include "studies/time/damped.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using reference::OscillatorRule;

constexpr double spin = 2, drift = 3;  // rad/s, m/s
constexpr double spring = 400;         // N/m: the pair vibrates with sqrt(2 * 400) = 28 rad/s

/// Turning about its centre at `spin`, as long as it stays so, or at rest length, which makes it vibrate.
Scene spinning_pair(double retardation, bool steady) {
  // k (l - 1) = spin^2 l/2
  const double length = steady ? 1 / (1 - spin * spin / (2 * spring)) : 1;
  Scene scene;
  for (const double side : {-1.0, 1.0})
    add_node(scene, Vec3(side * length / 2, 0, 0), 1, Vec3(drift, side * spin * length / 2, 0));
  Distance link{.node = {{0, 1}}, .rest_length = {1}, .compliance = {1 / spring}};
  if (retardation > 0) link.damping = {retardation};
  scene.effects.emplace_back(std::move(link));
  return scene;
}

struct Energies {
  double total, drift, rotation;  // J: all, of the centre, of the steady rotation with the same momentum
};

Energies energies(const State& state) {
  const Vec3 arm = state.x.col(1) - state.x.col(0), turning = state.v.col(1) - state.v.col(0);
  const Vec3 centre = (state.v.col(0) + state.v.col(1)) / 2;
  const double momentum = arm.cross(turning).norm() / 2;  // of the reduced mass 1/2 kg
  double length = 1;                                      // spring (length - 1) = momentum^2/(length^3/2)
  for (int k = 0; k < 50; ++k) length = 1 + 2 * momentum * momentum / (spring * std::pow(length, 3));
  const auto elastic_energy = [](double at) { return spring * (at - 1) * (at - 1) / 2; };
  return {state.v.squaredNorm() / 2 + elastic_energy(arm.norm()), centre.squaredNorm(),
          momentum * momentum / (length * length) + elastic_energy(length)};
}

struct Spun {
  double vibration = 0, rotation = 0, drift_change = 0;  // J
};

Spun spun(Table& table, const OscillatorRule& rule, double retardation, bool steady, double h) {
  const Scene scene = spinning_pair(retardation, steady);
  Method method = oscillator_method(rule);
  method.tolerance = 1e-12;
  Workspace workspace(scene, method);
  State state = scene.initial;
  const Energies before = energies(state);
  Report worst;
  std::int64_t row_updates = 0;
  Spun found;
  const int steps = static_cast<int>(std::lround(1 / h));
  for (int k = 0; k <= steps; ++k) {
    const auto [total, centre, rotation] = energies(state);
    found = {total - centre - rotation, rotation, std::abs(centre - before.drift)};
    if (k % std::max(1, steps / 200) == 0 || k == steps)
      table.row({steady ? "steady" : "vibrating", label(rule), method.outer, method.relaxation, h,
                 retardation, h * k, found.vibration, rotation, centre, row_updates,
                 std::string(status_names[static_cast<std::size_t>(worst.status)]),
                 std::string(worst.reason)});
    const Report report = step(workspace, h, state);
    row_updates += report.row_updates;
    if (report.status > worst.status) worst = report;
  }
  if (worst.status != Status::ok) found = {std::nan(""), std::nan(""), std::nan("")};
  return found;
}

}  // namespace

void damped_rotation(Context& context) {
  constexpr double h = 1e-3, retardation = 0.025;  // decays with 20 per second: e^-20 in amplitude
  Table table = context.table(
      "rotation", {"scene", "integrator", "outer", "relaxation", "step_s", "retardation_s", "time_s",
                   "vibration_j", "rotation_j", "drift_j", "row_updates", "status", "reason"});
  // A step's rule meets velocities and positions up to h w/2 apart: in energy the square of that.
  constexpr double turn = h * spin;
  const double rotation = energies(spinning_pair(0, true).initial).rotation;
  Worst kept, same, centre;
  for (const auto& rule : reference::oscillator_rules()) {
    const Spun damped = spun(table, rule, retardation, false, h);
    spun(table, rule, 0, false, h);
    const Spun steady = spun(table, rule, retardation, true, h);
    const Spun free = spun(table, rule, 0, true, h);
    kept.add(std::abs(damped.vibration) / rotation);
    same.add(std::abs(steady.vibration - free.vibration) / rotation);
    same.add(std::abs(steady.rotation - free.rotation) / rotation);
    for (const auto& each : {damped, steady, free}) centre.add(each.drift_change / (drift * drift));
  }
  table.close();
  context.verdict(Basis::theory, "damping.rotation",
                  "damping ends a vibration and leaves the energy of the rotation",
                  "largest energy beside that of the rotation, of it", kept.value(), turn * turn);
  context.verdict(
      Basis::theory, "damping.steady",
      "a steady rotation keeps with damping the energies of rotation and vibration that it keeps without",
      "largest difference of either energy, of the rotation's", same.value(), turn * turn);
  context.verdict(Basis::theory, "damping.translation", "damping takes nothing of a translation",
                  "largest relative change of its energy", centre.value(), 1e-12);
}

}  // namespace pbdcheck
