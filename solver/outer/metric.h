// The constant metric of quasi_newton,
//   P = R (M + s d K) R^T,   K_ab = J_a^T A^-1 J_b at rest (N/m),
// with R a rotation a node, that of the material about it at the step's start: P follows a solid that turns,
// as warped stiffness does (mueller2004interactive), and its factor stays. Effects whose rows leave
// directions free enter with one number a pair of nodes, trace(K_ab)/3, which no rotation changes
// (liu2017quasi); so does everything where a factor of full blocks would take too long.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "outer/metric_factor.h"

namespace pbd {

class Metric {
 public:
  /// Full blocks if the factor takes at most so many products of 3 x 3 blocks (1e10: half a minute), else
  /// one number a pair of nodes; of the rest shape in single precision where that loses nothing, of the
  /// current one, by which Newton's method goes, in double. `deformation` as in `turn`, of the shape that the
  /// entries are of; zero where that is the rest shape. False, and no factor, where the tangent is not
  /// positive definite or would have one number a pair of nodes.
  bool factor(const StepMap& map, const std::vector<double>& inverse_mass,
              const std::vector<MetricEntry>& entries, const std::vector<Eigen::Matrix3d>& deformation,
              MetricShape shape, double most_products = 1e10);

  bool factored_for(const StepMap& map) const { return d_ == map.d && s_ == map.s; }

  /// The stiffness is another now: P is to be factored anew.
  void forget() { d_ = s_ = 0; }

  /// Sets R to the rotations nearest to the given deformation gradients, one a node, from the shape that P is
  /// factored for; to 1 where a matrix is zero.
  void turn(const std::vector<Eigen::Matrix3d>& deformation);

  /// One over P's diagonal, 1/kg, the mean of its three entries a node; 0 where a node cannot move.
  const std::vector<double>& inverse_diagonal() const { return inverse_diagonal_; }

  /// R of a node.
  const Eigen::Matrix3d& rotation(int node) const { return rotation_[static_cast<std::size_t>(node)]; }

  /// With P = R L L^T R^T: L^-1 of a unit load on a node of finite mass, as long as `factored` is the same.
  FactorReach reach(int node) const;
  int factored() const { return factored_times_; }
  std::size_t nodes() const { return rotation_.size(); }

  int threads = 1;  // that loops over nodes are divided among

  /// result = P^-1 right; zero where a node cannot move.
  void solve(const Points& right, Points& result);

 private:
  bool turns() const { return factor_.index() > 0; }

  double d_ = 0, s_ = 0;  // s, of the steps that P is factored for
  int factored_times_ = 0;
  FactorPattern pattern_;
  std::variant<MetricFactor<1, double>, MetricFactor<3, float>, MetricFactor<3, double>> factor_;
  std::vector<Eigen::Matrix3d> rotation_, factored_;  // R, and the rotations of the shape factored
  std::vector<double> inverse_diagonal_;
  Points work_;
};

}  // namespace pbd
