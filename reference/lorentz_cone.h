// The Lorentz cone |x_1| <= x_0 of one contact (cone_interior_point.h), with the product
//   x o y = (x.y, x_0 y_1 + y_0 x_1)
// and the scaling of Nesterov and Todd (nesterov1997selfscaled).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace pbd::reference {

inline Eigen::Vector3d jordan_product(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  Eigen::Vector3d p;
  p << x.dot(y), x(0) * y.tail<2>() + y(0) * x.tail<2>();
  return p;
}

inline double determinant(const Eigen::Vector3d& x) {
  const double tail = x.tail<2>().norm();
  return (x(0) - tail) * (x(0) + tail);
}

/// y with x o y = b.
inline Eigen::Vector3d quotient(const Eigen::Vector3d& x, const Eigen::Vector3d& b) {
  const double first = (x(0) * b(0) - x.tail<2>().dot(b.tail<2>())) / determinant(x);
  Eigen::Vector3d y;
  y << first, (b.tail<2>() - first * x.tail<2>()) / x(0);
  return y;
}

/// The largest a <= most with x + a dx in the cone.
inline double step_length(const Eigen::Vector3d& x, const Eigen::Vector3d& dx, double most) {
  const double a = dx(0) * dx(0) - dx.tail<2>().squaredNorm();
  const double b = x(0) * dx(0) - x.tail<2>().dot(dx.tail<2>()), c = determinant(x);
  // The smallest positive root of a s^2 + 2 b s + c, and of x_0 + s dx_0.
  double length = dx(0) < 0 ? std::min(most, -x(0) / dx(0)) : most;
  const double discriminant = b * b - a * c;
  if (discriminant >= 0) {
    const double root = std::sqrt(discriminant);
    const double lower = b <= 0 ? -b + root : -b - root;
    for (const double s : {lower / a, c / lower})
      if (s > 0 && s < length) length = s;
  }
  return length;
}

/// Theta with Theta x = Theta^-1 z: eta (2 v v^T - diag(1, -1, -1)) of Nesterov and Todd, symmetric.
struct Scaling {
  Eigen::Matrix3d theta, inverse;

  Scaling(const Eigen::Vector3d& x, const Eigen::Vector3d& z) {
    const Eigen::Vector3d mirror(1, -1, -1);
    const double dx = std::sqrt(determinant(x)), dz = std::sqrt(determinant(z));
    const Eigen::Vector3d unit_x = x / dx, unit_z = z / dz;
    const double gamma = std::sqrt((1 + unit_x.dot(unit_z)) / 2);
    const Eigen::Vector3d w = (unit_z + mirror.cwiseProduct(unit_x)) / (2 * gamma);
    Eigen::Vector3d v = w;
    v(0) += 1;
    v /= std::sqrt(2 * (w(0) + 1));
    const double eta = std::sqrt(dz / dx);
    const Eigen::Matrix3d j = mirror.asDiagonal();
    theta = eta * (2 * v * v.transpose() - j);
    inverse = (2 * mirror.cwiseProduct(v) * mirror.cwiseProduct(v).transpose() - j) / eta;
  }
};

}  // namespace pbd::reference
