#include "outer/metric_factor.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace pbd {
namespace {

/// The lower triangle of M + s d K in the pattern of L.
template <int B>
std::vector<Eigen::Matrix<double, B, B>> assemble(const FactorPattern& pattern,
                                                  const std::vector<double>& inverse_mass,
                                                  const std::vector<MetricEntry>& entries) {
  using Block = Eigen::Matrix<double, B, B>;
  std::vector<Block> lower(pattern.row.size(), Block::Zero());
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    if (inverse_mass[node] > 0)
      lower[pattern.start[pattern.column[node]]].diagonal().setConstant(1 / inverse_mass[node]);
  for (const auto& entry : entries) {
    const int row = pattern.column[entry.row], column = pattern.column[entry.column];
    if (row < 0 || column < 0) continue;
    const int left = std::min(row, column);
    const auto first = pattern.row.begin() + pattern.start[left];
    const auto last = pattern.row.begin() + pattern.start[left + 1];
    Block& place = lower[std::lower_bound(first, last, std::max(row, column)) - pattern.row.begin()];
    if constexpr (B == 1)
      place(0, 0) += entry.block.trace() / 3;
    else
      place += row >= column ? entry.block : Block(entry.block.transpose());
  }
  return lower;
}

/// Cholesky factorisation in place, left-looking: column j is reduced by every earlier column that has a
/// block in row j; those wait in a list of the row their next block is in.
template <int B>
void factorise(const FactorPattern& pattern, std::vector<Eigen::Matrix<double, B, B>>& lower) {
  using Block = Eigen::Matrix<double, B, B>;
  const std::vector<int>&start = pattern.start, &row = pattern.row;
  std::vector<int> waiting(pattern.columns(), -1), next(waiting), at(waiting), slot(waiting);
  const auto wait = [&](int column, int position) {
    at[column] = position;
    if (position == start[column + 1]) return;
    next[column] = waiting[row[position]];
    waiting[row[position]] = column;
  };
  constexpr double lost = 1e-14;  // of its node's stiffness: a pivot below is rounding, and counts as stiff
  for (int j = 0; j < pattern.columns(); ++j) {
    const double stiffness = lower[start[j]].trace();
    for (int k = start[j]; k < start[j + 1]; ++k) slot[row[k]] = k;
    for (int earlier = waiting[j]; earlier >= 0;) {
      const int following = next[earlier], first = at[earlier];
      const Block factor = lower[first].transpose();
      for (int k = first; k < start[earlier + 1]; ++k)
        lower[slot[row[k]]].noalias() -= lower[k].lazyProduct(factor);
      wait(earlier, first + 1);
      earlier = following;
    }
    const Eigen::LLT<Block> pivot(lower[start[j]]);
    const bool definite = pivot.info() == Eigen::Success &&
                          pivot.matrixLLT().diagonal().cwiseAbs2().minCoeff() > lost * stiffness;
    const Block inverse = definite ? Block(pivot.matrixL().solve(Block::Identity()))
                                   : Block(Block::Identity() / std::sqrt(stiffness));
    lower[start[j]] = inverse;
    for (int k = start[j] + 1; k < start[j + 1]; ++k) lower[k] = (lower[k] * inverse.transpose()).eval();
    wait(j, start[j] + 1);
  }
}

}  // namespace

FactorPattern analyse(const std::vector<double>& inverse_mass, const std::vector<MetricEntry>& entries) {
  FactorPattern pattern;
  for (const auto& entry : entries) pattern.pairs.push_back({entry.row, entry.column});
  int count = 0;
  for (const double inverse : inverse_mass) pattern.column.push_back(inverse > 0 ? count++ : -1);
  std::vector<Eigen::Triplet<double>> numbers;
  for (int k = 0; k < count; ++k) numbers.emplace_back(k, k, 1.0);
  for (const auto& entry : entries) {
    const int row = pattern.column[entry.row], column = pattern.column[entry.column];
    if (row >= 0 && column >= 0) numbers.emplace_back(std::max(row, column), std::min(row, column), 0.0);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(numbers.begin(), numbers.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factored(matrix);
  const auto& lower = factored.matrixL().nestedExpression();
  pattern.start.assign(lower.outerIndexPtr(), lower.outerIndexPtr() + count + 1);
  pattern.row.assign(lower.innerIndexPtr(), lower.innerIndexPtr() + lower.nonZeros());
  for (int& column : pattern.column)
    if (column >= 0) column = factored.permutationP().indices()(column);
  return pattern;
}

bool FactorPattern::is_of(const std::vector<double>& inverse_mass,
                          const std::vector<MetricEntry>& entries) const {
  return !start.empty() &&
         std::equal(column.begin(), column.end(), inverse_mass.begin(), inverse_mass.end(),
                    [](int own, double inverse) { return (own >= 0) == (inverse > 0); }) &&
         std::equal(pairs.begin(), pairs.end(), entries.begin(), entries.end(),
                    [](const auto& pair, const MetricEntry& entry) {
                      return pair[0] == entry.row && pair[1] == entry.column;
                    });
}

double FactorPattern::products() const {
  double sum = 0;
  for (int j = 0; j < columns(); ++j) {
    const double blocks = start[j + 1] - start[j];
    sum += blocks * (blocks + 1) / 2;
  }
  return sum;
}

template <int B>
std::vector<Eigen::Matrix<double, B, B>> factorised(const FactorPattern& pattern,
                                                    const std::vector<double>& inverse_mass,
                                                    const std::vector<MetricEntry>& entries) {
  auto lower = assemble<B>(pattern, inverse_mass, entries);
  factorise<B>(pattern, lower);
  return lower;
}
template std::vector<Eigen::Matrix<double, 1, 1>> factorised(const FactorPattern&, const std::vector<double>&,
                                                             const std::vector<MetricEntry>&);
template std::vector<Eigen::Matrix3d> factorised(const FactorPattern&, const std::vector<double>&,
                                                 const std::vector<MetricEntry>&);

double pivot_ratio(const FactorPattern& pattern, const std::vector<Eigen::Matrix3d>& lower) {
  double least = infinity, largest = 0;
  for (int j = 0; j < pattern.columns(); ++j) {
    const auto diagonal = lower[pattern.start[j]].diagonal();
    least = std::min(least, diagonal.minCoeff());
    largest = std::max(largest, diagonal.maxCoeff());
  }
  return std::pow(least / largest, 2);
}

template <int B, class Real>
void MetricFactor<B, Real>::solve(const FactorPattern& pattern, Points& x) const {
  using Part = Eigen::Matrix<double, B, 3 / B>;  // of one column of L: a vector, or x, y and z side by side
  const std::vector<int>&start = pattern.start, &row = pattern.row;
  const auto part = [&](int column) { return Eigen::Map<Part>(x.col(column).data()); };
  const auto block = [&](int k) { return lower[k].template cast<double>(); };
  for (int j = 0; j < pattern.columns(); ++j) {
    const Part solved = block(start[j]) * part(j);
    part(j) = solved;
    for (int k = start[j] + 1; k < start[j + 1]; ++k) part(row[k]) -= block(k) * solved;
  }
  for (int j = pattern.columns() - 1; j >= 0; --j) {
    Part rest = part(j);
    for (int k = start[j] + 1; k < start[j + 1]; ++k) rest -= block(k).transpose() * part(row[k]);
    part(j) = block(start[j]).transpose() * rest;
  }
}

template <int B, class Real>
FactorReach MetricFactor<B, Real>::reach(const FactorPattern& pattern, int column) const {
  const std::vector<int>&start = pattern.start, &row = pattern.row;
  FactorReach found;
  const auto block = [&](int k) -> Eigen::Matrix3d {
    if constexpr (B == 1)
      return static_cast<double>(lower[k](0, 0)) * Eigen::Matrix3d::Identity();
    else
      return lower[k].template cast<double>();
  };
  // The rows of a column are above it in the tree, and the next of them is its parent.
  for (int j = column;; j = row[start[j] + 1]) {
    found.column.push_back(j);
    if (start[j] + 1 == start[j + 1]) break;
  }
  found.part.assign(found.column.size(), Eigen::Matrix3d::Zero());
  found.part.front().setIdentity();
  for (std::size_t i = 0; i < found.column.size(); ++i) {
    const int j = found.column[i];
    found.part[i] = block(start[j]) * found.part[i];
    std::size_t above = i;
    for (int k = start[j] + 1; k < start[j + 1]; ++k) {
      while (found.column[above] != row[k]) ++above;
      found.part[above].noalias() -= block(k) * found.part[i];
    }
  }
  return found;
}

template struct MetricFactor<1, double>;
template struct MetricFactor<3, float>;
template struct MetricFactor<3, double>;

}  // namespace pbd
