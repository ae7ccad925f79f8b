#include "outer/metric_factor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace pbd {
namespace {

using Numbers = Eigen::MatrixXd;

template <int B, class Real>
auto panel_of(const FactorPattern& pattern, std::vector<Real>& number, int s) {
  return Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>(
      number.data() + pattern.place[s] * B * B, B * pattern.height(s), B * pattern.width(s));
}
template <int B, class Real>
auto panel_of(const FactorPattern& pattern, const std::vector<Real>& number, int s) {
  return Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>(
      number.data() + pattern.place[s] * B * B, B * pattern.height(s), B * pattern.width(s));
}

/// The lower triangle of M + s d K in the pattern of L.
template <int B>
void assemble(const FactorPattern& pattern, const std::vector<double>& inverse_mass,
              const std::vector<MetricEntry>& entries, std::vector<double>& number) {
  using Block = Eigen::Matrix<double, B, B>;
  number.assign(pattern.place.back() * B * B, 0.0);
  const auto add = [&](int row, int column, const Block& block) {
    const int s = pattern.panel[column];
    panel_of<B>(pattern, number, s)
        .template block<B, B>(B * pattern.row_in(s, row), B * (column - pattern.first[s])) += block;
  };
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    if (inverse_mass[node] > 0)
      add(pattern.column[node], pattern.column[node], Block(Block::Identity() / inverse_mass[node]));
  for (const auto& entry : entries) {
    const int row = pattern.column[entry.row], column = pattern.column[entry.column];
    if (row < 0 || column < 0) continue;
    if constexpr (B == 1)
      add(std::max(row, column), std::min(row, column), Block(entry.block.trace() / 3));
    else
      add(std::max(row, column), std::min(row, column),
          row >= column ? entry.block : Block(entry.block.transpose()));
  }
}

/// One factorisation by panels.
template <int B>
class Factorisation {
 public:
  Factorisation(const FactorPattern& pattern, std::vector<double>& number)
      : pattern_(pattern),
        number_(number),
        waiting_(pattern.panels(), -1),
        next_(waiting_),
        at_(waiting_),
        slot_(pattern.columns()) {}

  void run() {
    for (int s = 0; s < pattern_.panels(); ++s) {
      auto panel = panel_of<B>(pattern_, number_, s);
      stiffness_ = panel.topRows(panel.cols()).diagonal();
      for (int k = 0; k < pattern_.height(s); ++k) slot_[row(s, k)] = k;
      for (int earlier = waiting_[s]; earlier >= 0;) {
        const int following = next_[earlier];
        reduce(panel, s, earlier);
        earlier = following;
      }
      eliminate(panel);
      wait(s, pattern_.width(s));
    }
  }

 private:
  using Block = Eigen::Matrix<double, B, B>;
  using PanelMap = Eigen::Map<Numbers>;

  int row(int s, int k) const {
    const int below = k - pattern_.width(s);
    return below < 0 ? pattern_.first[s] + k : pattern_.row[pattern_.start[s] + below];
  }

  /// The panel's rows from `k` on wait to be multiplied, in a list of the panel that the next is of.
  void wait(int s, int k) {
    at_[s] = k;
    if (k == pattern_.height(s)) return;
    const int other = pattern_.panel[row(s, k)];
    next_[s] = waiting_[other];
    waiting_[other] = s;
  }

  /// Takes off what an earlier panel has in the panel's rows.
  void reduce(PanelMap& panel, int s, int earlier) {
    const int from = at_[earlier], height = pattern_.height(earlier);
    int to = from;
    while (to < height && row(earlier, to) < pattern_.first[s + 1]) ++to;
    const auto other = panel_of<B>(pattern_, number_, earlier);
    const auto rows = other.bottomRows(B * (height - from));
    constexpr Eigen::Index narrow = 12;  // columns, of which a dense product takes longer to begin than to do
    const auto right = rows.topRows(B * (to - from)).transpose();
    if (other.cols() <= narrow)
      product_.noalias() = rows.lazyProduct(right);
    else
      product_.noalias() = rows * right;
    for (int j = from; j < to; ++j) {
      const int column = B * slot_[row(earlier, j)];
      for (int i = j; i < height; ++i)
        panel.template block<B, B>(B * slot_[row(earlier, i)], column) -=
            product_.template block<B, B>(B * (i - from), B * (j - from));
    }
    wait(earlier, to);
  }

  /// The panel's own columns, strip by strip: those of a strip one node after the other, what is right of it
  /// by one product.
  void eliminate(PanelMap& panel) {
    constexpr Eigen::Index strip = 48;  // columns: as narrow as products are still dense ones
    const Eigen::Index width = panel.cols(), height = panel.rows();
    for (Eigen::Index left = 0; left < width; left += strip) {
      const Eigen::Index end = std::min(left + strip, width);
      for (Eigen::Index j = left; j < end; j += B) {
        const Block inverse = inverse_pivot(panel.template block<B, B>(j, j), stiffness_.segment<B>(j).sum());
        panel.template block<B, B>(j, j) = inverse;
        const Eigen::Index below = height - j - B, right = end - j - B;
        auto column = panel.template block<Eigen::Dynamic, B>(j + B, j, below, B);
        column = (column * inverse.transpose()).eval();
        panel.block(j + B, j + B, below, right).noalias() -= column * column.topRows(right).transpose();
      }
      const Eigen::Index right = width - end;
      if (right == 0) continue;
      const auto done = panel.block(end, left, height - end, end - left);
      panel.block(end, end, height - end, right).noalias() -= done * done.topRows(right).transpose();
    }
  }

  static Block inverse_pivot(const Block& block, double stiffness) {
    constexpr double lost = 1e-14;  // of its node's stiffness: a pivot below is rounding, and counts as stiff
    const Eigen::LLT<Block> pivot(block);
    const bool definite = pivot.info() == Eigen::Success &&
                          pivot.matrixLLT().diagonal().cwiseAbs2().minCoeff() > lost * stiffness;
    return definite ? Block(pivot.matrixL().solve(Block::Identity()))
                    : Block(Block::Identity() / std::sqrt(stiffness));
  }

  const FactorPattern& pattern_;
  std::vector<double>& number_;
  std::vector<int> waiting_, next_, at_;  // by panels
  std::vector<int> slot_;                 // in the panel, of each row that it has
  Eigen::VectorXd stiffness_;
  Numbers product_;
};

/// x -= L y of a column of 3 x 3 blocks, `count` numbers high, `stride` apart.
template <class Real>
void take_off(const Real* l, Eigen::Index stride, Eigen::Index count, const Vec3& y, double* x) {
  const double a = y[0], b = y[1], c = y[2];
  const Real *second = l + stride, *third = second + stride;
  for (Eigen::Index i = 0; i < count; ++i)
    x[i] -= static_cast<double>(l[i]) * a + static_cast<double>(second[i]) * b +
            static_cast<double>(third[i]) * c;
}

/// L^T x, in sums side by side.
template <class Real>
Vec3 gathered(const Real* l, Eigen::Index stride, Eigen::Index count, const double* x) {
  constexpr Eigen::Index lanes = 8;
  std::array<std::array<double, lanes>, 3> sums{};
  Eigen::Index i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t column = 0; column < 3; ++column)
      for (Eigen::Index k = 0; k < lanes; ++k)
        sums[column][k] +=
            static_cast<double>(l[static_cast<Eigen::Index>(column) * stride + i + k]) * x[i + k];
  Vec3 sum = Vec3::Zero();
  for (std::size_t column = 0; column < 3; ++column) {
    for (const double lane : sums[column]) sum[column] += lane;
    for (Eigen::Index k = i; k < count; ++k)
      sum[column] += static_cast<double>(l[static_cast<Eigen::Index>(column) * stride + k]) * x[k];
  }
  return sum;
}

}  // namespace

template <int B>
std::vector<double> factorised(const FactorPattern& pattern, const std::vector<double>& inverse_mass,
                               const std::vector<MetricEntry>& entries, std::vector<double> number) {
  assemble<B>(pattern, inverse_mass, entries, number);
  Factorisation<B>(pattern, number).run();
  return number;
}
template std::vector<double> factorised<1>(const FactorPattern&, const std::vector<double>&,
                                           const std::vector<MetricEntry>&, std::vector<double>);
template std::vector<double> factorised<3>(const FactorPattern&, const std::vector<double>&,
                                           const std::vector<MetricEntry>&, std::vector<double>);

double pivot_ratio(const FactorPattern& pattern, const std::vector<double>& number) {
  double least = infinity, largest = 0;
  for (int s = 0; s < pattern.panels(); ++s) {
    const auto diagonal = panel_of<3>(pattern, number, s).diagonal();
    least = std::min(least, diagonal.minCoeff());
    largest = std::max(largest, diagonal.maxCoeff());
  }
  return std::pow(least / largest, 2);
}

template <int B, class Real>
void MetricFactor<B, Real>::solve(const FactorPattern& pattern, Points& x) {
  const auto each_node = [&](int s, auto&& f) {
    const int width = pattern.width(s), below = pattern.height(s) - width;
    for (int k = 0; k < width; ++k) f(k, x.col(pattern.first[s] + k));
    for (int k = 0; k < below; ++k) f(width + k, x.col(pattern.row[pattern.start[s] + k]));
  };
  for (int s = 0; s < pattern.panels(); ++s) {
    const int height = pattern.height(s), width = pattern.width(s);
    const auto panel = panel_of<B>(pattern, number, s);
    if (part.cols() < height) part.resize(3, height);
    each_node(s, [&](int k, const auto& node) { part.col(k) = node; });
    for (int j = 0; j < width; ++j) {
      const Eigen::Matrix<double, B, B> inverse =
          panel.template block<B, B>(B * j, B * j).template cast<double>();
      const int below = height - j - 1;
      if constexpr (B == 1) {
        part.col(j) *= inverse(0, 0);
        part.middleCols(j + 1, below).noalias() -=
            part.col(j) * panel.col(j).tail(below).transpose().template cast<double>();
      } else {
        const Vec3 solved = inverse * part.col(j);
        part.col(j) = solved;
        take_off(&panel(0, 3 * j) + 3 * (j + 1), panel.rows(), 3 * below, solved, part.col(j).data() + 3);
      }
    }
    each_node(s, [&](int k, auto&& node) { node = part.col(k); });
  }
  for (int s = pattern.panels() - 1; s >= 0; --s) {
    const int height = pattern.height(s), width = pattern.width(s);
    const auto panel = panel_of<B>(pattern, number, s);
    each_node(s, [&](int k, const auto& node) { part.col(k) = node; });
    for (int j = width - 1; j >= 0; --j) {
      const Eigen::Matrix<double, B, B> inverse =
          panel.template block<B, B>(B * j, B * j).template cast<double>();
      const int below = height - j - 1;
      if constexpr (B == 1) {
        part.col(j).noalias() -=
            part.middleCols(j + 1, below) * panel.col(j).tail(below).template cast<double>();
        part.col(j) *= inverse(0, 0);
      } else {
        const Vec3 rest = part.col(j) - gathered(&panel(0, 3 * j) + 3 * (j + 1), panel.rows(), 3 * below,
                                                 part.col(j).data() + 3);
        part.col(j) = inverse.transpose() * rest;
      }
    }
    for (int k = 0; k < width; ++k) x.col(pattern.first[s] + k) = part.col(k);
  }
}

template <int B, class Real>
FactorReach MetricFactor<B, Real>::reach(const FactorPattern& pattern, int column) const {
  FactorReach found;
  // The rows below a panel are above it in the tree, and the first of them is its parent.
  for (int j = column;;) {
    const int s = pattern.panel[j];
    for (; j < pattern.first[s + 1]; ++j) found.column.push_back(j);
    if (pattern.start[s] == pattern.start[s + 1]) break;
    j = pattern.row[pattern.start[s]];
  }
  found.part.assign(found.column.size(), Eigen::Matrix3d::Zero());
  found.part.front().setIdentity();
  for (std::size_t i = 0; i < found.column.size(); ++i) {
    const int s = pattern.panel[found.column[i]], j = found.column[i] - pattern.first[s];
    const auto panel = panel_of<B>(pattern, number, s);
    const auto block = [&](int k) -> Eigen::Matrix3d {
      if constexpr (B == 1)
        return static_cast<double>(panel(k, j)) * Eigen::Matrix3d::Identity();
      else
        return panel.template block<3, 3>(3 * k, 3 * j).template cast<double>();
    };
    found.part[i] = block(j) * found.part[i];
    std::size_t above = i;
    const int width = pattern.width(s);
    for (int k = j + 1; k < pattern.height(s); ++k) {
      const int row = k < width ? pattern.first[s] + k : pattern.row[pattern.start[s] + k - width];
      while (found.column[above] != row) ++above;
      found.part[above].noalias() -= block(k) * found.part[i];
    }
  }
  return found;
}

template struct MetricFactor<1, double>;
template struct MetricFactor<3, float>;
template struct MetricFactor<3, double>;

}  // namespace pbd
