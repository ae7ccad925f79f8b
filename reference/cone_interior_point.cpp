#include "cone_interior_point.h"

#include <chrono>
#include <cmath>

#include "cone_fixed_point.h"
#include "cone_newton.h"

namespace pbd::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Lorentz cone |x_1| <= x_0 with the product x o y = (x.y, x_0 y_1 + y_0 x_1), contact by contact.

Vector3d jordan_product(const Vector3d& x, const Vector3d& y) {
  Vector3d p;
  p << x.dot(y), x(0) * y.tail<2>() + y(0) * x.tail<2>();
  return p;
}

double determinant(const Vector3d& x) {
  const double tail = x.tail<2>().norm();
  return (x(0) - tail) * (x(0) + tail);
}

/// y with x o y = b.
Vector3d quotient(const Vector3d& x, const Vector3d& b) {
  const double first = (x(0) * b(0) - x.tail<2>().dot(b.tail<2>())) / determinant(x);
  Vector3d y;
  y << first, (b.tail<2>() - first * x.tail<2>()) / x(0);
  return y;
}

/// The largest a <= most with x + a dx in the cone.
double step_length(const Vector3d& x, const Vector3d& dx, double most) {
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
  Matrix3d theta, inverse;

  Scaling(const Vector3d& x, const Vector3d& z) {
    const Vector3d mirror(1, -1, -1);
    const double dx = std::sqrt(determinant(x)), dz = std::sqrt(determinant(z));
    const Vector3d unit_x = x / dx, unit_z = z / dz;
    const double gamma = std::sqrt((1 + unit_x.dot(unit_z)) / 2);
    const Vector3d w = (unit_z + mirror.cwiseProduct(unit_x)) / (2 * gamma);
    Vector3d v = w;
    v(0) += 1;
    v /= std::sqrt(2 * (w(0) + 1));
    const double eta = std::sqrt(dz / dx);
    const Matrix3d j = mirror.asDiagonal();
    theta = eta * (2 * v * v.transpose() - j);
    inverse = (2 * mirror.cwiseProduct(v) * mirror.cwiseProduct(v).transpose() - j) / eta;
  }
};

/// The problem in x and z, for q of size 1. Where mu = 0 the cone's second part is zero and stays so.
class InteriorPoint {
 public:
  explicit InteriorPoint(const ConeProblem& problem) : contacts_(problem.contacts()) {
    unscale_.setOnes(3 * contacts_);
    for (int i = 0; i < contacts_; ++i) {
      const double mu = problem.friction(i);
      unscale_.segment<3>(3 * i) = mu > 0 ? Vector3d(1 / mu, 1, 1) : Vector3d(1, 0, 0);
    }
    n_ = scaled(unscale_, problem.delassus, unscale_);
    c_ = unscale_.cwiseProduct(problem.free_velocity);
    x_.setZero(3 * contacts_), z_.setZero(3 * contacts_);
    for (int i = 0; i < contacts_; ++i) x_(3 * i) = z_(3 * i) = 1;  // in the middle of both cones
  }

  /// Iterates until gap and residual are rounding, or nothing moves any more; returns the iterations.
  int run() {
    constexpr int most = 100;
    int iteration = 0;
    double best = infinity;
    VectorXd best_x = x_;
    for (int since = 0; iteration < most && since < 15; ++iteration, ++since) {
      const VectorXd residual = n_ * x_ + c_ - z_;
      const double merit = std::max(x_.dot(z_) / (1 + std::abs(c_.dot(x_))), residual.norm() / c_.norm());
      if (merit < best) best = merit, best_x = x_, since = 0;
      if (best < 1e-15 || !advance(residual)) break;
    }
    x_ = best_x;
    return iteration;
  }

  VectorXd impulse() const { return unscale_.cwiseProduct(x_); }

 private:
  template <class F>
  VectorXd each(const F& f) const {
    VectorXd all(3 * contacts_);
    for (int i = 0; i < contacts_; ++i) all.segment<3>(3 * i) = f(i);
    return all;
  }
  Vector3d x(int i) const { return x_.segment<3>(3 * i); }
  Vector3d z(int i) const { return z_.segment<3>(3 * i); }

  double longest(const VectorXd& dx, const VectorXd& dz) const {
    double length = 1 / 0.99;
    for (int i = 0; i < contacts_; ++i) {
      length = step_length(x(i), dx.segment<3>(3 * i), length);
      length = step_length(z(i), dz.segment<3>(3 * i), length);
    }
    return length;
  }

  /// One step of predictor and corrector; false if the factorisation fails or nothing moves.
  bool advance(const VectorXd& residual) {
    std::vector<Scaling> scaling;
    Triplets entries;
    for (int i = 0; i < contacts_; ++i) {
      const Matrix3d& theta = scaling.emplace_back(x(i), z(i)).theta;
      const Matrix3d square = theta * theta;
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
          entries.emplace_back(3 * i + row, 3 * i + column, square(row, column));
    }
    SparseMatrix matrix = from_triplets(n_.rows(), n_.cols(), entries);
    matrix += n_;
    SparseCholesky factor;
    if (!factor.compute(matrix)) return false;

    const auto theta = [&](const VectorXd& b) {
      return each([&](int i) { return Vector3d(scaling[i].theta * b.segment<3>(3 * i)); });
    };
    const auto inverse = [&](const VectorXd& b) {
      return each([&](int i) { return Vector3d(scaling[i].inverse * b.segment<3>(3 * i)); });
    };
    const VectorXd lambda = theta(x_);
    const VectorXd square =
        each([&](int i) { return jordan_product(lambda.segment<3>(3 * i), lambda.segment<3>(3 * i)); });
    // lambda o (Theta dx + Theta^-1 dz) = target,  N dx - dz = -residual
    VectorXd dx, dz;
    const auto direction = [&](const VectorXd& target) {
      const VectorXd d =
          each([&](int i) { return quotient(lambda.segment<3>(3 * i), target.segment<3>(3 * i)); });
      const VectorXd rhs = theta(d) - residual;
      dx = factor.solve(rhs);
      dx += factor.solve(VectorXd(rhs - matrix * dx));
      dz = n_ * dx + residual;
      return dx.allFinite() && dz.allFinite();
    };
    if (!direction(-square)) return false;
    const double affine = std::min(1.0, longest(dx, dz)), mean = x_.dot(z_) / contacts_;
    const double predicted = (x_ + affine * dx).dot(z_ + affine * dz) / contacts_;
    const double centring = std::pow(std::clamp(predicted / mean, 0.0, 1.0), 3) * mean;
    const VectorXd moved_x = theta(dx), moved_z = inverse(dz);
    if (!direction(each([&](int i) {
          return Vector3d(Vector3d(centring, 0, 0) - square.segment<3>(3 * i) -
                          jordan_product(moved_x.segment<3>(3 * i), moved_z.segment<3>(3 * i)));
        })))
      return false;
    const double length = std::min(1.0, 0.99 * longest(dx, dz));
    x_ += length * dx;
    z_ += length * dz;
    return length > 1e-10;
  }

  int contacts_;
  VectorXd unscale_;  // r = unscale x, z = unscale u
  SparseMatrix n_;
  VectorXd c_, x_, z_;
};

}  // namespace

ConeSolution interior_point(const ConeProblem& problem) {
  EquilibratedCone scaled = equilibrate(problem);
  const double size = scaled.problem.free_velocity.cwiseAbs().maxCoeff();
  ConeSolution solution;
  solution.impulse.setZero(3 * problem.contacts());
  if (size == 0) return solution;
  scaled.problem.free_velocity /= size;
  InteriorPoint method(scaled.problem);
  solution.iterations = method.run();
  solution.impulse = size * scaled.scale.cwiseProduct(method.impulse());
  return solution;
}

ConeSolution cone_interior_point(const ConeProblem& problem, FrictionLaw law, double tolerance) {
  constexpr double rounding = 1e-15;
  if (law == FrictionLaw::coulomb)
    return coulomb_by_fixed_point(
        problem, tolerance,
        {[](const ConeProblem& convex) { return cone_interior_point(convex, FrictionLaw::cone, rounding); },
         [](const ConeProblem& given, VectorXd& impulse) {
           return cone_newton(given, FrictionLaw::coulomb, rounding, impulse);
         }});
  const auto begin = std::chrono::steady_clock::now();
  ConeSolution solution = interior_point(problem);
  solution.iterations += cone_newton(problem, law, rounding, solution.impulse);
  certify(problem, law, tolerance, solution);
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace pbd::reference
