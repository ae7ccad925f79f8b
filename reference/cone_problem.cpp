#include "cone_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

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

/// P_K of the problem whose impulses are divided by `scale`.
VectorXd project(const ConeProblem& problem, FrictionLaw law, const VectorXd& point, const VectorXd& scale) {
  VectorXd nearest(point.size());
  for (int i = 0; i < problem.contacts(); ++i)
    nearest.segment<3>(3 * i) = project_contact(law, point.segment<3>(3 * i), problem.friction(i));
  for (int k = 0; k < problem.bounded(); ++k) {
    const int row = 3 * problem.contacts() + k;
    nearest(row) = std::clamp(point(row), problem.lower(k) / scale(row), problem.upper(k) / scale(row));
  }
  return nearest;
}

/// The part of a bounded row's velocity that no impulse within the bounds can answer.
double unanswered(const ConeProblem& problem, int bounded, double velocity) {
  if (velocity < 0 && problem.upper(bounded) == infinity) return velocity;
  if (velocity > 0 && problem.lower(bounded) == -infinity) return velocity;
  return 0;
}

/// |(p - l) u| where u opens the lower bound's side, |(h - p) u| where it opens the upper one's.
double bounded_gap(const ConeProblem& problem, int bounded, double impulse, double velocity) {
  if (velocity == 0) return 0;
  return std::abs(velocity * (impulse - (velocity > 0 ? problem.lower(bounded) : problem.upper(bounded))));
}

/// s of the equilibrated problem, one per row.
VectorXd equilibrating(const ConeProblem& problem) {
  VectorXd scale = VectorXd::Ones(problem.rows());
  const VectorXd diagonal = problem.delassus.diagonal();
  for (int i = 0; i < problem.contacts(); ++i) {
    const double mean = diagonal.segment<3>(3 * i).mean();
    if (mean > 0) scale.segment<3>(3 * i).setConstant(1 / std::sqrt(mean));
  }
  for (int row = 3 * problem.contacts(); row < problem.rows(); ++row)
    if (diagonal(row) > 0) scale(row) = 1 / std::sqrt(diagonal(row));
  return scale;
}

}  // namespace

VectorXd natural_map(const ConeProblem& problem, FrictionLaw law, const VectorXd& impulse) {
  const VectorXd shifted = shifted_velocity(problem, law, problem.velocity(impulse));
  return impulse - project(problem, law, impulse - shifted, VectorXd::Ones(problem.rows()));
}

ConeMeasures measure_cone(const ConeProblem& problem, FrictionLaw law, const VectorXd& impulse) {
  const auto over = [](double value, double scale) { return scale > 0 ? value / scale : value; };
  const VectorXd velocity = problem.velocity(impulse);
  const VectorXd shifted = shifted_velocity(problem, law, velocity);
  const double size = problem.free_velocity.stableNorm();
  const VectorXd one = VectorXd::Ones(problem.rows()), scale = equilibrating(problem);
  double from_dual = 0, gap = 0;
  for (int i = 0; i < problem.contacts(); ++i) {
    const Vector3d u = shifted.segment<3>(3 * i);
    from_dual +=
        project_contact(law, -u, problem.friction(i)).squaredNorm();  // Moreau: u - P_K*(u) = -P_K(-u)
    gap += impulse.segment<3>(3 * i).dot(u);
  }
  for (int k = 0; k < problem.bounded(); ++k) {
    const int row = 3 * problem.contacts() + k;
    const double missed = unanswered(problem, k, shifted(row));
    from_dual += missed * missed;
    if (missed == 0) gap += bounded_gap(problem, k, impulse(row), shifted(row));
  }
  const double quadratic = impulse.dot(problem.delassus * impulse);
  const double linear = impulse.dot(problem.free_velocity);
  ConeMeasures m;
  m.natural_residual = over((impulse - project(problem, law, impulse - shifted, one)).stableNorm(), size);
  const VectorXd scaled_impulse = impulse.cwiseQuotient(scale);
  m.scaled_residual =
      over((scaled_impulse - project(problem, law, scaled_impulse - scale.cwiseProduct(shifted), scale))
               .stableNorm(),
           scale.cwiseProduct(problem.free_velocity).stableNorm());
  const VectorXd summed = problem.delassus.cwiseAbs() * impulse.cwiseAbs() + problem.free_velocity.cwiseAbs();
  constexpr double epsilon = 2 * std::numeric_limits<double>::epsilon();  // one of each sum, one of the map
  m.rounding = epsilon * std::max(over((summed + impulse.cwiseAbs()).stableNorm(), size),
                                  over((scale.cwiseProduct(summed) + scaled_impulse.cwiseAbs()).stableNorm(),
                                       scale.cwiseProduct(problem.free_velocity).stableNorm()));
  m.gap = over(std::abs(gap), std::abs(quadratic) + std::abs(linear));
  m.impulse_distance = over((impulse - project(problem, law, impulse, one)).norm(), impulse.norm());
  m.velocity_distance = over(std::sqrt(from_dual), size);
  m.objective = quadratic / 2 + linear;
  return m;
}

EquilibratedCone equilibrate(const ConeProblem& problem) {
  EquilibratedCone scaled{problem, equilibrating(problem)};
  scaled.problem.delassus = reference::scaled(scaled.scale, problem.delassus, scaled.scale);
  scaled.problem.free_velocity = scaled.scale.cwiseProduct(problem.free_velocity);
  const VectorXd bounded = scaled.scale.tail(problem.bounded());
  scaled.problem.lower = problem.lower.cwiseQuotient(bounded);
  scaled.problem.upper = problem.upper.cwiseQuotient(bounded);
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
