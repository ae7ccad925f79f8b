// Random scenes of everything, each by a method of its own: every step that says ok is judged by code that
// shares nothing with the solver's rows, and one step of the same scene turned, mirrored, in other units, in
// another order and by other methods has to end alike, or it has several solutions.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <map>
#include <mutex>

#include <fmt/format.h>

#include "harness/step_checks.h"
#include "studies/experiments.h"
#include "studies/robustness/generated_world.h"
#include "studies/robustness/same_scene.h"
#include "studies/robustness/units.h"
#include "validate.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using SteadyClock = std::chrono::steady_clock;

constexpr int steps = 8;  // of each scene

// Two answers agree to this share of the step's scale: each meets 1e-8 of it, and a Delassus matrix of the
// condition number 1e8 in the metric of its diagonal makes sqrt(1e8) times as much of that.
constexpr double agree = 1e-4;
constexpr double rounded_speed = 1e-6;  // of the speeds: what moves on as it is has no scale
constexpr double tight = 1e-11;         // tolerance by which conditioning is told from another solution

struct Refutation {
  std::string variant;
  int step;
  reference::Finding finding;
};

/// How one variant's first step ended beside that of the scene as it is.
enum class Agreement { same, missed, conditioning, other_solution, undecided };
constexpr std::array agreement_names{"the same", "one missed", "told apart by the tolerance alone",
                                     "another solution", "not told"};

struct Comparison {
  std::string variant;
  Agreement agreement = Agreement::missed;
  double apart = 0;  // of the step's scale
};

struct Outcome {
  std::string refused, thrown;
  bool finite = true;
  std::array<int, status_names.size()> ended{};
  std::vector<Refutation> refuted;
  double slowest = 0;  // s, of a step
  std::vector<Comparison> compared;
};

/// |v_a - v_b| in the metric of masses and inertias, sqrt(J).
double velocity_distance(const Scene& scene, const State& a, const State& b) {
  double sum = 0;
  for (int node = 0; node < scene.nodes(); ++node)
    if (const double mass = scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass))
      sum += mass * (a.v.col(node) - b.v.col(node)).squaredNorm();
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const auto body = static_cast<Eigen::Index>(k);
    if (scene.bodies[k].inertia.allFinite())
      sum += scene.bodies[k].inertia.dot((a.spin.col(body) - b.spin.col(body)).cwiseAbs2());
  }
  return std::sqrt(sum);
}

/// One step of the scene from its initial state by a new workspace.
struct FirstStep {
  State end;
  Report report;
};

FirstStep first_step(const std::string& variant, const Scene& scene, const Method& method, double h,
                     Outcome& outcome) {
  Workspace workspace(scene, method);
  FirstStep first{scene.initial, {}};
  first.report = step(workspace, h, first.end);
  if (first.report.status != Status::ok) return first;
  reference::StepCheck check(scene);
  const auto claim = claim_of(scene, workspace, scene.initial, first.end, h, first.report);
  for (const auto& finding : check.judge(claim).refuted) outcome.refuted.push_back({variant, 0, finding});
  return first;
}

/// A scene that says the same, how its method differs, and what takes states to it.
struct Variant {
  std::string name;
  Scene scene;
  Method method;
  std::function<State(const State&)> to;
};

Method tightened(Method method) {
  method.tolerance = tight;
  method.max_outer = 1000;
  method.max_sweeps = 10000;
  return method;
}

Comparison compare(const World& world, const FirstStep& base, const Variant& variant, Outcome& outcome) {
  Comparison found{variant.name};
  const auto apart = [&](const FirstStep& a, const FirstStep& b) {
    State rest = b.end;
    rest.v.setZero();
    rest.spin.setZero();
    const double speed = velocity_distance(variant.scene, rest, b.end);
    return velocity_distance(variant.scene, variant.to(a.end), b.end) /
           std::max(b.report.scale, rounded_speed * speed);
  };
  const FirstStep other = first_step(variant.name, variant.scene, variant.method, world.h, outcome);
  if (base.report.status != Status::ok || other.report.status != Status::ok) return found;
  found.agreement = Agreement::same;
  found.apart = apart(base, other);
  if (!(found.apart > agree)) return found;
  found.agreement = Agreement::undecided;
  const FirstStep exact = first_step("tight", world.scene, tightened(world.method), world.h, outcome);
  const FirstStep other_exact =
      first_step(variant.name + ", tight", variant.scene, tightened(variant.method), world.h, outcome);
  if (exact.report.status != Status::ok || other_exact.report.status != Status::ok) return found;
  found.agreement = apart(exact, other_exact) > agree ? Agreement::other_solution : Agreement::conditioning;
  return found;
}

std::vector<Variant> variants_of(const World& world, Random& random) {
  const Scene& scene = world.scene;
  std::vector<Variant> all;
  const auto add = [&](const char* name, Scene same, const Method& method, auto to) {
    all.push_back({name, std::move(same), method, to});
  };
  const auto unmoved = [](const State& state) { return state; };
  // The tangents of the law box are no property of the scene: turned, it is another law.
  const Isometry turned{random.turn().toRotationMatrix(), random.vector(10)};
  const Isometry mirrored{Vec3(-1, 1, 1).asDiagonal(), Vec3::Zero()};
  for (const auto& [name, by] : {std::pair{"turned", turned}, std::pair{"mirrored", mirrored}})
    if (world.method.friction != "box")
      add(name, moved(scene, by), world.method, [by = by](const State& state) { return moved(state, by); });
  static constexpr double length = 1000, mass = 1e-3;
  add("other units", in_units(scene, length, mass), world.method, [](State state) {
    state.x *= length;
    state.v *= length;
    return state;
  });
  const Order order = any_order(scene, random);
  add("other order", reordered(scene, order), world.method,
      [order](const State& state) { return reordered(state, order); });
  Method method = world.method;
  method.relaxation = world.method.relaxation == "direct" ? "conjugate_gradients" : "direct";
  add("other linear solver", scene, method, unmoved);
  method = world.method;
  method.outer = world.method.outer == "proximal" ? "auto" : "proximal";
  add("other outer iteration", scene, method, unmoved);
  return all;
}

void simulate(const World& world, Outcome& outcome) {
  Workspace workspace(world.scene, world.method);
  State state = world.scene.initial;
  StepChecks checks;
  for (int k = 1; k <= steps; ++k) {
    const State begun = state;
    const auto start = SteadyClock::now();
    const Report report = step(workspace, world.h, state);
    outcome.slowest =
        std::max(outcome.slowest, std::chrono::duration<double>(SteadyClock::now() - start).count());
    ++outcome.ended[static_cast<std::size_t>(report.status)];
    outcome.finite = outcome.finite && state.x.allFinite() && state.v.allFinite() && state.spin.allFinite();
    // No scene may begin so fast, and nothing that spins so has an orientation.
    const bool flies =
        !(state.v.cwiseAbs().maxCoeff() <= most_speed) || !(state.spin.cwiseAbs().maxCoeff() <= most_speed);
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
    const FirstStep base = first_step("cold", world.scene, world.method, world.h, outcome);
    Random random(seed + static_cast<std::uint64_t>(index));
    for (const Variant& variant : variants_of(world, random))
      outcome.compared.push_back(compare(world, base, variant, outcome));
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
  Table apart = context.table("apart", {"world", "variant", "difference", "outcome"});
  Table agreement = context.table("agreement", {"variant", "first_steps", "outcome"});
  std::array<std::int64_t, status_names.size()> ended{};
  std::map<std::pair<std::string, Agreement>, std::int64_t> agreements;
  double refutations = 0, not_finite = 0, thrown = 0, refused = 0, slowest = 0;
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
    slowest = std::max(slowest, outcome.slowest);
    for (const auto& [variant, found, distance] : outcome.compared) {
      ++agreements[{variant, found}];
      if (found != Agreement::same && found != Agreement::missed)
        apart.row({world, variant, distance, agreement_names[static_cast<std::size_t>(found)]});
    }
  }
  for (std::size_t k = 0; k < ended.size(); ++k) ends.row({std::string(status_names[k]), ended[k]});
  for (const auto& [key, first_steps] : agreements)
    agreement.row({key.first, first_steps, agreement_names[static_cast<std::size_t>(key.second)]});

  const auto of = fmt::format(" of {} scenes", count);
  context.verdict("worlds.refuted", "no step that says ok is refuted by code that shares nothing with it",
                  "refuted" + of, refutations, 0);
  context.verdict("worlds.finite", "no state ceases to be finite", "states" + of, not_finite, 0);
  context.verdict("worlds.throws", "no step throws", "throws" + of, thrown, 0);
  context.verdict("worlds.refused", "no scene is refused", "refused" + of, refused, 0);
  context.verdict("worlds.slowest", "no step takes longer than a minute", "s, the slowest step", slowest, 60);
  for (Table* table : {&refuted, &broken, &ends, &apart, &agreement}) table->close();
}

}  // namespace pbdcheck
