// The implicit Euler step that rivals do, without their way to its end.
//
//   phi(x) = 1/(2 h^2) |x - y|_M^2 + U(x),   y = x_l + h v_l + h^2 a,   v = (x - x_l)/h
//
// a is the acceleration by gravity and external forces. With p = -h A^-1 c the residual |v - v_free -
// W J^T p|_M is h |grad phi|_{M^-1}. Nodes of infinite mass move with their velocity and are no unknowns.
#pragma once

#include <cmath>
#include <string>

#include "rivals/rival.h"

namespace pbd::rivals {

class Potential;

/// A place with phi (J) and its gradient (N).
struct Point {
  Points x, gradient;
  double phi = 0;
};

class ImplicitStep {
 public:
  /// Throws SetupError, in the name of a rival, for an invalid scene or step and where nothing can move.
  ImplicitStep(const std::string& rival, const Scene& scene, double h);

  void begin(const State& state);
  void evaluate(const Potential& potential, Point& point) const;

  /// Sets residual and status at an iterate with its gradient; true if the step is to end there.
  bool finished(const Point& now, const Budget& budget, double rounding, Report& report) const;

  /// Moves the state to x.
  void end(const Points& x, State& state) const;

  /// sqrt(sum_i |g_i|^2/m_i) of movable nodes.
  double dual_norm(const Points& g) const { return std::sqrt(g.colwise().squaredNorm().dot(inverse_mass)); }

  double h;                               // s
  Eigen::RowVectorXd mass, inverse_mass;  // zero for infinite mass
  Points start;                           // x_l + h v_l, m
  Points target;                          // y, m

 private:
  double norm(const Points& v) const { return std::sqrt(v.colwise().squaredNorm().dot(mass)); }

  Points free_velocity_change_;  // h a
};

}  // namespace pbd::rivals
