#include "quasi_newton.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

namespace pbd {
namespace {

double dot(const Points& a, const Points& b) {
  return (a.array() * b.array()).sum();
}

}  // namespace

void QuasiNewton::factor(const StepMap& map, const std::vector<double>& inverse_mass,
                         const std::vector<Eigen::Triplet<double>>& stiffness) {
  int order = 0;
  column_.clear();
  for (const double inverse : inverse_mass) column_.push_back(inverse > 0 ? order++ : -1);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t node = 0; node < column_.size(); ++node)
    if (column_[node] >= 0) entries.emplace_back(column_[node], column_[node], 1 / inverse_mass[node]);
  for (const auto& entry : stiffness) {
    const int row = column_[static_cast<std::size_t>(entry.row())];
    const int column = column_[static_cast<std::size_t>(entry.col())];
    if (row >= 0 && column >= 0)
      entries.emplace_back(std::max(row, column), std::min(row, column), entry.value());
  }
  Eigen::SparseMatrix<double> matrix(order, order);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factored(matrix);
  lower_ = factored.matrixL().nestedExpression();
  for (int& column : column_)
    if (column >= 0) column = factored.permutationP().indices()(column);
  work_.setZero(4, order);
  d_ = map.d;
  s_ = map.s;
  forget();
}

/// Both triangles are passed once for all three axes: the time is that of reading L. The diagonal is the
/// first entry of each of its columns.
void QuasiNewton::solve(const Points& right, Points& result) {
  for (std::size_t node = 0; node < column_.size(); ++node)
    if (column_[node] >= 0) work_.col(column_[node]).head<3>() = right.col(static_cast<Eigen::Index>(node));
  const int* const start = lower_.outerIndexPtr();
  const int* const row = lower_.innerIndexPtr();
  const double* const value = lower_.valuePtr();
  for (int j = 0; j < lower_.cols(); ++j) {
    const Eigen::Vector4d solved = work_.col(j) / value[start[j]];
    work_.col(j) = solved;
    for (int k = start[j] + 1; k < start[j + 1]; ++k) work_.col(row[k]) -= value[k] * solved;
  }
  for (auto j = static_cast<int>(lower_.cols()) - 1; j >= 0; --j) {
    Eigen::Vector4d rest = work_.col(j);
    for (int k = start[j] + 1; k < start[j + 1]; ++k) rest -= value[k] * work_.col(row[k]);
    work_.col(j) = rest / value[start[j]];
  }
  for (std::size_t node = 0; node < column_.size(); ++node) {
    const auto column = static_cast<Eigen::Index>(node);
    if (column_[node] >= 0)
      result.col(column) = work_.col(column_[node]).head<3>();
    else
      result.col(column).setZero();
  }
}

void QuasiNewton::learn(const Points& step, const Points& change) {
  const double curvature = dot(step, change);
  constexpr double least = 1e-12;  // of the product of lengths: no curvature is known below
  if (memory_ == 0 || !(curvature > least * step.norm() * change.norm())) return;
  const auto slot = static_cast<std::size_t>(count_ % memory_);
  if (steps_.size() <= slot) {
    steps_.resize(slot + 1);
    changes_.resize(slot + 1);
    curvature_.resize(slot + 1);
  }
  steps_[slot] = step;
  changes_[slot] = change;
  curvature_[slot] = curvature;
  ++count_;
}

void QuasiNewton::direction(const Points& gradient, Points& result) {
  const int used = std::min(count_, memory_);
  alpha_.resize(static_cast<std::size_t>(used));
  q_ = -gradient;
  for (int k = 0; k < used; ++k) {  // newest first
    const auto slot = static_cast<std::size_t>((count_ - 1 - k) % memory_);
    alpha_[static_cast<std::size_t>(k)] = dot(steps_[slot], q_) / curvature_[slot];
    q_ -= alpha_[static_cast<std::size_t>(k)] * changes_[slot];
  }
  result.resizeLike(gradient);
  solve(q_, result);
  for (int k = used - 1; k >= 0; --k) {
    const auto slot = static_cast<std::size_t>((count_ - 1 - k) % memory_);
    const double beta = dot(changes_[slot], result) / curvature_[slot];
    result += (alpha_[static_cast<std::size_t>(k)] - beta) * steps_[slot];
  }
}

}  // namespace pbd
