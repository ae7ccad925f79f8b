#include "kkt.h"

#include <algorithm>
#include <cmath>

namespace pbd::reference {
namespace {

/// J with unit mass and rows of unit length in the metric of inverse masses: R J M^-1/2.
SparseMatrix weighed(const Model& model, const SparseMatrix& jacobian, const Vector& row_scale) {
  const Vector inverse_root = model.mass.cwiseSqrt().cwiseInverse();
  return scaled(row_scale, jacobian, inverse_root);
}

Vector row_scales(const Model& model, const SparseMatrix& jacobian) {
  return inverse_effective_mass(model, jacobian).unaryExpr([](double n) {
    return n > 0 ? 1 / std::sqrt(n) : 1.0;
  });
}

/// The scaled KKT matrix [s M^-1/2 H M^-1/2, J^T; J, 0] of the kept rows; s makes its first block of order
/// one.
struct System {
  Vector unknown_scale, row_scale;
  double s;
  SparseMatrix matrix;
};

System make_system(const Objective& o, const Derivatives& d, const std::vector<int>& keep) {
  const int n = o.model->unknowns, rows = static_cast<int>(keep.size());
  System k{o.model->mass.cwiseSqrt().cwiseInverse(), row_scales(*o.model, d.jacobian), 1, {}};
  std::vector<int> position(o.model->hard_rows, -1);
  for (int i = 0; i < rows; ++i) position[keep[i]] = i;

  SparseMatrix h = d.hessian;
  h.diagonal() += o.inertia;
  h = scaled(k.unknown_scale, h, k.unknown_scale);
  k.s = 1 / std::max(h.diagonal().cwiseAbs().mean(), 1e-300);
  Triplets entries;
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(h, j); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), j, k.s * it.value());
  const SparseMatrix jacobian = weighed(*o.model, d.jacobian, k.row_scale);
  for (int j = 0; j < n; ++j)
    for (SparseMatrix::InnerIterator it(jacobian, j); it; ++it) {
      const int row = position[it.row()];
      if (row < 0) continue;
      entries.emplace_back(n + row, j, it.value());
      entries.emplace_back(j, n + row, it.value());
    }
  k.matrix = from_triplets(n + rows, n + rows, entries);
  return k;
}

}  // namespace

double Objective::value(const Vector& u, const Multipliers& multipliers) const {
  const Vector offset = u - target;
  return offset.dot(inertia.cwiseProduct(offset)) / 2 - model->force.dot(u) +
         lagrangian(*model, positions(u), multipliers);
}

Vector Objective::gradient(const Vector& u, const Derivatives& d) const {
  return inertia.cwiseProduct(u - target) - model->force + d.gradient;
}

Vector Objective::magnitude(const Vector& u, const Derivatives& d) const {
  return inertia.cwiseProduct((u - target).cwiseAbs()) + model->force.cwiseAbs() + d.magnitude;
}

Vector inverse_effective_mass(const Model& model, const SparseMatrix& jacobian) {
  return squared_rows(jacobian, model.mass.cwiseInverse());
}

std::vector<int> independent_rows(const Model& model, const SparseMatrix& jacobian, double threshold) {
  return independent_rows(weighed(model, jacobian, row_scales(model, jacobian)), threshold);
}

Vector least_norm(const SparseMatrix& jacobian, const Vector& gamma) {
  // Tikhonov's solution, refined until the force is met: it stays in the range of J, hence has least norm.
  // Each refinement adds rounding errors outside the range, divided by the shift.
  constexpr double relative_shift = 1e-6, met = 1e-13;
  SparseMatrix normal = jacobian * jacobian.transpose();
  const double shift = relative_shift * normal.diagonal().maxCoeff();
  for (int i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += shift;
  SparseCholesky factor;
  factor.compute(normal);
  const Vector force = jacobian.transpose() * gamma;
  Vector least = Vector::Zero(gamma.size()), missing = force;
  for (int i = 0; i < 50 && missing.norm() > met * force.norm(); ++i) {
    least += factor.solve(Vector(jacobian * missing));
    missing = force - jacobian.transpose() * least;
  }
  return least;
}

void measure(const Objective& o, const Derivatives& d, const Vector& u, double displacement,
             Judgement& judgement) {
  judgement.residual =
      o.gradient(u, d).cwiseAbs().maxCoeff() / std::max(o.magnitude(u, d).maxCoeff(), 1e-300);
  const Vector squares = squared_rows(d.jacobian, Vector::Ones(u.size()));
  judgement.infeasible = 0;
  for (int i = 0; i < d.hard.size(); ++i) {
    const double length = squares(i) > 0 ? std::sqrt(squares(i)) : 1;
    judgement.infeasible = std::max(judgement.infeasible, std::abs(d.hard(i)) / length / displacement);
  }
}

Polish polish(const Objective& o, Assembly& assembly, const PolishSettings& settings, Vector& u,
              Vector& gamma, const std::function<void(const Vector&)>& shown) {
  constexpr int most = 40;
  constexpr double rounding = 1e-15, converged = 1e-9;
  const Vector start_u = u, start_gamma = gamma;
  Polish result;
  SparseLu lu;
  double previous = std::numeric_limits<double>::infinity();
  for (int it = 0; it < most; ++it) {
    const Points x = o.positions(u);
    const Derivatives& d = assembly.at(x, {gamma, {}});
    const std::vector<int> keep = independent_rows(*o.model, d.jacobian, settings.rank_threshold);
    result.rank = static_cast<int>(keep.size());
    const System k = make_system(o, d, keep);
    const Vector g = o.gradient(u, d) + d.jacobian.transpose() * gamma;
    Vector rhs(k.matrix.rows());
    rhs.head(u.size()) = -k.s * k.unknown_scale.cwiseProduct(g);
    for (std::size_t i = 0; i < keep.size(); ++i) rhs(u.size() + i) = -k.row_scale(keep[i]) * d.hard(keep[i]);
    if (!lu.compute(k.matrix)) break;
    const Vector solution = lu.solve(rhs);
    if (!solution.allFinite()) break;
    const Vector dx = k.unknown_scale.cwiseProduct(solution.head(u.size()));
    u += dx;
    gamma.setZero();
    for (std::size_t i = 0; i < keep.size(); ++i)
      gamma(keep[i]) = -solution(u.size() + i) * k.row_scale(keep[i]) / k.s;
    ++result.iterations;
    shown(u);
    result.correction = dx.cwiseAbs().maxCoeff() / settings.displacement;
    const bool stalled = result.correction > 0.25 * previous;
    if (result.correction <= rounding || (stalled && result.correction < converged)) {
      result.converged = true;
      result.violation =
          assembly.at(o.positions(u), {gamma, {}}).hard.cwiseAbs().maxCoeff() / settings.displacement;
      if (result.rank < o.model->hard_rows) gamma = least_norm(d.jacobian, gamma);
      return result;
    }
    if (result.correction > 1e3 || (it > 6 && result.correction > 4 * previous)) break;
    previous = result.correction;
  }
  u = start_u;
  gamma = start_gamma;
  return result;
}

}  // namespace pbd::reference
