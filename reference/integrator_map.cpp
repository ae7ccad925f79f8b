#include "integrator_map.h"

#include <algorithm>

#include "error.h"
#include "step_equations.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

RigidStep step_of(const StepClaim& claim) {
  return {make_step_model(claim.scene).rigid, claim.start, claim.h};
}

/// Velocities of the unknowns where a claim ends.
Vector end_velocity(RigidStep step, const StepClaim& claim) {
  step.start = claim.end;
  return step.start_velocity();
}

bool same(const State& one, const State& other) {
  const auto turned = [](const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return a.coeffs() == b.coeffs();
  };
  return one.x == other.x && one.v == other.v && one.spin == other.spin &&
         std::equal(one.orientation.begin(), one.orientation.end(), other.orientation.begin(), turned);
}

/// How far a step's map leads from where a claim ends, m.
double missed(const RigidStep& step, const StepClaim& claim) {
  const State end = step.end(end_velocity(step, claim));
  double worst = (end.x - claim.end.x).cwiseAbs().maxCoeff();
  for (std::size_t b = 0; b < end.orientation.size(); ++b)
    worst = std::max(
        worst, step.model.rotors[b].radius * end.orientation[b].angularDistance(claim.end.orientation[b]));
  return worst;
}

}  // namespace

void require_judged_integrator(std::string_view name) {
  if (name != "implicit_euler" && name != "bdf2")
    throw SetupError("method.integrator", "`" + std::string(name) + "`",
                     "implicit_euler, bdf2: the steps the judge states");
}

IntegratorMap IntegratorMemory::bdf2(const StepClaim& claim, const RigidStep& step) const {
  const double ratio = claim.h / h_, share = ratio * ratio / (1 + 2 * ratio);
  IntegratorMap map;
  map.d = map.s = claim.h * (1 + ratio) / (1 + 2 * ratio);
  const Vector velocity = step.start_velocity();
  map.shift = share * moved_;
  map.base = velocity + share * (velocity - before_ - pressed_);
  return map;
}

std::optional<IntegratorMap> IntegratorMemory::map_of(const StepClaim& claim) const {
  require_judged_integrator(claim.integrator);
  if (claim.integrator == "implicit_euler" || !(h_ > 0) || !same(*ended_, claim.start)) return {};
  const RigidStep euler = step_of(claim);
  RigidStep own = euler;
  own.map = bdf2(claim, euler);
  if (missed(euler, claim) < missed(own, claim)) return {};
  return own.map;
}

void IntegratorMemory::follow(const StepClaim& claim) {
  require_judged_integrator(claim.integrator);
  if (claim.integrator == "implicit_euler") return;
  RigidStep step = step_of(claim);
  step.map = map_of(claim);
  h_ = claim.h;
  ended_ = claim.end;
  before_ = step.start_velocity();
  const Vector velocity = end_velocity(step, claim);
  moved_ = step.shift() + step.d() * velocity;
  Vector gamma;
  pressed_ = Vector::Zero(step.model.unknowns);
  if (!gather_forces(claim, step.model, gamma) || !gamma.allFinite()) return;
  const RigidSystem system = system_at(step, velocity, gamma);
  pressed_ = step.s() * system.force(gamma).cwiseQuotient(step.model.inertia);
}

}  // namespace pbd::reference
