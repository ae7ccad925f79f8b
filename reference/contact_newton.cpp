#include "contact_newton.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "contact_check.h"
#include "error.h"
#include "newton_search.h"
#include "step_equations.h"
#include "step_rows.h"
#include "touching_sides.h"

namespace pbd::reference {
namespace {

FrictionLaw law_of(Friction friction) {
  if (friction == Friction::coulomb) return FrictionLaw::coulomb;
  if (friction == Friction::cone) return FrictionLaw::cone;
  throw SetupError("method.friction",
                   "`" + std::string(friction_names[static_cast<std::size_t>(friction)]) + "`",
                   "coulomb, cone: the laws that the judges of contact know");
}

/// What corrections and gaps are measured by, m: the displacement, or if that is more what is allowed of it
/// to know the rounding of positions, and of what forces that balance each other make of them.
double scale_of(const ContactStep& own, const Vector& velocity, const Vector& gamma) {
  Vector magnitude = system_at(own.step, velocity, gamma).magnitude;
  own.push(velocity, magnitude);
  const RigidModel& model = own.step.model;
  const double h = own.step.h;
  const double by_forces =
      h * h * magnitude.cwiseProduct(model.radius).cwiseQuotient(model.inertia).maxCoeff();
  const double places = own.step.end(velocity).x.cwiseAbs().maxCoeff();
  return std::max(displacement_of(own.step, velocity),
                  step_rounding * std::max(places, by_forces) / allowed_residual);
}

constexpr double overlooked = 1e-6;  // of a size: edges and sides that are `parallel`, what lies `flat`

/// What of bodies, nodes and triangles is deeper in others than where the step begins, by their support
/// functions: the features may all have been overlooked.
WaysOut depths_of(const ContactStep& own, const Scene& scene, const Vector& velocity, Findings& findings) {
  if (own.contact.collider.empty() && own.contact.triangle.empty() && !own.contact.nodes_touch) return {};
  const State end = own.step.end(velocity);
  const StepClaim claim{.scene = scene, .start = own.step.start, .end = end, .h = own.step.h};
  return check_depths(claim, own.contact, 0, overlooked, findings);
}

/// What yields and is deeper in each other where the step ends than any of its contacts tells: features are
/// known up to a depth alone. Empty if nothing is.
std::string unknown_features(const ContactStep& own, const Scene& scene, const Vector& velocity) {
  const ContactPose pose = own.pose_at(velocity);
  const StepClaim claim{.scene = scene, .start = own.step.start, .end = pose.end, .h = own.step.h};
  for (const auto& [sides, depth] : pressed_pairs(claim, own.contact, overlooked)) {
    double told = 0;
    for (const JudgedContact& each : own.contacts)
      if (std::is_permutation(sides.begin(), sides.end(), each.pair.surface.begin()))
        told = std::max(told, -nearest(each.pair, pose.at).gap);
    if (depth > told)
      return name_of(sides[0], sides[1]) + ": what yields there is deeper than the features that are known";
  }
  return {};
}

/// The largest unbalanced force on a node or a body, of all that act on it and no less than rounding makes of
/// the largest force of all.
double force_residual(const RigidModel& model, const Vector& force, const Vector& magnitude) {
  const Vector per_length = model.radius.cwiseInverse(), all = magnitude.cwiseProduct(per_length);
  Vector acting(all.size());
  for (Eigen::Index i = 0; i < all.size(); i += 3)
    acting.segment<3>(i).setConstant(all.segment<3>(i).maxCoeff());
  for (const Rotor& rotor : model.rotors)
    if (const int turn = rotor.unknown, shift = model.nodes.first[static_cast<std::size_t>(rotor.node)];
        turn >= 0 && shift >= 0) {
      const double larger_one = std::max(acting[turn], acting[shift]);
      acting.segment<3>(turn).setConstant(larger_one);
      acting.segment<3>(shift).setConstant(larger_one);
    }
  const double least = std::max(step_rounding / allowed_residual * all.maxCoeff(), 1e-300);
  return force.cwiseProduct(per_length).cwiseAbs().cwiseQuotient(acting.cwiseMax(least)).maxCoeff();
}

/// The largest |c + A gamma| of a row without bounds, over the length of its gradient, m.
double row_residual(const ContactStep& own, const RigidSystem& system, const Vector& gamma) {
  const RigidModel& model = own.step.model;
  const Vector ones = Vector::Ones(model.unknowns),
               squares = squared_rows(scaled(system.jacobian, model.radius.cwiseInverse()), ones);
  Vector missed = system.gap(gamma).cwiseAbs();
  for (const BoundedRow& bounded : own.bounded) missed[bounded.row] = 0;
  for (Eigen::Index row = 0; row < missed.size(); ++row)
    if (squares[row] > 0) missed[row] /= std::sqrt(squares[row]);
  return missed.size() > 0 ? missed.maxCoeff() : 0;
}

struct StepSearch {
  const Scene& scene;
  ContactStep step;
  Cones cones;
  Vector velocity, gamma;
  bool features_kept = false;
  int iterations = 0;
  double correction = infinity;  // of the displacement

  /// Newton until its corrections are at rounding.
  bool run() {
    constexpr int most = 60;
    constexpr double near = 1e-3, converged = allowed_residual, rounding = 1e-14;
    double previous = infinity;
    bool came_near = false;  // from then on features are those of the iterates alone
    for (; iterations < most; ++iterations) {
      came_near = came_near || correction < near;
      step.find_contacts(velocity, features_kept || !came_near);
      Linearised linear;
      Vector increment, next;
      if (!linear.compute(step, velocity, gamma) || !linear.solve(cones, step, increment, next)) return false;
      if (cones.spent()) return false;
      velocity += velocity_change(step.step, velocity, increment);
      gamma = next;
      correction = increment.cwiseProduct(step.step.model.radius).cwiseAbs().maxCoeff() /
                   scale_of(step, velocity, gamma);
      if (!std::isfinite(correction)) return false;
      if (iterations == most / 2 && !came_near) look_closer();  // features may come and go for want of others
      if (correction <= rounding || (correction < converged && correction > 0.25 * previous)) {
        // What is near at the start alone lets nothing collide.
        if ((came_near || features_kept) && !step.collide(velocity) && !look_closer()) return true;
        came_near = true;
        correction = infinity;
      }
      previous = correction;
    }
    return false;
  }

  /// Forces that nothing balances, and the sum of the absolute contributions to them.
  Vector unbalanced(const RigidSystem& system, Vector& magnitude) const {
    magnitude = system.magnitude;
    return system.force(gamma) - step.push(velocity, magnitude);
  }

  /// m/s, of contacts and of bounded rows.
  double law_residual(const RigidSystem& system) const {
    return larger(step.law_residual(cones.law(), velocity), step.bounds_residual(system, gamma));
  }

  /// What is left of the equations, of their scales, by the features that are there now.
  void measure(ContactJudgement& j) {
    report(step.step, velocity, gamma, j);
    const RigidSystem system = system_at(step.step, velocity, gamma);
    Vector magnitude;
    const Vector force = unbalanced(system, magnitude);
    const Vector per_length = step.step.model.radius.cwiseInverse();
    j.residual = force.cwiseProduct(per_length).cwiseAbs().maxCoeff() /
                 std::max(magnitude.cwiseProduct(per_length).maxCoeff(), 1e-300);
    j.contacts = static_cast<int>(std::count_if(step.contacts.begin(), step.contacts.end(),
                                                [](const JudgedContact& each) { return each.force[0] > 0; }));
    j.all = step.contacts;
    j.law = law_residual(system);
    const double scale = scale_of(step, velocity, gamma);
    step.find_contacts(velocity, features_kept);  // others may be in each other by now
    j.law = larger(j.law, step.law_residual(cones.law(), velocity)) * step.step.h / scale;
  }

  /// What is in others where it ends, or is so by features that are not known; empty if nothing is.
  std::string overlap() const {
    Findings deep;
    depths_of(step, scene, velocity, deep);
    if (deep.refuted.empty()) return unknown_features(step, scene, velocity);
    std::ostringstream text;
    text << deep.refuted.front().what << " in each other by " << deep.refuted.front().number;
    return text.str();
  }

  /// Begins where somebody claims that the step ends, with the forces that are claimed.
  void take(const StepClaim& claim, bool also_start) {
    RigidStep ended = step.step;
    ended.start = claim.end;
    const Vector start = step.step.start_velocity();
    velocity = start + (ended.start_velocity() - start) / step.step.extension();
    if (Vector told; gather_forces(claim, step.step.model, told) && told.allFinite()) gamma = told;
    step.find_contacts(velocity, also_start);
    step.take_forces(claim.contacts, velocity);
  }

  /// What is left of the equations where it is, as Judgement::claim_residual.
  double left() {
    if (!velocity.allFinite()) return std::nan("");
    step.collide(velocity);
    const RigidSystem system = system_at(step.step, velocity, gamma);
    Vector magnitude;
    const Vector force = unbalanced(system, magnitude);
    const double missed = larger(row_residual(step, system, gamma), step.step.h * law_residual(system));
    const double scale = std::max(scale_of(step, velocity, gamma), step.free_displacement());
    return overlap().empty() ? larger(force_residual(step.step.model, force, magnitude), missed / scale)
                             : infinity;
  }

  /// Whether shapes are in each other where it ends, and part by ways that it did not know.
  bool look_closer() {
    Findings findings;
    bool any = false;
    for (const auto& [sides, ways] : depths_of(step, scene, velocity, findings)) {
      constexpr double same = 0.98;  // cosine: a fifth of a radian
      const Vec3& way = ways.front();
      std::vector<Vec3>& known = step.deep[sides];
      if (std::any_of(known.begin(), known.end(), [&](const Vec3& one) { return one.dot(way) > same; }))
        continue;
      known.push_back(way);
      any = true;
    }
    return any;
  }
};

}  // namespace

void require_judged(const Scene& scene, const State& state, double h, Friction friction) {
  law_of(friction);
  ContactStep(scene, state, h);
}

ContactJudgement contact_newton(const Scene& scene, const State& state, double h, Friction friction,
                                ConeSolver solver, const ContactStart& start) {
  const FrictionLaw law = law_of(friction);
  Clock clock;
  StepSearch search{scene,
                    {scene, state, h, start.map ? std::optional(*start.map) : std::nullopt},
                    {law, solver, {start.work, start.poll}},
                    {},
                    {}};
  ContactStep& own = search.step;
  search.velocity = own.step.start_velocity();
  search.gamma.setZero(own.step.model.rows());
  search.features_kept = start.features_kept;
  ContactJudgement j;
  if (start.near != nullptr) {
    StepSearch as_claimed = search;
    as_claimed.take(*start.near, false);
    j.claim_residual = as_claimed.left();
    search.take(*start.near, true);
  }
  const bool converged = search.run();
  search.measure(j);
  j.correction = search.correction;
  j.iterations = search.iterations;
  j.rank = -1;
  std::ostringstream reason;
  if (search.cones.spent())
    reason << "gave up after " << search.iterations << " iterations: " << start.work
           << " factorisations of the contacts' problem are spent";
  else if (!converged)
    reason << "stopped after " << search.iterations << " iterations, the last correction " << j.correction;
  const auto say = [&reason]() -> std::ostream& { return reason << (reason.str().empty() ? "" : ", "); };
  for (const auto& [name, off] :
       {std::pair{"forces", j.residual}, {"constraints", j.infeasible}, {"contacts", j.law}})
    if (converged && !(off <= allowed_residual))
      say() << name << " off by " << off << ", allowed " << allowed_residual;
  if (converged)
    if (const std::string text = search.overlap(); !text.empty()) say() << text;
  j.reason = reason.str();
  j.outcome = j.reason.empty() ? Outcome::ok : Outcome::not_converged;
  j.seconds = clock.seconds();
  return j;
}

}  // namespace pbd::reference
