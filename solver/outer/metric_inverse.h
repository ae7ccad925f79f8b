// Blocks of P^-1, unturned, between some of the nodes: those that contacts touch. They stay as they are until
// P is factored anew. Memory grows with the square of the places of one root, as of one solid.
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

  /// The same for all places that P^-1 couples with each other.
  int root(int place) const { return at(place).reach.column.back(); }

  /// Block (a, b) of R^T P^-1 R by places of one root, 1/kg.
  Eigen::Matrix3d block(int a, int b) const {
    const Place &one = at(a), &other = at(b);
    return one.number >= other.number
               ? one.row[static_cast<std::size_t>(other.number)]
               : Eigen::Matrix3d(other.row[static_cast<std::size_t>(one.number)].transpose());
  }

 private:
  struct Place {
    FactorReach reach;
    int number = 0;                    // of its root's
    std::vector<Eigen::Matrix3d> row;  // blocks with its root's places up to itself
  };
  const Place& at(int place) const { return places_[static_cast<std::size_t>(place)]; }

  int factored_ = -1;       // which of the metric's factors
  std::vector<int> place_;  // of each node, -1 if it has none
  std::vector<Place> places_;
  std::vector<std::vector<int>> of_root_;  // places, by their root
};

}  // namespace pbd
