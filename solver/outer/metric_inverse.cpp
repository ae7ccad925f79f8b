#include "outer/metric_inverse.h"

namespace pbd {
namespace {

/// Both paths end alike, at the roots they share.
Eigen::Matrix3d product(const FactorReach& a, const FactorReach& b) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (auto i = a.column.size(), j = b.column.size(); i > 0 && j > 0; --i, --j) {
    if (a.column[i - 1] != b.column[j - 1]) break;
    sum.noalias() += a.part[i - 1].transpose() * b.part[j - 1];
  }
  return sum;
}

}  // namespace

void MetricInverse::begin(const Metric& metric, std::size_t expected) {
  constexpr std::size_t spare = 64;
  if (factored_ == metric.factored() && places_.size() <= 2 * expected + spare) return;
  factored_ = metric.factored();
  place_.assign(metric.nodes(), -1);
  of_root_.assign(metric.nodes(), {});
  places_.clear();
}

int MetricInverse::place(const Metric& metric, int node) {
  int& own = place_[static_cast<std::size_t>(node)];
  if (own >= 0) return own;
  own = static_cast<int>(places_.size());
  Place& added = places_.emplace_back();
  added.reach = metric.reach(node);
  auto& others = of_root_[static_cast<std::size_t>(root(own))];
  added.number = static_cast<int>(others.size());
  others.push_back(own);
  added.row.reserve(others.size());
  for (const int other : others) added.row.push_back(product(added.reach, at(other).reach));
  return own;
}

}  // namespace pbd
