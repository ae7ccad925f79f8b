#include "cone_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pbd::reference {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

VectorXd ConeProblem::velocity(const VectorXd& impulse) const {
  return delassus * impulse + free_velocity;
}

Vector3d project_on_cone(const Vector3d& point, double mu) {
  const double n = point.x(), tau = point.tail<2>().norm();
  if (mu * tau <= -n) return Vector3d::Zero();  // first, or mu = 0 would keep n < 0
  if (tau <= mu * n) return point;
  // On the boundary, along the ray d = (1, mu t/|t|): (point.d / d.d) d.
  const double normal = (n + mu * tau) / (1 + mu * mu);
  Vector3d nearest(normal, 0, 0);
  if (tau > 0) nearest.tail<2>() = mu * normal / tau * point.tail<2>();
  return nearest;
}

Vector3d project_on_pyramid(const Vector3d& point, double mu) {
  const double n = point.x();
  const double large = point.tail<2>().cwiseAbs().maxCoeff(), small = point.tail<2>().cwiseAbs().minCoeff();
  double normal = n;  // by none, one, both of the tangents on their bound
  if (large > mu * normal) normal = (n + mu * large) / (1 + mu * mu);
  if (small > mu * normal) normal = (n + mu * (large + small)) / (1 + 2 * mu * mu);
  if (normal < 0) normal = 0;  // NaN stays
  const double bound = mu * normal;
  return {normal, std::clamp(point.y(), -bound, bound), std::clamp(point.z(), -bound, bound)};
}

Matrix3d cone_projection_derivative(const Vector3d& point, double mu) {
  const double n = point.x(), tau = point.tail<2>().norm();
  if (mu * tau <= -n) return Matrix3d::Zero();
  if (tau < mu * n) return Matrix3d::Identity();
  // Along the ray 1; around the axis the ratio of the circles' radii; along the normal 0.
  const Vector2d t = tau > 0 ? Vector2d(point.tail<2>() / tau) : Vector2d(1, 0);
  const Vector3d ray = Vector3d(1, mu * t.x(), mu * t.y()) / std::sqrt(1 + mu * mu);
  const Vector3d around(0, -t.y(), t.x());
  const double radius = mu * (n + mu * tau) / (1 + mu * mu);
  return ray * ray.transpose() + (tau > 0 ? radius / tau : 0) * around * around.transpose();
}

VectorXd shifted_velocity(const ConeProblem& problem, FrictionLaw law, const VectorXd& velocity) {
  VectorXd shifted = velocity;
  for (int i = 0; law != FrictionLaw::cone && i < problem.contacts(); ++i) {
    const auto slip = velocity.segment<2>(3 * i + 1);
    shifted(3 * i) += problem.friction(i) * (law == FrictionLaw::box ? slip.lpNorm<1>() : slip.norm());
  }
  return shifted;
}

namespace {

/// P_K
Vector3d project_contact(FrictionLaw law, const Vector3d& point, double mu) {
  return law == FrictionLaw::box ? project_on_pyramid(point, mu) : project_on_cone(point, mu);
}

/// r - P_K(r - u~)
VectorXd map_of(FrictionLaw law, const VectorXd& friction, const VectorXd& impulse, const VectorXd& shifted) {
  VectorXd map = impulse;
  for (Eigen::Index i = 0; i < friction.size(); ++i)
    map.segment<3>(3 * i) -=
        project_contact(law, impulse.segment<3>(3 * i) - shifted.segment<3>(3 * i), friction(i));
  return map;
}

/// s of the equilibrated problem, one per row.
VectorXd equilibrating(const ConeProblem& problem) {
  VectorXd scale = VectorXd::Ones(3 * problem.contacts());
  const VectorXd diagonal = problem.delassus.diagonal();
  for (int i = 0; i < problem.contacts(); ++i) {
    const double mean = diagonal.segment<3>(3 * i).mean();
    if (mean > 0) scale.segment<3>(3 * i).setConstant(1 / std::sqrt(mean));
  }
  return scale;
}

}  // namespace

VectorXd natural_map(const ConeProblem& problem, FrictionLaw law, const VectorXd& impulse) {
  return map_of(law, problem.friction, impulse, shifted_velocity(problem, law, problem.velocity(impulse)));
}

ConeMeasures measure_cone(const ConeProblem& problem, FrictionLaw law, const VectorXd& impulse) {
  const auto over = [](double value, double scale) { return scale > 0 ? value / scale : value; };
  const VectorXd velocity = problem.velocity(impulse);
  const VectorXd shifted = shifted_velocity(problem, law, velocity);
  const double size = problem.free_velocity.stableNorm();
  double from_cone = 0, from_dual = 0;
  for (int i = 0; i < problem.contacts(); ++i) {
    const Vector3d r = impulse.segment<3>(3 * i), u = shifted.segment<3>(3 * i);
    from_cone += (r - project_contact(law, r, problem.friction(i))).squaredNorm();
    from_dual +=
        project_contact(law, -u, problem.friction(i)).squaredNorm();  // Moreau: u - P_K*(u) = -P_K(-u)
  }
  const double quadratic = impulse.dot(problem.delassus * impulse);
  const double linear = impulse.dot(problem.free_velocity);
  ConeMeasures m;
  m.natural_residual = over(map_of(law, problem.friction, impulse, shifted).stableNorm(), size);
  const VectorXd scale = equilibrating(problem);
  m.scaled_residual = over(
      map_of(law, problem.friction, impulse.cwiseQuotient(scale), scale.cwiseProduct(shifted)).stableNorm(),
      scale.cwiseProduct(problem.free_velocity).stableNorm());
  m.gap = over(std::abs(impulse.dot(shifted)), std::abs(quadratic) + std::abs(linear));
  m.impulse_distance = over(std::sqrt(from_cone), impulse.norm());
  m.velocity_distance = over(std::sqrt(from_dual), size);
  m.objective = quadratic / 2 + linear;
  return m;
}

EquilibratedCone equilibrate(const ConeProblem& problem) {
  EquilibratedCone scaled{problem, equilibrating(problem)};
  scaled.problem.delassus = reference::scaled(scaled.scale, problem.delassus, scaled.scale);
  scaled.problem.free_velocity = scaled.scale.cwiseProduct(problem.free_velocity);
  return scaled;
}

void certify(const ConeProblem& problem, FrictionLaw law, double tolerance, ConeSolution& solution) {
  solution.velocity = problem.velocity(solution.impulse);
  solution.measures = measure_cone(problem, law, solution.impulse);
  // u~ is from K* by the natural map at most; where it is not, impulses are so large that rounding hides u~.
  const double residual = solution.measures.residual(), outside = solution.measures.velocity_distance;
  const bool finite = std::isfinite(problem.free_velocity.norm()) &&
                      std::isfinite(solution.velocity.norm()) && std::isfinite(solution.measures.gap);
  const bool reached = finite && residual <= tolerance && outside <= tolerance;  // NaN is not
  solution.outcome = reached ? Outcome::ok : Outcome::not_converged;
  if (reached) solution.reason.clear();
  if (!reached && solution.reason.empty()) {
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(),
                  "natural residual %.2g, velocity %.2g from the dual cone%s, asked for %.2g", residual,
                  outside, finite ? "" : ", not finite", tolerance);
    solution.reason = text.data();
  }
}

}  // namespace pbd::reference
