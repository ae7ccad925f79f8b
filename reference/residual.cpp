#include "residual.h"

#include <cmath>
#include <limits>

#include "dense.h"
#include "energies.h"

namespace pbd::reference {
namespace {

constexpr double roundoff = std::numeric_limits<double>::epsilon();

/// Jacobian by the positions of the element's nodes of finite mass, times W^1/2: R x 12, zero elsewhere.
using Directions = Eigen::Matrix<double, Eigen::Dynamic, 12, 0, 6, 12>;

Directions directions_of(const Model& model, const Element& e, const Local& local) {
  Directions j = Directions::Zero(e.rows, 12);
  for (int a = 0; a < e.nodes; ++a) {
    const int unknown = model.unknown(e, a);
    if (unknown < 0) continue;
    const double root = 1 / std::sqrt(model.mass(unknown));
    for (int q = 0; q < e.columns; ++q)
      j.middleCols(3 * a, 3) += root * e.weight(a, q) * local.jacobian.middleCols(3 * q, 3);
  }
  return j;
}

/// Least squares |A q - b| whose columns are impulses in the metric of N_ii: q_i = N_ii^1/2 p_i.
struct Squares {
  Triplets entries;
  std::vector<double> right;
  int columns = 0;
  double rounding_squared = 0;
};

/// Appends one element's rows and columns. N_ii is singular where nothing moves the constraint: its value
/// then weighs with the mass of all nodes.
void add(const Model& model, const Element& e, const Local& local, const Points& x, double h, double all_mass,
         Squares& s) {
  const Directions j = directions_of(model, e, local);
  RowMatrix sigma = RowMatrix::Zero(e.rows, e.rows);
  if (!e.hard()) sigma = inverse(e.stiffness) / (h * h);
  const RowMatrix n = j * j.transpose() + sigma;
  const SymmetricEigen eigen = symmetric_eigen(n);
  constexpr double definite = 1e-14;
  const bool singular = !(eigen.values(0) > definite * eigen.values(e.rows - 1));
  RowMatrix inverse_root = std::sqrt(all_mass) * RowMatrix::Identity(e.rows, e.rows);
  if (!singular)
    inverse_root =
        eigen.vectors * eigen.values.cwiseSqrt().cwiseInverse().asDiagonal() * eigen.vectors.transpose();

  const int first_row = static_cast<int>(s.right.size());
  const RowVector value = inverse_root * local.value / h;
  for (int k = 0; k < e.rows; ++k) s.right.push_back(-value(k));
  double size = 0;
  for (int a = 0; a < e.nodes; ++a) size = std::max(size, x.col(e.node[a]).cwiseAbs().maxCoeff());
  double gradient_squared = 0;
  for (int q = 0; q < e.columns; ++q)
    for (int a = 0; a < e.nodes; ++a)
      gradient_squared +=
          std::pow(e.weight(a, q), 2) * (inverse_root * local.jacobian.middleCols(3 * q, 3)).squaredNorm();
  s.rounding_squared += std::pow(8 * roundoff * size / h, 2) * gradient_squared;
  if (singular) return;

  const RowMatrix compliance = inverse_root * sigma * inverse_root;
  const Directions push = inverse_root * j;
  for (int k = 0; k < e.rows; ++k) {
    for (int i = 0; i < e.rows; ++i) s.entries.emplace_back(first_row + i, s.columns + k, compliance(i, k));
    for (int a = 0; a < e.nodes; ++a)
      if (const int unknown = model.unknown(e, a); unknown >= 0)
        for (int axis = 0; axis < 3; ++axis)
          s.entries.emplace_back(unknown + axis, s.columns + k, push(k, 3 * a + axis));
  }
  s.columns += e.rows;
}

/// Smallest |A q - b|, and the rounding of finding it.
void solve_squares(const Squares& s, StepResidual& result) {
  const Eigen::Index rows = s.right.size();
  const Eigen::Map<const Vector> b(s.right.data(), rows);
  Vector q = Vector::Zero(s.columns);
  const SparseMatrix a = from_triplets(rows, s.columns, s.entries);
  if (s.columns > 0) q = least_squares(a, b);
  result.residual = (a * q - b).norm();
  result.own = std::sqrt(static_cast<double>(rows)) * roundoff * (q.norm() + b.norm());
}

}  // namespace

StepResidual residual_of(const Scene& scene, const State& start, double h, const State& end) {
  const Model model = make_model(scene);
  const Vector root = model.mass.cwiseSqrt();
  const Vector before = gather(model, start.v), after = gather(model, end.v);
  const Vector forced = h * model.force.cwiseQuotient(model.mass);
  const Vector missing = root.cwiseProduct(after - before - forced);
  double all_mass = 0;
  for (int i = 0; i < model.unknowns; i += 3) all_mass += model.mass(i);

  Squares s;
  s.right.assign(missing.begin(), missing.end());
  Local local;
  for (const Element& e : model.elements) {
    differentiate(e, end.x, local);
    add(model, e, local, end.x, h, all_mass, s);
  }
  StepResidual result;
  solve_squares(s, result);
  result.scale = root.cwiseProduct(after - before).norm() + root.cwiseProduct(forced).norm();
  result.rounding = 8 * roundoff * root.cwiseProduct(before + forced).norm() + std::sqrt(s.rounding_squared);
  return result;
}

}  // namespace pbd::reference
