#include "studies/robustness/contact_gates.h"

#include <algorithm>
#include <cmath>

#include "harness/interrupt.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "harness/step_checks.h"
#include "scenes/standard.h"

namespace pbdcheck {

using namespace pbd;

namespace {

/// True if a body that nothing moves moves.
bool scripted(const Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const int node = scene.bodies[b].node;
    if (std::isfinite(scene.mass[static_cast<std::size_t>(node)])) continue;
    if (!scene.initial.v.col(node).isZero(0) ||
        !scene.initial.spin.col(static_cast<Eigen::Index>(b)).isZero(0))
      return true;
  }
  return false;
}

bool jointed(const Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(),
                     [](const Effect& effect) { return std::holds_alternative<PointJoint>(effect); });
}

double joint_error(const Scene& scene, const State& state) {
  double worst = 0;
  for (const Effect& effect : scene.effects)
    if (const auto* joints = std::get_if<PointJoint>(&effect))
      for (std::size_t i = 0; i < joints->body.size(); ++i) {
        std::array<Vec3, 2> place;
        for (const std::size_t side : {0U, 1U}) {
          const auto body = static_cast<std::size_t>(joints->body[i][side]);
          place[side] =
              state.x.col(scene.bodies[body].node) + state.orientation[body] * joints->point[i][side];
        }
        worst = larger(worst, (place[1] - place[0]).norm());
      }
  return worst;
}

}  // namespace

std::vector<Gate> gates_of(const ContactCase& each, const Watched& watched, const State& state, double mass,
                           double h, std::int64_t steps) {
  const double largest_move =
      (state.x - each.scene.initial.x).colwise().norm().maxCoeff<Eigen::PropagateNaN>();
  const auto asked = [](bool asks, const char* why) { return asks ? std::string() : std::string(why); };
  return {
      {"finite", watched.not_finite, 0},
      {"energy", watched.excess, 0.01, asked(!scripted(each.scene), "a scripted body gives energy")},
      {"penetration", watched.overlap / each.size, 1e-2},
      {"penetration_at_end", watched.overlap_at_end / each.size, 1e-3},
      {"joints", watched.joints / each.size, 1e-3, asked(jointed(each.scene), "no joints")},
      {"claims", watched.refuted, 0, asked(watched.judged > 0, "no step says ok")},
      {"residual", watched.unimproved, 0},
      {"settles", kinetic_energy(each.scene, state) / (mass * gravity * each.size), 1e-6,
       asked(each.settles, "it goes on moving")},
      {"stays", largest_move / each.size, 1e-3, asked(each.stays, "it moves")},
      {"falls", largest_move > 0.1 ? 0.0 : 1.0, 0, asked(each.falls, "it may stay")},
      {"lift", watched.lift, each.lift, asked(each.lift >= 0, "it may rise")},
      {"reaction", std::abs(watched.reaction / each.reaction - 1), 1e-6,
       asked(each.reaction >= 0, "not the ground alone")},
      {"answer", each.missed ? each.missed(state, h, steps) : 0, 1e-6, asked(bool(each.missed), "not known")},
  };
}

CaseRun run_contact_case(const ContactCase& each, const Method& method, double h) {
  CaseRun run;
  const Scene& scene = each.scene;
  Workspace workspace(scene, method);
  State state = scene.initial;
  StepChecks checks;
  const double mass = finite_mass(scene);
  const double scale = kinetic_energy(scene, state) + mass * gravity * each.size;
  const double start = kinetic_energy(scene, state) + gravity_energy(scene, state);
  Worst excess, overlap, joints, lift;
  double overlap_at_end = 0, reaction = 0;
  std::int64_t diverged = 0, unimproved = 0;
  const auto steps = static_cast<std::int64_t>(std::ceil(each.duration / h));
  for (; run.steps < steps; ++run.steps) {
    throw_if_interrupted();
    double first = -1;
    const State before = state;
    const Report report = step(workspace, h, state, [&](const Iterate& iterate) {
      if (first < 0) first = std::max(iterate.primal, iterate.dual);
    });
    run.sweeps += report.sweeps;
    run.ok += report.status == Status::ok;
    if (report.status > run.worst) run.worst = report.status, run.reason = report.reason;
    if (report.status == Status::diverged) {
      ++diverged;
      continue;
    }
    checks.add(run.steps + 1, claim_of(scene, workspace, before, state, h, report), report.status, false);
    unimproved += report.status != Status::ok && !(std::max(report.primal, report.dual) < first);
    excess.add(larger(0, kinetic_energy(scene, state) + gravity_energy(scene, state) - start));
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
                  static_cast<double>(checks.refuted_steps()),
                  static_cast<double>(unimproved),
                  checks.judged()};
  if (checks.refuted_steps() > 0) run.reason = checks.text();
  run.gates = gates_of(each, watched, state, mass, h, run.steps);
  return run;
}

}  // namespace pbdcheck
