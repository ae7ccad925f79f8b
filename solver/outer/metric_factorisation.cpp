#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "outer/metric_factor.h"

namespace pbd {
namespace {

/// The lower triangle of M + s d K in the pattern of L.
template <int B>
void assemble(const FactorPattern& pattern, const std::vector<double>& inverse_mass,
              const std::vector<MetricEntry>& entries, PanelNumbers<double>& number) {
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
  Factorisation(const FactorPattern& pattern, bool definite, PanelNumbers<double>& number)
      : pattern_(pattern),
        definite_(definite),
        number_(number),
        waiting_(pattern.panels(), -1),
        next_(waiting_),
        at_(waiting_),
        slot_(pattern.columns()) {}

  /// False if it ended at a pivot that the matrix shall not have.
  bool run() {
    for (int s = 0; s < pattern_.panels(); ++s) {
      auto panel = panel_of<B>(pattern_, number_, s);
      stiffness_ = panel.topRows(panel.cols()).diagonal();
      for (int k = 0; k < pattern_.height(s); ++k) slot_[pattern_.row_at(s, k)] = k;
      for (int earlier = waiting_[s]; earlier >= 0;) {
        const int following = next_[earlier];
        reduce(panel, s, earlier);
        earlier = following;
      }
      if (!eliminate(panel)) return false;
      wait(s, pattern_.width(s));
    }
    return true;
  }

 private:
  using Block = Eigen::Matrix<double, B, B>;
  using Numbers = Eigen::MatrixXd;
  using PanelMap = Eigen::Map<Numbers>;

  /// The panel's rows from `k` on wait to be multiplied, in a list of the panel that the next is of.
  void wait(int s, int k) {
    at_[s] = k;
    if (k == pattern_.height(s)) return;
    const int other = pattern_.panel[pattern_.row_at(s, k)];
    next_[s] = waiting_[other];
    waiting_[other] = s;
  }

  /// Takes off what an earlier panel has in the panel's rows.
  void reduce(PanelMap& panel, int s, int earlier) {
    const int from = at_[earlier], height = pattern_.height(earlier);
    int to = from;
    while (to < height && pattern_.row_at(earlier, to) < pattern_.first[s + 1]) ++to;
    const auto other = panel_of<B>(pattern_, number_, earlier);
    const auto rows = other.bottomRows(B * (height - from));
    constexpr Eigen::Index narrow = 12;  // columns, of which a dense product takes longer to begin than to do
    const auto right = rows.topRows(B * (to - from)).transpose();
    if (other.cols() <= narrow)
      product_.noalias() = rows.lazyProduct(right);
    else
      product_.noalias() = rows * right;
    for (int j = from; j < to; ++j) {
      const int column = B * slot_[pattern_.row_at(earlier, j)];
      for (int i = j; i < height; ++i)
        panel.template block<B, B>(B * slot_[pattern_.row_at(earlier, i)], column) -=
            product_.template block<B, B>(B * (i - from), B * (j - from));
    }
    wait(earlier, to);
  }

  /// The panel's own columns, strip by strip: those of a strip one node after the other, what is right of it
  /// by one product.
  bool eliminate(PanelMap& panel) {
    constexpr Eigen::Index strip = 48;  // columns: as narrow as products are still dense ones
    const Eigen::Index width = panel.cols(), height = panel.rows();
    for (Eigen::Index left = 0; left < width; left += strip) {
      const Eigen::Index end = std::min(left + strip, width);
      for (Eigen::Index j = left; j < end; j += B) {
        const double stiffness = stiffness_.segment<B>(j).sum();
        const Eigen::LLT<Block> pivot(panel.template block<B, B>(j, j));
        const bool positive = is_positive(pivot, stiffness);
        if (definite_ && !positive) return false;
        const Block inverse = positive ? Block(pivot.matrixL().solve(Block::Identity()))
                                       : Block(Block::Identity() / std::sqrt(stiffness));
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
    return true;
  }

  static bool is_positive(const Eigen::LLT<Block>& pivot, double stiffness) {
    constexpr double lost = 1e-14;  // of its node's stiffness: what is below is rounding
    return pivot.info() == Eigen::Success &&
           pivot.matrixLLT().diagonal().cwiseAbs2().minCoeff() > lost * stiffness;
  }

  const FactorPattern& pattern_;
  bool definite_;
  PanelNumbers<double>& number_;
  std::vector<int> waiting_, next_, at_;  // by panels
  std::vector<int> slot_;                 // in the panel, of each row that it has
  Eigen::VectorXd stiffness_;
  Numbers product_;
};

}  // namespace

template <int B>
bool factorise(const FactorPattern& pattern, const std::vector<double>& inverse_mass,
               const std::vector<MetricEntry>& entries, bool definite, PanelNumbers<double>& number) {
  assemble<B>(pattern, inverse_mass, entries, number);
  return Factorisation<B>(pattern, definite, number).run();
}
template bool factorise<1>(const FactorPattern&, const std::vector<double>&, const std::vector<MetricEntry>&,
                           bool, PanelNumbers<double>&);
template bool factorise<3>(const FactorPattern&, const std::vector<double>&, const std::vector<MetricEntry>&,
                           bool, PanelNumbers<double>&);

double pivot_ratio(const FactorPattern& pattern, const PanelNumbers<double>& number) {
  double least = infinity, largest = 0;
  for (int s = 0; s < pattern.panels(); ++s) {
    const auto diagonal = panel_of<3>(pattern, number, s).diagonal();
    least = std::min(least, diagonal.minCoeff());
    largest = std::max(largest, diagonal.maxCoeff());
  }
  return std::pow(least / largest, 2);
}

}  // namespace pbd
