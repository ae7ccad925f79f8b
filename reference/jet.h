// Second-order forward differentiation: a number together with its gradient and Hessian.
//
//   f = f(y),  y in R^D;   jet = (f, df/dy, d2f/dy2)
//   (a b)'  = a b' + b a',     (a b)''  = a b'' + b a'' + a' b'^T + b' a'^T
//   phi(a)' = phi'(a) a',      phi(a)'' = phi'(a) a'' + phi''(a) a' a'^T
//
// The judges state effects by their values only; this type supplies the derivatives (griewank2008evaluating).
// Of order 1 it carries the gradient alone.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace pbd::reference {

template <int D, int Order = 2>
struct Jet {
  using Gradient = Eigen::Matrix<double, D, 1>;
  using Hessian = Eigen::Matrix<double, Order == 2 ? D : 0, Order == 2 ? D : 0>;

  double value = 0;
  Gradient gradient = Gradient::Zero();
  Hessian hessian = Hessian::Zero();

  Jet() = default;
  Jet(double constant) : value(constant) {}  // NOLINT: a constant is a number of this type
  static Jet variable(double value, int index) {
    Jet jet(value);
    jet.gradient(index) = 1;
    return jet;
  }

  Jet& operator+=(const Jet& b) {
    value += b.value, gradient += b.gradient, hessian += b.hessian;
    return *this;
  }
  Jet& operator-=(const Jet& b) {
    value -= b.value, gradient -= b.gradient, hessian -= b.hessian;
    return *this;
  }
  Jet& operator*=(double factor) {
    value *= factor, gradient *= factor, hessian *= factor;
    return *this;
  }

  friend Jet operator+(Jet a, const Jet& b) { return a += b; }
  friend Jet operator-(Jet a, const Jet& b) { return a -= b; }
  friend Jet operator*(Jet a, double b) { return a *= b; }
  friend Jet operator*(double a, Jet b) { return b *= a; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet product(a.value * b.value);
    product.gradient = a.value * b.gradient + b.value * a.gradient;
    if constexpr (Order == 2) {
      product.hessian.noalias() = a.gradient * b.gradient.transpose();
      product.hessian += product.hessian.transpose().eval();
      product.hessian += a.value * b.hessian + b.value * a.hessian;
    }
    return product;
  }

  /// phi(a) from phi, phi' and phi'' at a.
  static Jet chain(const Jet& a, double phi, double first, double second) {
    Jet result(phi);
    result.gradient = first * a.gradient;
    if constexpr (Order == 2)
      result.hessian = first * a.hessian + second * (a.gradient * a.gradient.transpose());
    return result;
  }
  friend Jet sqrt(const Jet& a) {
    const double root = std::sqrt(a.value);
    return chain(a, root, 0.5 / root, -0.25 / (root * a.value));
  }
  friend Jet inverse(const Jet& a) {
    const double inverse = 1 / a.value;
    return chain(a, inverse, -inverse * inverse, 2 * inverse * inverse * inverse);
  }
  /// Angle of (x, y), through the tangent or the cotangent, whichever is bounded.
  friend Jet atan2(const Jet& y, const Jet& x) {
    const bool steep = std::abs(y.value) > std::abs(x.value);
    const Jet t = steep ? x * inverse(y) : y * inverse(x);
    const double d = 1 / (1 + t.value * t.value), sign = steep ? -1 : 1;
    return chain(t, std::atan2(y.value, x.value), sign * d, -sign * 2 * t.value * d * d);
  }
};

inline double inverse(double a) {
  return 1 / a;
}

/// Three numbers of type T and the vector algebra the constraint values need.
template <class T>
using Triple = std::array<T, 3>;

template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
Triple<T> minus(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace pbd::reference
