#include "studies/robustness/gates.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "harness/interrupt.h"
#include "harness/measure.h"
#include "harness/probes.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Work that gravity and constant forces have done since the start is minus the change of this, J.
double load_energy(const Scene& scene, const State& state) {
  double energy = gravity_energy(scene, state);
  for (const auto& effect : scene.effects)
    if (const auto* load = std::get_if<ExternalForce>(&effect))
      for (std::size_t i = 0; i < load->node.size(); ++i)
        if (std::isfinite(scene.mass[static_cast<std::size_t>(load->node[i])]))
          energy -= load->force[i].dot(state.x.col(load->node[i]));
  return energy;
}

/// (m g + |f|) L with the scene's own gravity, J.
double load_scale(const HardCase& each) {
  double force = 0;
  for (const auto& effect : each.scene.effects) {
    if (const auto* gravity = std::get_if<Gravity>(&effect))
      force += finite_mass(each.scene) * gravity->acceleration.norm();
    if (const auto* load = std::get_if<ExternalForce>(&effect))
      for (const auto& each_force : load->force) force += each_force.norm();
  }
  return force * each.length;
}

/// Largest error of a hard link as part of the shortest one's length; -1 if there is none.
double link_error(const Scene& scene, const State& state) {
  double largest = -1;
  for (const auto& effect : scene.effects)
    if (const auto* links = std::get_if<Distance>(&effect))
      if (std::count(links->compliance.begin(), links->compliance.end(), 0.0) > 0)
        largest =
            larger(largest, constraint_error(scene, effect, state) /
                                *std::min_element(links->rest_length.begin(), links->rest_length.end()));
  return largest;
}

/// Largest relative error of the tensions of a rope whose nodes hang below each other.
double tension_error(const Scene& scene, const Workspace& workspace, double h) {
  double largest = 0, below = 0;
  for (std::size_t index = 0; index < scene.effects.size(); ++index)
    if (const auto* links = std::get_if<Distance>(&scene.effects[index])) {
      const auto impulses = workspace.impulses(index);
      for (std::size_t i = links->node.size(); i-- > 0;) {
        below += scene.mass[static_cast<std::size_t>(links->node[i][1])] * 9.81;
        largest = larger(largest, std::abs(-impulses[i] / h / below - 1));
      }
    }
  return largest;
}

double recovery_error(const HardCase& each, const Points& x) {
  if (!x.allFinite()) return infinity;
  const Eigen::Matrix4d rigid = Eigen::umeyama(each.rest, x, false);
  const Points placed =
      (rigid.topLeftCorner<3, 3>() * each.rest).colwise() + Vec3(rigid.topRightCorner<3, 1>());
  return (placed - x).colwise().norm().maxCoeff() / each.length;
}

/// Follows one simulation.
class Watcher {
 public:
  Watcher(const HardCase& each, const Method& method, double h)
      : each_(each),
        method_(method),
        h_(h),
        start_energy_(inner_energy(each.scene.initial)),
        start_load_(load_energy(each.scene, each.scene.initial)),
        scale_(start_energy_ + load_scale(each)) {}

  void iterate(const Iterate& iterate) {
    const double residual = larger(iterate.primal, iterate.dual) / std::max(iterate.scale, 1e-300);
    if (iterate.outer_iteration == 0) first_ = best_ = residual;
    best_ = std::min(best_, residual);
  }

  void step(const State& before, const State& state, const Report& report, bool judged) {
    ++result.steps;
    result.steps_ok += report.status == Status::ok;
    result.sweeps += report.sweeps;
    if (report.status > result.worst) result.worst = report.status, result.reason = report.reason;
    not_finite_ += report.status == Status::diverged;
    if (!state.x.allFinite() || !state.v.allFinite()) ++not_finite_;
    if (report.status != Status::ok && !(best_ < first_)) ++stuck_;
    const double work = start_load_ - load_energy(each_.scene, state);
    excess_.add(larger(0, (inner_energy(state) - start_energy_ - work) / scale_));
    links_.add(link_error(each_.scene, state));
    if (!judged || report.status != Status::ok) return;
    ++judged_;
    claims_.add(claim_share(reference::residual_of(each_.scene, before, h_, state), method_.tolerance));
  }

  void finish(const State& state) {
    result.end = state;
    add("finite", static_cast<double>(not_finite_), 0);
    add("energy", excess_.value(), 0.01);
    if (link_error(each_.scene, state) >= 0) add("hard_rows", links_.value(), 1e-3);
    if (judged_ == 0)
      result.gates.push_back({"claims", std::nan(""), 1, "no judged step has status ok"});
    else
      add("claims", claims_.value(), 1);
    add("residual", static_cast<double>(stuck_), 0);
  }

  void add(std::string_view name, double measured, double bound) {
    result.gates.push_back({name, measured, bound});
  }

  Simulated result;

 private:
  double inner_energy(const State& state) const {
    return kinetic_energy(each_.scene, state) + elastic_energy(each_.scene, state);
  }

  const HardCase& each_;
  const Method& method_;
  double h_, start_energy_, start_load_, scale_;
  double first_ = 0, best_ = 0;
  std::int64_t not_finite_ = 0, stuck_ = 0, judged_ = 0;
  Worst excess_, links_, claims_;
};

}  // namespace

bool all_hold(const std::vector<Gate>& gates) {
  return std::none_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.fails(); });
}

double claim_share(const reference::StepResidual& judged, double tolerance) {
  const double allowed = std::sqrt(2.0) * std::max(tolerance * judged.scale, judged.rounding) + judged.own;
  return allowed > 0 ? judged.residual / allowed : judged.residual;
}

Simulated simulate(const HardCase& each, const Method& method, double h, const Watch& watch) {
  Watcher watcher(each, method, h);
  Workspace workspace(each.scene, method);
  State state = each.scene.initial;
  const int settling = settling_steps(each, h);
  const bool asked = settling >= 0 && settling <= watch.most_steps;
  const int steps = std::max(watch.steps, asked ? settling : 0);
  const int apart = std::max(1, steps / std::max(1, watch.judged_steps));
  for (int k = 0; k < steps; ++k) {
    throw_if_interrupted();
    const State before = state;
    const auto report = step(workspace, h, state, [&](const Iterate& iterate) { watcher.iterate(iterate); });
    watcher.step(before, state, report, watch.judged_steps > 0 && k % apart == 0);
  }
  watcher.finish(state);
  auto& gates = watcher.result.gates;
  const std::string too_long =
      fmt::format("settles in {} steps only, more than {}", settling, watch.most_steps);
  if (settling >= 0)
    gates.push_back({"settles",
                     kinetic_energy(each.scene, state) / (finite_mass(each.scene) * 9.81 * each.length), 1e-6,
                     asked ? "" : too_long});
  if (each.tension) watcher.add("tension", tension_error(each.scene, workspace, h), 1e-3);
  if (each.rest.size() > 0)
    gates.push_back({"recovers", recovery_error(each, state.x), 1e-6, asked ? "" : too_long});
  return watcher.result;
}

}  // namespace pbdcheck
