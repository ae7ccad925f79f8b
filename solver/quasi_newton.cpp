#include "quasi_newton.h"

#include <algorithm>

namespace pbd {
namespace {

double dot(const Points& a, const Points& b) {
  return (a.array() * b.array()).sum();
}

}  // namespace

void QuasiNewton::factor(const StepMap& map, const std::vector<double>& inverse_mass,
                         const std::vector<Eigen::Triplet<double>>& stiffness) {
  column_.clear();
  order_ = 0;
  for (const double inverse : inverse_mass) column_.push_back(inverse > 0 ? order_++ : -1);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t node = 0; node < column_.size(); ++node)
    if (column_[node] >= 0) entries.emplace_back(column_[node], column_[node], 1 / inverse_mass[node]);
  for (const auto& entry : stiffness) {
    const int row = column_[static_cast<std::size_t>(entry.row())];
    const int column = column_[static_cast<std::size_t>(entry.col())];
    if (row >= 0 && column >= 0)
      entries.emplace_back(std::max(row, column), std::min(row, column), entry.value());
  }
  Eigen::SparseMatrix<double> matrix(order_, order_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factor_->compute(matrix);
  right_.resize(order_, 3);
  d_ = map.d;
  s_ = map.s;
  forget();
}

void QuasiNewton::solve(const Points& right, Points& result) {
  for (std::size_t node = 0; node < column_.size(); ++node)
    if (column_[node] >= 0)
      right_.row(column_[node]) = right.col(static_cast<Eigen::Index>(node)).transpose();
  right_ = factor_->solve(right_);
  for (std::size_t node = 0; node < column_.size(); ++node) {
    const auto column = static_cast<Eigen::Index>(node);
    if (column_[node] >= 0)
      result.col(column) = right_.row(column_[node]).transpose();
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
  std::vector<double> alpha(static_cast<std::size_t>(used));
  Points q = -gradient;
  for (int k = 0; k < used; ++k) {  // newest first
    const auto slot = static_cast<std::size_t>((count_ - 1 - k) % memory_);
    alpha[static_cast<std::size_t>(k)] = dot(steps_[slot], q) / curvature_[slot];
    q -= alpha[static_cast<std::size_t>(k)] * changes_[slot];
  }
  result.resizeLike(gradient);
  solve(q, result);
  for (int k = used - 1; k >= 0; --k) {
    const auto slot = static_cast<std::size_t>((count_ - 1 - k) % memory_);
    const double beta = dot(changes_[slot], result) / curvature_[slot];
    result += (alpha[static_cast<std::size_t>(k)] - beta) * steps_[slot];
  }
}

}  // namespace pbd
