#include "contact_newton.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "contact_check.h"
#include "error.h"
#include "newton_search.h"
#include "step_equations.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

FrictionLaw law_of(Friction friction) {
  if (friction == Friction::coulomb) return FrictionLaw::coulomb;
  if (friction == Friction::cone) return FrictionLaw::cone;
  throw SetupError("method.friction",
                   "`" + std::string(friction_names[static_cast<std::size_t>(friction)]) + "`",
                   "coulomb, cone: the laws that the judges of contact know");
}

constexpr double allowed = 1e-9;  // of the displacement, or of the largest balanced force

/// What corrections and gaps are measured by, m: the displacement, or if that is more what is `allowed` of it
/// to know the rounding of positions, and of what forces that balance each other make of them.
double scale_of(const ContactStep& own, const Vector& velocity, const Vector& gamma) {
  Vector magnitude = system_at(own.step, velocity, gamma).magnitude;
  own.push(velocity, magnitude);
  const RigidModel& model = own.step.model;
  const double h = own.step.h;
  const double by_forces =
      h * h * magnitude.cwiseProduct(model.radius).cwiseQuotient(model.inertia).maxCoeff();
  const double places = own.step.end(velocity).x.cwiseAbs().maxCoeff();
  return std::max(displacement_of(own.step, velocity), step_rounding * std::max(places, by_forces) / allowed);
}

/// What of bodies, nodes and triangles is deeper in others than where the step begins, by their support
/// functions: the features may all have been overlooked.
WaysOut depths_of(const ContactStep& own, const Scene& scene, const Vector& velocity, Findings& findings) {
  if (own.contact.collider.empty() && own.contact.triangle.empty() && !own.contact.nodes_touch) return {};
  const State end = own.step.end(velocity);
  const StepClaim claim{.scene = scene, .start = own.step.start, .end = end, .h = own.step.h};
  constexpr double overlooked = 1e-6;  // edges and sides that are `parallel`, what lies `flat`
  return check_depths(claim, own.contact, 0, overlooked, findings);
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
    constexpr double near = 1e-3, converged = allowed, rounding = 1e-14;
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
  if (const StepClaim* near = start.near; near != nullptr) {
    RigidStep ended = own.step;
    ended.start = near->end;
    search.velocity = ended.start_velocity();
    if (Vector told; gather_forces(*near, own.step.model, told) && told.allFinite()) search.gamma = told;
    own.find_contacts(search.velocity, true);
    own.take_forces(near->contacts, search.velocity);
  }
  const bool converged = search.run();
  ContactJudgement j;
  report(own.step, search.velocity, search.gamma, j);
  const RigidSystem system = system_at(own.step, search.velocity, search.gamma);
  Vector magnitude = system.magnitude;
  const Vector force = system.force(search.gamma) - own.push(search.velocity, magnitude);
  const Vector per_length = own.step.model.radius.cwiseInverse();
  j.residual = force.cwiseProduct(per_length).cwiseAbs().maxCoeff() /
               std::max(magnitude.cwiseProduct(per_length).maxCoeff(), 1e-300);
  j.contacts = static_cast<int>(std::count_if(own.contacts.begin(), own.contacts.end(),
                                              [](const JudgedContact& each) { return each.force[0] > 0; }));
  j.all = own.contacts;
  j.law = larger(own.law_residual(law, search.velocity), own.bounds_residual(system, search.gamma));
  const double scale = scale_of(own, search.velocity, search.gamma);
  own.find_contacts(search.velocity, start.features_kept);  // others may be in each other by now
  j.law = larger(j.law, own.law_residual(law, search.velocity)) * h / scale;
  j.correction = search.correction;
  j.iterations = search.iterations;
  j.rank = -1;
  std::ostringstream reason;
  const auto say = [&reason]() -> std::ostringstream& {
    if (!reason.str().empty()) reason << ", ";
    return reason;
  };
  if (search.cones.spent())
    say() << "gave up after " << search.iterations << " iterations: " << start.work
          << " factorisations of the contacts' problem are spent";
  else if (!converged)
    say() << "stopped after " << search.iterations << " iterations, the last correction " << j.correction;
  for (const auto& [name, off] :
       {std::pair{"forces", j.residual}, {"constraints", j.infeasible}, {"contacts", j.law}})
    if (converged && !(off <= allowed)) say() << name << " off by " << off << ", allowed " << allowed;
  Findings deep;
  if (converged) depths_of(own, scene, search.velocity, deep);
  if (!deep.refuted.empty())
    say() << deep.refuted.front().what << " in each other by " << deep.refuted.front().number;
  j.reason = reason.str();
  j.outcome = j.reason.empty() ? Outcome::ok : Outcome::not_converged;
  j.seconds = clock.seconds();
  return j;
}

}  // namespace pbd::reference
