#include "integrator_map.h"

#include <algorithm>

#include "damping.h"
#include "error.h"
#include "step_equations.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

RigidStep step_of(const Scene& scene, const State& start, double h) {
  return {make_step_model(scene).rigid, start, h};
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
  Vector velocity = end_velocity(step, claim);
  if (step.map) velocity = step.start_velocity() + (velocity - step.start_velocity()) / step.map->extension;
  const State end = step.carried_on(velocity);
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

/// Accelerations by all forces where the step begins, hard constraints' none.
Vector all_forces(const Scene& scene, const RigidStep& step) {
  const Vector velocity = step.start_velocity();
  RigidStep still{step.model, step.start, 0};
  still.map = IntegratorMap{.d = 1, .s = 1, .shift = -velocity, .base = velocity, .along = -1};
  still.damping = damping_of(scene, still);
  const RigidSystem system = system_at(still, velocity, Vector::Zero(step.model.rows()));
  Vector gamma = Vector::Zero(step.model.rows());
  if (SparseLu compliance; step.model.rows() > 0 && compliance.compute(system.compliance))
    gamma = compliance.solve(-system.value);
  const auto bounds = make_step_model(scene).bounds;
  for (std::size_t row = 0; row < bounds.size(); ++row) {
    double& own = gamma[static_cast<Eigen::Index>(row)];
    own = std::clamp(own, bounds[row][0], bounds[row][1]);
  }
  return -system.force(gamma).cwiseQuotient(step.model.inertia);
}

bool touches(const Scene& scene) {
  return std::any_of(scene.effects.begin(), scene.effects.end(),
                     [](const Effect& effect) { return std::holds_alternative<Contact>(effect); });
}

/// The parameters of generalised alpha by Chung and Hulbert, or of Newmark's own family.
struct Alpha {
  double m, f, gamma, beta;

  explicit Alpha(const Method& method) : m(0), f(0) {
    if (method.integrator == "newmark") {
      gamma = *method.gamma, beta = *method.beta;
      return;
    }
    m = (2 * method.rho - 1) / (method.rho + 1);
    f = method.rho / (method.rho + 1);
    gamma = 0.5 + f - m;
    beta = (gamma + 0.5) * (gamma + 0.5) / 4;
  }
};

IntegratorMap midpoint(const RigidStep& step) {
  const double half = step.h / 2;
  IntegratorMap map;
  map.d = map.s = half;
  map.extension = 2;
  map.shift = map.acceleration = Vector::Zero(step.model.unknowns);
  map.base = step.start_velocity();
  map.bend = -half * half / 2;
  return map;
}

bool turns_or_slides(const Effect& effect) {
  return std::holds_alternative<AngleJoint>(effect) || std::holds_alternative<SlideJoint>(effect);
}

/// True if velocities may jump: things touch, a force has one sign, or there is a motor.
bool may_strike(const Scene& scene) {
  const auto bounds = make_step_model(scene).bounds;
  return touches(scene) || std::any_of(scene.effects.begin(), scene.effects.end(), turns_or_slides) ||
         std::any_of(bounds.begin(), bounds.end(),
                     [](const auto& own) { return (own[0] == 0) != (own[1] == 0); });
}

bool by_alpha(const Method& method) {
  return method.integrator == "newmark" && !(method.beta && method.gamma);
}

}  // namespace

void require_judged(std::string_view integrator, const std::string& where) {
  std::string judged;
  for (const std::string_view name : {"implicit_euler", "newmark", "bdf2", "generalised_alpha", "midpoint"}) {
    if (name == integrator) return;
    judged += (judged.empty() ? "" : ", ") + std::string(name);
  }
  throw SetupError(where, "`" + std::string(integrator) + "`", judged + ": the steps the judge states");
}

IntegratorMemory::IntegratorMemory(const Method& method) : method_(method) {
  require_judged(method.integrator, "method.integrator");
}

bool IntegratorMemory::goes_on(const State& start) const {
  return h_ > 0 && same(*ended_, start);
}

/// a is of an instant that is apart from the step's begin in proportion to the step.
IntegratorMemory::Begun IntegratorMemory::begun(const Scene& scene, const RigidStep& step,
                                                bool goes_on) const {
  if (!goes_on) {
    const Vector q = all_forces(scene, step);
    return {q, q, Vector::Zero(q.size())};
  }
  const Vector q = given(step) + by_constraints_;
  return {q, q + step.h / h_ * (acceleration_ - q), pressed_ / h_};
}

IntegratorMap IntegratorMemory::newmark(const RigidStep& step, const Begun& begun) const {
  const double of_start = step.h * (1 - method_.alpha);
  const Vector velocity = step.start_velocity();
  IntegratorMap map;
  map.d = map.s = step.h * method_.alpha;
  map.along = of_start;
  map.shift = of_start * velocity;
  map.base = velocity + of_start * begun.q;
  return map;
}

IntegratorMap IntegratorMemory::by_accelerations(const RigidStep& step, const Begun& begun) const {
  const Alpha alpha(method_);
  const double h = step.h, weight = h * alpha.gamma / (1 - alpha.m), ratio = alpha.beta / alpha.gamma;
  const Vector velocity = step.start_velocity();
  IntegratorMap map;
  map.d = h * ratio;
  map.s = weight * (1 - alpha.f);
  map.along = h * (1 - ratio);
  map.bend = h * h * (0.5 - ratio);
  map.acceleration = begun.a;
  map.shift = map.along * velocity + map.bend * (begun.a + begun.pushed);
  map.base = velocity + weight * alpha.f * begun.q + (h * (1 - alpha.gamma) - weight * alpha.m) * begun.a;
  return map;
}

/// a and q at the end of a step; one without a map, implicit Euler's, has a constant a.
void IntegratorMemory::follow_acceleration(const RigidStep& step, const Vector& velocity) {
  const Vector change = velocity - step.start_velocity() - pressed_;
  by_constraints_ = (velocity - step.base() - pressed_) / step.s() - given(step);
  acceleration_ = change / step.h;
  if (!step.map || by_alpha(method_)) return;
  const Alpha alpha(method_);
  acceleration_ = (change - step.h * (1 - alpha.gamma) * begun_) / (step.h * alpha.gamma);
}

IntegratorMap IntegratorMemory::bdf2(const RigidStep& step) const {
  const double ratio = step.h / h_;
  IntegratorMap map;
  map.share = ratio * ratio / (1 + 2 * ratio);
  map.d = map.s = step.h * (1 + ratio) / (1 + 2 * ratio);
  map.last = last_;
  const Vector velocity = step.start_velocity();
  map.shift = map.share * moved_;
  map.base = velocity + map.share * (velocity - before_ - pressed_);
  return map;
}

std::optional<IntegratorMap> IntegratorMemory::map_from(const Scene& scene, const State& start, double h,
                                                        bool goes_on) const {
  if (method_.integrator == "implicit_euler") return {};
  const RigidStep step = step_of(scene, start, h);
  if (method_.integrator == "midpoint") return midpoint(step);
  const auto& hard = step.model.hard;
  const bool any_hard = std::find(hard.begin(), hard.end(), true) != hard.end();
  const bool begins_anew =
      !carries_accelerations() || (method_.integrator == "generalised_alpha" && touches(scene));
  const int before = goes_on ? followed_ : 0, anew = any_hard ? 3 : begins_anew ? 1 : 0;
  if (before < anew) return {};
  if (!carries_accelerations()) return bdf2(step);
  const Begun begun = this->begun(scene, step, goes_on);
  return by_alpha(method_) ? newmark(step, begun) : by_accelerations(step, begun);
}

std::optional<IntegratorMap> IntegratorMemory::smooth_map(const Scene& scene, const State& start,
                                                          double h) const {
  return map_from(scene, start, h, goes_on(start) && !struck_);
}

/// Newmark's places tell no start from a motion that goes on: after a strike it is one.
std::optional<IntegratorMap> IntegratorMemory::nearest_map(const StepClaim& claim,
                                                           std::optional<IntegratorMap> map) const {
  if (!may_strike(claim.scene)) return map;
  RigidStep step = step_of(claim.scene, claim.start, claim.h);
  const auto missed_by = [&](const std::optional<IntegratorMap>& own) {
    step.map = own;
    return missed(step, claim);
  };
  const bool other_way = goes_on(claim.start) && struck_;
  double least = missed_by(map);
  for (const auto& other :
       {map_from(claim.scene, claim.start, claim.h, other_way), std::optional<IntegratorMap>()})
    if (const double own = missed_by(other); own < least) least = own, map = other;
  return map;
}

std::optional<IntegratorMap> IntegratorMemory::map_of(const StepClaim& claim) const {
  return nearest_map(claim, smooth_map(claim.scene, claim.start, claim.h));
}

void IntegratorMemory::follow(const StepClaim& claim) {
  if (carries_nothing()) return;
  RigidStep step = step_of(claim.scene, claim.start, claim.h);
  const auto smooth = smooth_map(claim.scene, claim.start, claim.h);
  step.map = nearest_map(claim, smooth);
  if (step.map && carries_accelerations()) begun_ = step.map->acceleration;
  struck_ = !step.map && smooth;
  followed_ = goes_on(claim.start) ? followed_ + 1 : 1;
  h_ = claim.h;
  ended_ = claim.end;
  last_ = placement_of(claim.start);
  before_ = step.start_velocity();
  const Vector velocity = end_velocity(step, claim);
  moved_ = step.shift() + step.d() * velocity;
  pressed_ = Vector::Zero(step.model.unknowns);
  if (Vector gamma; touches(claim.scene) && gather_forces(claim, step.model, gamma) && gamma.allFinite())
    pressed_ = step.s() * system_at(step, velocity, gamma).force(gamma).cwiseQuotient(step.model.inertia);
  if (carries_accelerations()) follow_acceleration(step, velocity);
}

}  // namespace pbd::reference
