// Springs, anchors and hinges: energy, gradient and stiffness by hand.
//
// An element of K nodes has
//   energy(x, g)            its energy (J); writes its gradient g (N), 3 x K
//   stiffness(x, projected) a function of two local nodes (a, b), the 3 x 3 block d2(energy)/dx_a dx_b (N/m);
//                           positive semidefinite as a whole if `projected`
// with x the positions (m), 3 x K. What is said of `solids.h` holds here: all is inline, nothing allocates.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "scene.h"

namespace pbd::rivals {

template <int K>
using Nodes = Eigen::Matrix<double, 3, K>;
using Mat3 = Eigen::Matrix3d;

/// 1/(2A) |x - target|^2.
struct AnchorElement {
  static constexpr int nodes = 1;
  Vec3 target;      // m
  double constant;  // 1/A, N/m

  double energy(const Nodes<1>& x, Nodes<1>& gradient) const {
    gradient = constant * (x - target);
    return gradient.dot(x - target) / 2;
  }
  auto stiffness(const Nodes<1>&, bool) const {
    return [k = constant](int, int) -> Mat3 { return k * Mat3::Identity(); };
  }
};

/// 1/(2A) (l - L)^2, l = |x1 - x0|, n = (x1 - x0)/l. Stiffness 1/A n n^T + f/l (I - n n^T) with the force f =
/// (l - L)/A, which compression makes indefinite: `projected` leaves its part out then.
struct SpringElement {
  static constexpr int nodes = 2;
  double length;    // L, m
  double constant;  // 1/A, N/m

  double energy(const Nodes<2>& x, Nodes<2>& gradient) const {
    const Vec3 d = x.col(1) - x.col(0);
    const double l = d.norm(), force = constant * (l - length);
    gradient.col(1) = l > 0 ? Vec3(force / l * d) : Vec3::Zero();
    gradient.col(0) = -gradient.col(1);
    return force * (l - length) / 2;
  }
  auto stiffness(const Nodes<2>& x, bool projected) const {
    const Vec3 d = x.col(1) - x.col(0);
    const double l = d.norm(), force = constant * (l - length);
    const double across = l > 0 && !(projected && force < 0) ? force / l : 0;
    const Vec3 n = l > 0 ? Vec3(d / l) : Vec3::Zero();
    const Mat3 block = across * Mat3::Identity() + (constant - across) * n * n.transpose();
    return [block](int a, int b) -> Mat3 { return a == b ? block : Mat3(-block); };
  }
};

/// 1/(2A) (theta - rest)^2, theta and its sign as at `Bending`. Stiffness 1/A g g^T, g = dtheta/dx:
/// Gauss-Newton, without the part of d2theta/dx2, so that Newton converges linearly where bending moments are
/// large.
struct HingeElement {
  static constexpr int nodes = 4;
  double rest;      // rad
  double constant;  // 1/A, N m/rad

  /// theta - rest in (-pi, pi], and dtheta/dx (rad/m).
  double angle(const Nodes<4>& x, Nodes<4>& slope) const {
    const Vec3 e = x.col(1) - x.col(0), a = x.col(2) - x.col(0), b = x.col(3) - x.col(0);
    const Vec3 normal_a = e.cross(a), normal_b = b.cross(e);
    const double squared = e.squaredNorm(), l = std::sqrt(squared);
    slope.col(2) = -l / normal_a.squaredNorm() * normal_a;
    slope.col(3) = -l / normal_b.squaredNorm() * normal_b;
    slope.col(1) = -(e.dot(a) * slope.col(2) + e.dot(b) * slope.col(3)) / squared;
    slope.col(0) = -slope.rightCols<3>().rowwise().sum();
    const double theta = std::atan2(normal_a.cross(normal_b).dot(e) / l, normal_a.dot(normal_b));
    return std::remainder(theta - rest, 2 * std::numbers::pi);
  }
  double energy(const Nodes<4>& x, Nodes<4>& gradient) const {
    const double c = angle(x, gradient);
    gradient *= constant * c;
    return constant * c * c / 2;
  }
  auto stiffness(const Nodes<4>& x, bool) const {
    Nodes<4> slope;
    angle(x, slope);
    return
        [slope, k = constant](int a, int b) -> Mat3 { return k * slope.col(a) * slope.col(b).transpose(); };
  }
};

}  // namespace pbd::rivals
