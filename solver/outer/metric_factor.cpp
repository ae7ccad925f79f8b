#include "outer/metric_factor.h"

#include <array>

namespace pbd {
namespace {

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

template <int B, class Real>
void MetricFactor<B, Real>::solve(const FactorPattern& pattern, Points& x) {
  const auto each_node = [&](int s, auto&& f) {
    for (int k = 0; k < pattern.height(s); ++k) f(k, x.col(pattern.row_at(s, k)));
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
    for (int k = j + 1; k < pattern.height(s); ++k) {
      while (found.column[above] != pattern.row_at(s, k)) ++above;
      found.part[above].noalias() -= block(k) * found.part[i];
    }
  }
  return found;
}

template struct MetricFactor<1, double>;
template struct MetricFactor<3, float>;
template struct MetricFactor<3, double>;

}  // namespace pbd
