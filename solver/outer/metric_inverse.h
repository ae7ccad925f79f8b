// Blocks of P^-1, unturned, between some of the nodes: those that contacts touch. They stay as they are until
// P is factored anew.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "outer/metric.h"

namespace pbd {

class MetricInverse {
 public:
  /// Forgets what is no longer P's, or was asked for by steps long gone; `expected` nodes are asked for now.
  void begin(const Metric& metric, std::size_t expected);

  /// Place of a node of finite mass, found if it is a new one.
  int place(const Metric& metric, int node);

  std::size_t places() const { return reach_.size(); }

  /// The same for all places that P^-1 couples with each other.
  int root(int place) const { return reach_[static_cast<std::size_t>(place)].column.back(); }

  /// Block (a, b) of R^T P^-1 R by places, 1/kg.
  Eigen::Matrix3d block(int a, int b) const {
    return a >= b ? lower_[index(a, b)] : Eigen::Matrix3d(lower_[index(b, a)].transpose());
  }

 private:
  static std::size_t index(int a, int b) {
    return static_cast<std::size_t>(a) * (static_cast<std::size_t>(a) + 1) / 2 + static_cast<std::size_t>(b);
  }

  int factored_ = 0;                // which of the metric's factors
  std::vector<int> place_;          // of each node, -1 if it has none
  std::vector<FactorReach> reach_;  // of each place
  std::vector<Eigen::Matrix3d> lower_;
};

}  // namespace pbd
