#include <algorithm>

#include "cones/cone_solvers.h"
#include "harness/rows_of_step.h"
#include "studies/contact/late_friction.h"

namespace pbdcheck {

using namespace pbd;
using namespace reference;
using Eigen::VectorXd;

namespace {

ConeSolution solve_placed(const ConeProblem& problem) {
  constexpr double certain = 1e-12;
  return relax_cone("direct", {problem, FrictionLaw::coulomb, certain, most_sweeps});
}

/// Brakes the slip of each contact once.
void brake(const ConeProblem& problem, VectorXd& impulse) {
  for (int i = 0; i < problem.contacts(); ++i) {
    const Eigen::Vector2d slip = problem.velocity(impulse).segment<2>(3 * i + 1);
    if (slip.norm() == 0) continue;
    const Eigen::Vector2d along = slip.normalized();
    const Eigen::Matrix2d own = problem.delassus.block(3 * i + 1, 3 * i + 1, 2, 2);
    const double stops = slip.norm() / along.dot(own * along);
    impulse.segment<2>(3 * i + 1) = -std::min(stops, problem.friction[i] * impulse[3 * i]) * along;
  }
}

}  // namespace

PlacedFriction step_with(FrictionPlace place, const Scene& scene, double h, State& state) {
  StepRows step(scene, state, h, Friction::coulomb);
  step.linearise(Points::Zero(3, step.v_free().cols()));
  const ConeProblem problem = cone_problem(step.rows(), step.v_free());
  ConeProblem smooth = problem;
  smooth.friction.setZero();
  const ConeSolution solved = solve_placed(place == FrictionPlace::within ? problem : smooth);
  VectorXd impulse = solved.impulse;
  State next = step.end(moved_by(step.rows(), step.v_free(), impulse));
  const VectorXd u = problem.velocity(impulse);
  if (place == FrictionPlace::end) {
    brake(problem, impulse);
    const State braked = step.end(moved_by(step.rows(), step.v_free(), impulse));
    next.v = braked.v;
    for (Eigen::Index body = 0; body < next.spin.cols(); ++body) {  // in the frame where the body is
      const auto i = static_cast<std::size_t>(body);
      next.spin.col(body) =
          next.orientation[i].conjugate() * (braked.orientation[i] * Vec3(braked.spin.col(body)));
    }
  }
  state = next;
  PlacedFriction found;
  found.sweeps = solved.iterations;
  found.solved = solved.outcome == Outcome::ok;
  found.residual = measure_cone(problem, FrictionLaw::coulomb, impulse).natural_residual;
  if (problem.contacts() > 0)
    found.penetration =
        larger(0, -h * u(Eigen::seqN(0, problem.contacts(), 3)).minCoeff<Eigen::PropagateNaN>());
  return found;
}

}  // namespace pbdcheck
