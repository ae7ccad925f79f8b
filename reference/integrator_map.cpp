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

/// Accelerations by given forces, where the step begins.
Vector given(const RigidStep& step) {
  const Vector at = step.base();
  Vector given = -system_at(step, at, Vector::Zero(step.model.rows())).load.cwiseQuotient(step.model.inertia);
  for (const Rotor& rotor : step.model.rotors)
    if (const int i = rotor.unknown; i >= 0 && step.model.gyroscopic == GyroscopicTorque::at_end) {
      const Vec3 w = at.segment<3>(i);
      given.segment<3>(i) += w.cross(rotor.inertia.cwiseProduct(w)).cwiseQuotient(rotor.inertia);
    }
  return given;
}

/// Newmark's and the method's parameters, by Chung and Hulbert.
struct Alpha {
  double m, f, gamma, beta;

  explicit Alpha(double rho) : m((2 * rho - 1) / (rho + 1)), f(rho / (rho + 1)) {
    gamma = 0.5 + f - m;
    beta = (gamma + 0.5) * (gamma + 0.5) / 4;
  }
};

void require_judged(std::string_view integrator) {
  if (std::find(judged_integrators.begin(), judged_integrators.end(), integrator) == judged_integrators.end())
    throw SetupError("method.integrator", "`" + std::string(integrator) + "`",
                     "implicit_euler, bdf2, generalised_alpha: the steps the judge states");
}

}  // namespace

/// a where a step begins: of an instant that is apart from it in proportion to the step.
Vector IntegratorMemory::acceleration_at(const RigidStep& step) const {
  const Vector q = given(step) + by_constraints_;
  return q + step.h / h_ * (acceleration_ - q);
}

IntegratorMap IntegratorMemory::generalised_alpha(const StepClaim& claim, const RigidStep& step) const {
  const Alpha alpha(rho_);
  const double h = claim.h, weight = h * alpha.gamma / (1 - alpha.m), ratio = alpha.beta / alpha.gamma;
  const Vector q = given(step) + by_constraints_, a = acceleration_at(step);
  const Vector velocity = step.start_velocity();
  IntegratorMap map;
  map.d = h * ratio;
  map.s = weight * (1 - alpha.f);
  map.shift = h * (1 - ratio) * velocity + h * h * (0.5 - ratio) * (a + pressed_ / h_);
  map.base = velocity + weight * alpha.f * q + (h * (1 - alpha.gamma) - weight * alpha.m) * a;
  return map;
}

/// a and q at the end of a step; one without a map, implicit Euler's, has a constant a.
void IntegratorMemory::follow_acceleration(const RigidStep& step, const Vector& velocity) {
  const Vector change = velocity - step.start_velocity() - pressed_;
  by_constraints_ = (velocity - step.base() - pressed_) / step.s() - given(step);
  if (!step.map) {
    acceleration_ = change / step.h;
    return;
  }
  const Alpha alpha(rho_);
  acceleration_ = (change - step.h * (1 - alpha.gamma) * begun_) / (step.h * alpha.gamma);
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
  require_judged(claim.integrator);
  if (claim.integrator == "implicit_euler" || !(h_ > 0) || !same(*ended_, claim.start)) return {};
  const RigidStep euler = step_of(claim);
  RigidStep own = euler;
  own.map = claim.integrator == "bdf2" ? bdf2(claim, euler) : generalised_alpha(claim, euler);
  if (missed(euler, claim) < missed(own, claim)) return {};
  return own.map;
}

void IntegratorMemory::follow(const StepClaim& claim) {
  require_judged(claim.integrator);
  if (claim.integrator == "implicit_euler") return;
  RigidStep step = step_of(claim);
  step.map = map_of(claim);
  if (step.map && claim.integrator == "generalised_alpha") begun_ = acceleration_at(step);
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
  if (claim.integrator == "generalised_alpha") follow_acceleration(step, velocity);
}

}  // namespace pbd::reference
