// What breaks contact solvers: mass ratios, redundant contacts, thresholds of sliding, high friction, chains
// that strike. One method with no setting of its own for any case. Its gates:
//
//   finite              coordinates at the end that are not finite, and diverged steps
//   energy              largest excess of kinetic and potential energy over the start's and what scripted
//                       bodies can have given, as part of the start's + m g L
//   penetration         largest overlap, as part of the smallest body's size, 1e-2 while bodies strike
//   penetration_at_end  the same where the run ends, 1e-3
//   joints              largest error of a joint, as part of the size
//   claims              steps that say ok and are refuted by independent checks (harness/step_checks.h)
//   residual            steps that gave up without having improved on their first residual
//   settles             kinetic energy at the end, as part of m g L
//   stays               largest way of a body's centre, as part of the size
//   falls               1 where what cannot stand has not fallen
//   lift                m, that a centre has risen
//   reaction            relative error of what the ground carries at the end
//   answer              relative error of a motion that is known
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/measure.h"
#include "harness/probes.h"
#include "harness/step_checks.h"
#include "scenes/standard.h"
#include "studies/contact/contact_answers.h"
#include "studies/experiments.h"
#include "studies/robustness/contact_cases.h"
#include "studies/robustness/gates.h"

namespace pbdcheck {
namespace {

using namespace pbd;

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
        worst = std::max(worst, (place[1] - place[0]).norm());
      }
  return worst;
}

struct CaseRun {
  std::vector<Gate> gates;
  std::int64_t steps = 0, ok = 0, sweeps = 0;
  Status worst = Status::ok;
  std::string reason;

  bool all_hold() const {
    return std::none_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.fails(); });
  }
};

/// What was seen on the way.
struct Watched {
  double excess;                   // of energy, 0 if there is none, as part of the scale
  double overlap, overlap_at_end;  // m
  double joints, lift;             // m
  double reaction;                 // N, of the ground at the end
  double not_finite;               // number of coordinates and steps
  double refuted, unimproved;      // numbers of steps
};

std::vector<Gate> gates_of(const ContactCase& each, const Watched& watched, const State& state, double mass,
                           double h, std::int64_t steps) {
  const double largest_move = (state.x - each.scene.initial.x).colwise().norm().maxCoeff();
  const auto asked = [](bool asks, const char* why) { return asks ? std::string() : std::string(why); };
  return {
      {"finite", watched.not_finite, 0},
      {"energy", watched.excess, 0.01, asked(!scripted(each.scene), "a scripted body gives energy")},
      {"penetration", watched.overlap / each.size, 1e-2},
      {"penetration_at_end", watched.overlap_at_end / each.size, 1e-3},
      {"joints", watched.joints / each.size, 1e-3, asked(jointed(each.scene), "no joints")},
      {"claims", watched.refuted, 0},
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
  double mass = 0;
  for (const double own : scene.mass)
    if (std::isfinite(own)) mass += own;
  const double scale = kinetic_energy(scene, state) + mass * gravity * each.size;
  const double start = kinetic_energy(scene, state) + gravity_energy(scene, state);
  Worst excess, overlap, joints, lift;
  double overlap_at_end = 0, reaction = 0;
  std::int64_t diverged = 0, unimproved = 0;
  const auto steps = static_cast<std::int64_t>(std::ceil(each.duration / h));
  for (; run.steps < steps; ++run.steps) {
    throw_if_interrupted();
    double first = -1, last = 0;
    const State before = state;
    const Report report = step(workspace, h, state, [&](const Iterate& iterate) {
      last = std::max(iterate.primal, iterate.dual);
      if (first < 0) first = last;
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
      if (!(-contact.gap <= overlap_at_end)) overlap_at_end = -contact.gap;
      if (contact.collider[0] == 0) reaction -= contact.force.z();
      if (contact.collider[1] == 0) reaction += contact.force.z();
    }
    overlap.add(overlap_at_end);
    joints.add(joint_error(scene, state));
    lift.add(larger(0, (state.x.row(2) - scene.initial.x.row(2)).maxCoeff()));
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
                  static_cast<double>(unimproved)};
  if (checks.refuted_steps() > 0) run.reason = checks.text();
  run.gates = gates_of(each, watched, state, mass, h, run.steps);
  return run;
}

struct Frontier {
  double largest_step = std::nan("");   // s, of those tried at which all gates hold
  double fewest_sweeps = std::nan("");  // an outer iteration, at the case's own step
};

/// Longer steps and fewer sweeps while the gates hold; where they do not hold as it is, shorter steps until
/// they do.
Frontier contact_frontier(const ContactCase& each, const Method& method, bool holds) {
  Frontier frontier;
  if (holds) {
    frontier.largest_step = each.h;
    for (const double factor : {2.0, 4.0, 8.0}) {
      if (!run_contact_case(each, method, factor * each.h).all_hold()) break;
      frontier.largest_step = factor * each.h;
    }
    frontier.fewest_sweeps = method.max_sweeps;
    for (const int most : {100, 30, 10, 3, 1}) {
      Method tried = method;
      tried.max_sweeps = most;
      if (!run_contact_case(each, tried, each.h).all_hold()) break;
      frontier.fewest_sweeps = most;
    }
    return frontier;
  }
  for (const double factor : {0.5, 0.25})
    if (run_contact_case(each, method, factor * each.h).all_hold()) {
      frontier.largest_step = factor * each.h;
      break;
    }
  return frontier;
}

}  // namespace

void contact_hard_cases(Context& context) {
  const std::vector<ContactCase> cases = contact_cases(context.full());
  std::vector<std::string> relaxations{"direct"};  // the one that is judged
  if (context.full()) relaxations.insert(relaxations.end(), {"conjugate_gradients", "gauss_seidel"});
  context.begin(std::ssize(cases));
  Table table = context.table(
      "gates", {"scene", "step_s", "integrator", "outer", "relaxation", "friction", "steps", "steps_ok",
                "sweeps", "gate", "measured", "bound", "holds", "status", "reason"});
  Table frontiers = context.table("frontier", {"scene", "outer", "relaxation", "friction", "largest_step_s",
                                               "fewest_sweeps", "status", "reason"});
  std::vector<std::string> names;
  std::vector<Worst> worst;
  std::vector<double> bounds;
  for (const ContactCase& each : cases) {
    for (const std::string& relaxation : relaxations) {
      Method method;
      method.relaxation = relaxation;
      if (relaxation != relaxations[0]) method.max_outer = 10, method.max_sweeps = 100;
      const CaseRun run = run_contact_case(each, method, each.h);
      const std::string status(status_names[static_cast<std::size_t>(run.worst)]);
      for (const Gate& gate : run.gates) {
        if (!gate.skipped.empty()) continue;
        table.row({each.name, each.h, method.integrator, method.outer, relaxation, method.friction, run.steps,
                   run.ok, run.sweeps, std::string(gate.name), gate.measured, gate.bound,
                   std::int64_t{gate.holds()}, status, run.reason});
        if (relaxation != relaxations[0]) continue;
        const auto found = std::find(names.begin(), names.end(), gate.name);
        const auto index = static_cast<std::size_t>(found - names.begin());
        if (found == names.end())
          names.emplace_back(gate.name), worst.emplace_back(), bounds.push_back(gate.bound);
        worst[index].add(gate.measured);
      }
      if (relaxation != relaxations[0]) continue;
      const Frontier frontier = contact_frontier(each, method, run.all_hold());
      frontiers.row({each.name, method.outer, relaxation, method.friction, frontier.largest_step,
                     frontier.fewest_sweeps, status, run.reason});
    }
    context.advance(each.name);
  }
  table.close();
  frontiers.close();
  for (std::size_t i = 0; i < names.size(); ++i)
    context.verdict(Basis::robustness, "contact_hard." + names[i],
                    fmt::format("the gate {} holds in every case that asks for it", names[i]),
                    "largest measured", worst[i].value(), bounds[i]);
}

}  // namespace pbdcheck
