// What does it cost to apply friction at the end of the step? Boxes on an incline, a pushed stack and an
// arch, with friction solved within the step and with friction at its end (late_friction.h).
#include "studies/contact/late_friction.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "harness/measure.h"
#include "harness/results.h"
#include "scenes/arch.h"
#include "scenes/contacts.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double incline_angle = 20 * std::numbers::pi / 180;
constexpr double strong = 1.1;  // friction over what is needed

/// Bodies that keep their orientation: what a step does is a formula.
Scene never_turning(Scene scene) {
  for (auto& body : scene.bodies) body.inertia.setConstant(infinity);
  scene.effects.erase(scene.effects.begin() + 1);  // the gyroscopic torque
  return scene;
}

/// Two cubes on each other, the lower one pushed by `share` of what friction holds.
Scene pushed_stack(double share) {
  Scene scene = column(2);
  const double weight = (scene.mass[1] + scene.mass[2]) * gravity;
  const double friction = contact_of(scene)->law[0].friction;
  scene.effects.emplace_back(ExternalForce{{1}, {Vec3(share * friction * weight, 0, 0)}});
  return scene;
}

struct PlacedRun {
  Worst residual, penetration;
  bool solved = true;
  double moved = 0, gained = 0;  // m of any body; m/s of body 1, in the second half
  std::int64_t sweeps = 0, steps = 0;
};

PlacedRun run_placed(FrictionPlace place, const Scene& scene, double h, double duration) {
  PlacedRun run;
  State state = scene.initial;
  double half = 0;
  run.steps = std::lround(duration / h);
  for (std::int64_t k = 0; k < run.steps; ++k) {
    if (k == run.steps / 2) half = state.v.col(1).norm();
    const PlacedFriction now = step_with(place, scene, h, state);
    run.residual.add(now.residual);
    run.penetration.add(now.penetration);
    run.sweeps += now.sweeps;
    run.solved &= now.solved;
  }
  run.moved = (state.x - scene.initial.x).colwise().norm().maxCoeff<Eigen::PropagateNaN>();
  run.gained = state.v.col(1).norm() - half;
  return run;
}

constexpr double resolved = 0.01;  // of the share at which bodies begin to slide

struct Threshold {
  double share = 0;
  PlacedRun runs;  // of the two nearest to it on either side: the worst of both, and their sums
};

PlacedRun both(const PlacedRun& a, const PlacedRun& b) {
  PlacedRun all = a;
  all.residual.add(b.residual.value());
  all.penetration.add(b.penetration.value());
  all.solved = a.solved && b.solved;
  all.sweeps += b.sweeps;
  all.steps += b.steps;
  return all;
}

/// The share of friction (or push) at which the bodies begin to slide: they slide if in the second half they
/// gain half of the speed that a lack of `resolved` gives them, `acceleration` being what friction balances.
/// What friction at the end of the step leaves over is no sliding.
Threshold sliding_threshold(FrictionPlace place, const std::function<Scene(double share)>& held_by, double h,
                            double acceleration, bool grows) {
  constexpr double duration = 0.5;
  PlacedRun below, above;
  below.solved = above.solved = false;  // until there is a run
  double low = 0, high = 4;
  while (high - low > resolved / 2) {
    const double middle = (low + high) / 2;
    const PlacedRun run = run_placed(place, held_by(middle), h, duration);
    const bool slides = !(run.gained <= resolved / 2 * acceleration * duration / 2);
    (slides == grows ? high : low) = middle;
    (slides == grows ? above : below) = run;
  }
  return {(low + high) / 2, both(below, above)};
}

constexpr std::array place_names{"within", "end"};
constexpr double placed_h = 0.01;

class PlacedTable {
 public:
  explicit PlacedTable(Context& context)
      : table_(context.table(
            "motions", {"scene", "variant", "step_s", "quantity", "measured", "expected", "resolved", "unit",
                        "natural_residual", "penetration_m", "sweeps", "steps", "status", "reason"})) {}
  /// `expected`: by Coulomb's law; of what creeps with friction at the end of the step, h a.
  void add(std::string_view scene, FrictionPlace place, double h, std::string_view quantity, double measured,
           double expected, double precision, std::string_view unit, const PlacedRun& run) {
    table_.row({std::string(scene), place_names[static_cast<std::size_t>(place)], h, std::string(quantity),
                measured, expected, precision, std::string(unit), run.residual.value(),
                run.penetration.value(), run.sweeps, run.steps, run.solved ? "ok" : "not_converged",
                run.solved ? "" : "contacts are not solved"});
  }
  void close() { table_.close(); }

 private:
  Table table_;
};

}  // namespace

void late_friction(Context& context) {
  PlacedTable table(context);
  Worst held, creeps, thresholds;
  context.begin(2);
  const Scene box = sliding_box(incline_angle, strong * std::tan(incline_angle), 0);
  const double acceleration = gravity * std::sin(incline_angle);
  const double push = gravity * contact_of(column(2))->law[0].friction;  // of both cubes, by all of it
  for (const FrictionPlace place : {FrictionPlace::within, FrictionPlace::end}) {
    const bool within = place == FrictionPlace::within;
    const auto creep = [&](std::string_view name, const Scene& scene, double h, double formula) {
      constexpr double duration = 1;
      const PlacedRun run = run_placed(place, scene, h, duration);
      const double speed = run.moved / duration;
      table.add(name, place, h, "creep", speed, within ? 0 : h * formula, 0, "m/s", run);
      if (within) held.add(run.solved ? speed : std::nan(""));
      return run.solved ? speed : std::nan("");
    };
    for (const double h : {1.0 / 60, 0.01, 0.001}) {
      creep("box on an incline", box, h, acceleration);
      const double speed = creep("box that never turns", never_turning(box), h, acceleration);
      if (!within) creeps.add(std::abs(speed / (h * acceleration) - 1));
      // Without friction the lower cube alone is pushed, by half of what friction holds of both.
      creep("pushed stack", pushed_stack(0.5), h, 0.5 * 2 * push);
    }
    const Scene arch = Arch{1.2 * limit_thickness(7), 7}.scene();
    const PlacedRun stands = run_placed(place, arch, placed_h, 1);
    table.add("arch", place, placed_h, "displacement", stands.moved, 0, 0, "m", stands);

    const Threshold friction = sliding_threshold(
        place, [](double share) { return sliding_box(incline_angle, share * std::tan(incline_angle), 0); },
        placed_h, acceleration, false);
    const Threshold pushed = sliding_threshold(place, pushed_stack, placed_h, push, true);
    table.add("box on an incline", place, placed_h, "threshold", friction.share, 1, resolved, "of tan a",
              friction.runs);
    table.add("pushed stack", place, placed_h, "threshold", pushed.share, 1, resolved,
              "of the push that friction holds", pushed.runs);
    if (within)
      for (const Threshold& each : {friction, pushed})
        thresholds.add(each.runs.solved ? std::abs(each.share - 1) : std::nan(""));
    context.advance(place_names[static_cast<std::size_t>(place)]);
  }
  table.close();
  context.verdict(Basis::theory, "late_friction.within.held",
                  "with friction within the step nothing creeps that it holds", "largest creep, m/s",
                  held.value(), 1e-9);
  context.verdict(Basis::theory, "late_friction.within.threshold",
                  "with friction within the step bodies slide where Coulomb says",
                  "largest distance from the threshold, relative", thresholds.value(), resolved);
  context.verdict(Basis::theory, "late_friction.end.creep",
                  "with friction at the end of the step a box that never turns creeps by h g sin a",
                  "largest relative difference", creeps.value(), 1e-9);
}

}  // namespace pbdcheck
