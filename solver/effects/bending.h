// c = theta - theta0 modulo 2 pi, theta the dihedral angle at the edge (x0, x1) with the wings x2 and x3
// (scene.h). With n_a = (x1-x0) x (x2-x0), n_b = (x0-x1) x (x3-x1), L = |x1-x0| and t the projection of a
// wing onto the edge,
//   dtheta/dx2 = -L n_a/|n_a|^2,  dtheta/dx3 = -L n_b/|n_b|^2,
//   dtheta/dx0 = -(1-t2) dtheta/dx2 - (1-t3) dtheta/dx3,  dtheta/dx1 = -t2 dtheta/dx2 - t3 dtheta/dx3
// (Bridson, Marino, Fedkiw 2003). A wing without area has no direction: its part of J is 0.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "effects/constraint.h"

namespace pbd {

template <>
struct Constraint<Bending> : ConstraintShape<1, 4> {
  static Nodes node(const Bending& effect, std::size_t i) { return effect.node[i]; }

  static Square compliance(const Bending& effect, std::size_t i) { return Square(effect.compliance[i]); }

  static Square retardation(const Bending& effect, std::size_t i) { return Square(effect.damping[i]); }

  static void evaluate(const Bending& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian) {
    const Vec3 edge = x.col(1) - x.col(0);
    const Vec3 wing_a = x.col(2) - x.col(0);
    const Vec3 wing_b = x.col(3) - x.col(0);
    const Vec3 normal_a = edge.cross(wing_a);
    const Vec3 normal_b = wing_b.cross(edge);
    const double length = edge.norm();

    const double sine = length > 0 ? normal_a.cross(normal_b).dot(edge) / length : 0.0;
    const double angle = std::atan2(sine, normal_a.dot(normal_b));
    value[0] = std::remainder(angle - effect.rest_angle[i], 2 * std::numbers::pi);

    const Vec3 gradient_a = wing_gradient(normal_a, length);
    const Vec3 gradient_b = wing_gradient(normal_b, length);
    const double inverse_square = length > 0 ? 1 / (length * length) : 0.0;
    const double t_a = wing_a.dot(edge) * inverse_square;
    const double t_b = wing_b.dot(edge) * inverse_square;
    jacobian << (-(1 - t_a) * gradient_a - (1 - t_b) * gradient_b).transpose(),
        (-t_a * gradient_a - t_b * gradient_b).transpose(), gradient_a.transpose(), gradient_b.transpose();
  }

  /// |e^T (d2theta/dx2) e| <= sum_ab s_a s_b |e_a| |e_b| with s the inverse heights of the wings and, for the
  /// edge's ends, what the heights' foot points leave them plus 1/L.
  static NodeBounds geometric_bound(const Bending&, std::size_t, const Positions& x, const Value& impulse) {
    const Vec3 edge = x.col(1) - x.col(0);
    const double length = edge.norm();
    if (!(length > 0)) return NodeBounds::Zero();
    const auto wing = [&](int column) {
      const Vec3 to_wing = x.col(column) - x.col(0);
      const double doubled_area = edge.cross(to_wing).norm();
      return std::pair{to_wing.dot(edge) / (length * length), doubled_area > 0 ? length / doubled_area : 0.0};
    };
    const auto [t_a, inverse_a] = wing(2);
    const auto [t_b, inverse_b] = wing(3);
    NodeBounds s;
    s << std::abs(1 - t_a) * inverse_a + std::abs(1 - t_b) * inverse_b + 1 / length,
        std::abs(t_a) * inverse_a + std::abs(t_b) * inverse_b + 1 / length, inverse_a, inverse_b;
    return std::abs(impulse[0]) * s.sum() * s;
  }

 private:
  static Vec3 wing_gradient(const Vec3& normal, double length) {
    const double square = normal.squaredNorm();
    return square > 0 ? Vec3(-length / square * normal) : Vec3::Zero();
  }
};

}  // namespace pbd
