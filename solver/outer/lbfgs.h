// L-BFGS (nocedal1980updating): curvature learnt from the last iterates, on top of a metric P.
#pragma once

#include <vector>

#include "outer/metric.h"

namespace pbd {

class Lbfgs {
 public:
  explicit Lbfgs(int memory) : memory_(memory) {}

  void forget() { count_ = 0; }

  /// Notes the change of v and gradient that the last iterate brought.
  void learn(const Points& step, const Points& change);

  /// Descent direction -H gradient.
  void direction(const Points& gradient, Metric& metric, Points& result);

 private:
  int memory_;
  int count_ = 0;
  Points q_;
  std::vector<double> alpha_;
  std::vector<Points> steps_, changes_;
  std::vector<double> curvature_;  // of each pair, change . step
};

}  // namespace pbd
