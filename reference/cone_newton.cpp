#include "cone_newton.h"

#include <cmath>

namespace pbd::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// D and I - D + D G W at `impulse`.
struct Derivative {
  SparseMatrix projection, matrix;
};

/// Of a block a contact and an entry a bounded row.
SparseMatrix block_diagonal(const ConeProblem& p, const std::function<Matrix3d(int)>& block,
                            const std::function<double(int)>& entry) {
  Triplets entries;
  for (int i = 0; i < p.contacts(); ++i) {
    const Matrix3d b = block(i);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        if (b(row, column) != 0) entries.emplace_back(3 * i + row, 3 * i + column, b(row, column));
  }
  for (int k = 0; k < p.bounded(); ++k)
    if (const int row = 3 * p.contacts() + k; entry(k) != 0) entries.emplace_back(row, row, entry(k));
  return from_triplets(p.rows(), p.rows(), entries);
}

Derivative derivative(const ConeProblem& p, FrictionLaw law, const VectorXd& impulse) {
  const VectorXd u = p.velocity(impulse), shifted = shifted_velocity(p, law, u);
  Derivative d;
  d.projection = block_diagonal(
      p,
      [&](int i) {
        return cone_projection_derivative(impulse.segment<3>(3 * i) - shifted.segment<3>(3 * i),
                                          p.friction(i));
      },
      [&](int k) {
        const int row = 3 * p.contacts() + k;
        const double point = impulse(row) - shifted(row);
        return p.lower(k) < point && point < p.upper(k) ? 1.0 : 0.0;
      });
  const SparseMatrix shift = block_diagonal(
      p,
      [&](int i) {
        Matrix3d g = Matrix3d::Identity();
        const Vector2d slip = u.segment<2>(3 * i + 1);
        if (law == FrictionLaw::coulomb && slip.norm() > 0)
          g.block<1, 2>(0, 1) = p.friction(i) * slip.normalized().transpose();
        return g;
      },
      [](int) { return 1.0; });
  SparseMatrix identity(d.projection.rows(), d.projection.cols());
  identity.setIdentity();
  const SparseMatrix outer = d.projection * shift;
  d.matrix = outer * p.delassus;
  d.matrix += identity - d.projection;
  return d;
}

/// Solves A d = b by the regular A + e D, refined while that helps.
bool newton_step(const Derivative& at, double regularisation, const VectorXd& b, VectorXd& step) {
  SparseMatrix regular = at.matrix + regularisation * at.projection;
  regular.makeCompressed();
  SparseLu lu;
  if (!lu.compute(regular)) return false;
  step = lu.solve(b);
  if (!step.allFinite()) return false;
  VectorXd missing = b - at.matrix * step;
  for (int pass = 0; pass < 5; ++pass) {
    const VectorXd refined = step + lu.solve(missing);
    const VectorXd left = b - at.matrix * refined;
    if (!(left.norm() < 0.5 * missing.norm())) break;
    step = refined, missing = left;
  }
  return true;
}

}  // namespace

int cone_newton(const ConeProblem& original, FrictionLaw law, double target, VectorXd& impulse,
                ConeWork* work) {
  constexpr int most_steps = 200;
  constexpr double smallest = 1e-13, largest = 1;  // of e, where W's blocks have a mean diagonal of 1
  EquilibratedCone scaled = equilibrate(original);
  const VectorXd start = impulse.cwiseQuotient(scaled.scale);
  const double weight = std::sqrt(start.norm() / scaled.problem.velocity(start).norm());
  if (weight > 0 && std::isfinite(weight)) {
    scaled.problem.delassus *= weight;
    scaled.problem.free_velocity *= weight;
  }
  double rounding = 0;  // of the last residual
  const auto residual = [&](const VectorXd& r) {
    const ConeMeasures measures = measure_cone(original, law, scaled.scale.cwiseProduct(r));
    rounding = measures.rounding;
    return measures.residual();
  };
  VectorXd at = start, best = at;
  double best_residual = residual(at), regularisation = 1e-10;
  int steps = 0;
  while (steps < most_steps && best_residual > std::max(target, rounding)) {
    if (work != nullptr && !work->spend(static_cast<double>(original.delassus.nonZeros()))) break;
    const VectorXd map = natural_map(scaled.problem, law, at);
    const Derivative d = derivative(scaled.problem, law, at);
    VectorXd step;
    bool fell = false;
    ++steps;
    if (newton_step(d, regularisation, -map, step))
      for (double length = 1; length > 1e-3 && !fell; length /= 2) {
        const VectorXd next = at + length * step;
        fell = natural_map(scaled.problem, law, next).norm() <= (1 - 1e-4 * length) * map.norm();
        if (fell) at = next;
      }
    if (const double now = residual(at); now < best_residual) best = at, best_residual = now;
    if (!fell && regularisation >= largest) break;
    regularisation = fell ? std::max(smallest, regularisation / 10) : 100 * regularisation;
  }
  impulse = scaled.scale.cwiseProduct(best);
  return steps;
}

}  // namespace pbd::reference
