#include "outer/metric.h"

#include <utility>

#include "rows/polar.h"
#include "threads/threads.h"

namespace pbd {
namespace {

Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& deformation) {
  if (deformation.isZero(0)) return Eigen::Matrix3d::Identity();
  return polar_rotation(deformation);
}

}  // namespace

bool Metric::factor(const StepMap& map, const std::vector<double>& inverse_mass,
                    const std::vector<MetricEntry>& entries, const std::vector<Eigen::Matrix3d>& deformation,
                    MetricShape shape, double most_products) {
  constexpr double single_precision = 1e-5;  // pivots that differ less lose nothing that a metric needs
  if (!pattern_.is_of(inverse_mass, entries)) pattern_ = analyse(inverse_mass, entries);
  const bool definite = shape == MetricShape::tangent;
  if (pattern_.products() > most_products) {
    if (definite) return false;
    MetricFactor<1, double> factor;
    factorise<1>(pattern_, inverse_mass, entries, definite, factor.number);
    factor_ = std::move(factor);
  } else {
    auto* last = std::get_if<MetricFactor<3, double>>(&factor_);
    PanelNumbers<double> number = last ? std::move(last->number) : PanelNumbers<double>();
    if (!factorise<3>(pattern_, inverse_mass, entries, definite, number)) {
      if (last) last->number = std::move(number);
      return false;
    }
    if (shape == MetricShape::rest && pivot_ratio(pattern_, number) >= single_precision)
      factor_ = MetricFactor<3, float>{{number.begin(), number.end()}};
    else
      factor_ = MetricFactor<3, double>{std::move(number)};
  }
  inverse_diagonal_ = inverse_mass;
  for (const auto& entry : entries)
    if (entry.row == entry.column && inverse_mass[entry.row] > 0)
      inverse_diagonal_[entry.row] = 1 / (1 / inverse_diagonal_[entry.row] + entry.block.trace() / 3);
  work_.resize(3, pattern_.columns());
  rotation_.assign(inverse_mass.size(), Eigen::Matrix3d::Identity());
  factored_ = rotation_;
  for (std::size_t node = 0; node < deformation.size(); ++node)
    factored_[node] = rotation_of(deformation[node]);
  d_ = map.d;
  s_ = map.s;
  ++factored_times_;
  return true;
}

void Metric::turn(const std::vector<Eigen::Matrix3d>& deformation) {
  if (!turns()) return;
  each_columns(threads, std::ssize(deformation), [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index node = first; node < first + count; ++node)
      rotation_[node] = rotation_of(deformation[node]) * factored_[node].transpose();
  });
}

FactorReach Metric::reach(int node) const {
  const int column = pattern_.column[static_cast<std::size_t>(node)];
  return std::visit([&](const auto& factor) { return factor.reach(pattern_, column); }, factor_);
}

void Metric::solve(const Points& right, Points& result) {
  result.resizeLike(right);
  each_columns(threads, right.cols(), [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index node = first; node < first + count; ++node)
      if (pattern_.column[node] >= 0)
        work_.col(pattern_.column[node]).noalias() = rotation_[node].transpose() * right.col(node);
  });
  std::visit([&](auto& factor) { factor.solve(pattern_, work_); }, factor_);
  each_columns(threads, right.cols(), [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index node = first; node < first + count; ++node)
      if (pattern_.column[node] >= 0)
        result.col(node).noalias() = rotation_[node] * work_.col(pattern_.column[node]);
      else
        result.col(node).setZero();
  });
}

}  // namespace pbd
