// The step's potential by its velocities, where compliant rows are eliminated,
//   phi(v) = 1/2 |v - v_free|_M^2 + 1/2 sum_i (c_i/d)^T Sigma_i^-1 (c_i/d),   c at x0 + d v,
// whose gradient M (v - v_free) - J^T p with p = -Sigma^-1 c/d is the step's primal residual; and the metric
// P of metric.h, factored once per step length.
#pragma once

#include "outer/metric.h"
#include "outer/step_system.h"

namespace pbd {

/// v <- M v, N s of m/s; zero where the mass is infinite.
void weigh(const std::vector<double>& inverse_mass, Points& v, int threads = 1);

struct Potential {
  double value = 0;  // J, at v
  Points gradient;   // N s
  Metric metric;
  int since_factor = 0;          // iterations
  std::vector<bool> eliminated;  // of each block

  /// Sets the eliminated rows' own impulses at v, the value and the gradient; refreshes the other rows, and
  /// `rebuilt` by all. Returns the residual of the other rows.
  RowResidual evaluate(StepSystem& system);

  /// Factors the metric unless it is that of this step length, and turns it with the material at v.
  void begin_metric(StepSystem& system);

  void factor_metric(StepSystem& system, MetricShape shape);

 private:
  std::vector<Eigen::Matrix3d> deformation_;  // m^3, about each node, whose rotation turns the metric
};

}  // namespace pbd
