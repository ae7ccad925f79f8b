#include "studies/robustness/contact_gates.h"

#include <algorithm>
#include <cmath>

#include "harness/interrupt.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "harness/step_checks.h"
#include "studies/robustness/crossings.h"

namespace pbdcheck {

using namespace pbd;

namespace {

/// True if a node, a body or a surface that nothing moves moves.
bool scripted(const Scene& scene) {
  for (int node = 0; node < scene.nodes(); ++node)
    if (std::isinf(scene.mass[static_cast<std::size_t>(node)]) && !scene.initial.v.col(node).isZero(0))
      return true;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (std::isinf(scene.bodies[b].inertia.maxCoeff()) &&
        !scene.initial.spin.col(static_cast<Eigen::Index>(b)).isZero(0))
      return true;
  const auto& colliders = contact_of(scene)->collider;
  return std::any_of(colliders.begin(), colliders.end(),
                     [](const Collider& each) { return !each.surface_velocity.isZero(0); });
}

bool is_length(const Effect& effect) {
  return error_unit(effect) == "_m";
}

bool jointed(const Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(), is_length);
}

double joint_error(const Scene& scene, const State& state) {
  double worst = 0;
  for (const Effect& effect : scene.effects)
    if (is_length(effect)) worst = larger(worst, constraint_error(scene, effect, state));
  return worst;
}

/// The scene's own, m/s^2.
double gravity_of(const Scene& scene) {
  for (const Effect& effect : scene.effects)
    if (const auto* own = std::get_if<Gravity>(&effect)) return own->acceleration.norm();
  return 0;
}

/// Whether some whose cores are apart before a step pass through each other in it, and whether they begin it
/// apart as a whole.
struct Passing {
  bool any = false, from_apart = false;
};
Passing passing(const ContactCase& each, const State& from, const State& to) {
  Passing found;
  for (const auto& [whole, core] : each.apart_for_ever) {
    if (!(apart(each.scene, core[0], core[1], from) > 0)) continue;
    if (!pass_through(each.scene, core[0], core[1], from, to)) continue;
    found.any = true;
    found.from_apart |= apart(each.scene, whole[0], whole[1], from) > 0;
  }
  return found;
}

}  // namespace

std::vector<Gate> gates_of(const ContactCase& each, const Watched& watched, const State& state, double mass,
                           double h, std::int64_t steps) {
  const double largest_move =
      (state.x - each.scene.initial.x).colwise().norm().maxCoeff<Eigen::PropagateNaN>();
  const double weight = mass * gravity_of(each.scene);
  const auto asked = [](bool asks, const char* why) { return asks ? std::string() : std::string(why); };
  return {
      {"finite", watched.not_finite, 0},
      {"energy", watched.excess, 0.01, asked(!scripted(each.scene), "what is scripted gives energy")},
      {"penetration", watched.overlap / each.size, 1e-2},
      {"penetration_at_end", watched.overlap_at_end / each.size, 1e-3},
      {"crosses", watched.crossing, 0, asked(!contact_of(each.scene)->triangle.empty(), "nothing is soft")},
      {"passes", watched.passed, 0, asked(!each.apart_for_ever.empty(), "not watched")},
      {"joints", watched.joints / each.size, 1e-3, asked(jointed(each.scene), "no joints")},
      {"claims", watched.refuted, 0, asked(watched.judged > 0, "no step says ok")},
      {"residual", watched.unimproved, 0},
      {"settles", kinetic_energy(each.scene, state) / (weight * each.size), 1e-6,
       asked(each.settles, "it goes on moving")},
      {"stays", largest_move / each.size, 1e-3, asked(each.stays, "it moves")},
      {"falls", largest_move > 0.1 ? 0.0 : 1.0, 0, asked(each.falls, "it may stay")},
      {"lift", watched.lift, each.lift, asked(each.lift >= 0, "it may rise")},
      {"reaction", std::abs(watched.reaction / each.reaction - 1), 1e-6,
       asked(each.reaction >= 0, "not the ground alone")},
      {"answer", each.missed ? each.missed(state, h, steps) / each.exact_to : 0, 1,
       asked(bool(each.missed), "not known")},
  };
}

CaseRun run_contact_case(const ContactCase& each, const Method& method, double h) {
  CaseRun run;
  const Scene& scene = each.scene;
  Workspace workspace(scene, method);
  State state = scene.initial;
  StepChecks checks;
  const double mass = finite_mass(scene);
  const double start = total_energy(scene, state);
  const double scale = start - gravity_energy(scene, state) + mass * gravity_of(scene) * each.size;
  Worst excess, overlap, joints, lift, crossing;
  double overlap_at_end = 0, reaction = 0;
  std::int64_t diverged = 0, unimproved = 0, passed = 0, refuted = 0;
  const Crossings crossings(scene);
  double crossing_before = crossings.count(state);
  const auto steps = static_cast<std::int64_t>(std::ceil(each.duration / h));
  for (; run.steps < steps; ++run.steps) {
    throw_if_interrupted();
    double first = -1;
    const State before = state;
    const Report report = step(workspace, h, state, [&](const Iterate& iterate) {
      if (first < 0) first = larger(iterate.primal, iterate.dual);
    });
    run.sweeps += report.sweeps;
    run.ok += report.status == Status::ok;
    if (report.status > run.worst) run.worst = report.status, run.reason = report.reason;
    if (report.status == Status::diverged) {
      ++diverged;
      continue;
    }
    const std::int64_t refuted_before = checks.refuted_steps();
    checks.add(run.steps + 1, claim_of(scene, workspace, before, state, h, report), report.status, false);
    unimproved += report.status != Status::ok && !(larger(report.primal, report.dual) < first);
    excess.add(larger(0, total_energy(scene, state) - start));
    const double crossing_now = crossings.count(state);
    const Passing passes = passing(each, before, state);
    const bool entered = passes.from_apart || crossing_now > crossing_before;
    crossing_before = crossing_now;
    crossing.add(crossing_now);
    passed += passes.any;
    refuted += report.status == Status::ok && (entered || checks.refuted_steps() > refuted_before);
    overlap_at_end = reaction = 0;
    for (const ContactForce& contact : workspace.contacts()) {
      overlap_at_end = larger(overlap_at_end, -contact.gap);
      if (contact.collider[0] == 0) reaction -= contact.force.z();
      if (contact.collider[1] == 0) reaction += contact.force.z();
    }
    overlap.add(overlap_at_end);
    joints.add(joint_error(scene, state));
    lift.add(larger(0, (state.x.row(2) - scene.initial.x.row(2)).maxCoeff<Eigen::PropagateNaN>()));
  }
  const auto not_finite = static_cast<double>((!state.x.array().isFinite()).count() + diverged);
  Watched watched{excess.value() / scale,
                  overlap.value(),
                  overlap_at_end,
                  joints.value(),
                  lift.value(),
                  reaction,
                  not_finite,
                  static_cast<double>(refuted),
                  static_cast<double>(unimproved),
                  checks.judged(),
                  crossing.value(),
                  static_cast<double>(passed)};
  if (checks.refuted_steps() > 0)
    run.reason = checks.text();
  else if (refuted > 0)
    run.reason = "steps that say ok let surfaces cross, or bodies pass";
  run.gates = gates_of(each, watched, state, mass, h, run.steps);
  return run;
}

}  // namespace pbdcheck
