#include "rows/laws.h"

#include <Eigen/Dense>
#include <limits>

#include "names.h"

namespace pbd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Of p_t -> bound p_t/|p_t|, bound = mu p_n with dp_n by `normal`.
void scale_tangent(double mu, double bound, const Vector3d& z, const Eigen::RowVector3d& normal,
                   Matrix3d& derivative) {
  const double length = length_of(z[1], z[2]);
  const Eigen::Vector2d along = z.tail<2>() / length;
  derivative.bottomRows<2>() = mu * along * normal;
  derivative.bottomRightCorner<2, 2>() +=
      bound / length * (Eigen::Matrix2d::Identity() - along * along.transpose());
}

Matrix3d cone_derivative(double mu, const Vector3d& z) {
  const double tangential = length_of(z[1], z[2]);
  Matrix3d derivative = Matrix3d::Zero();
  if (z[0] < 0 && mu * tangential <= -z[0]) return derivative;
  if (tangential <= mu * z[0]) return Matrix3d::Identity();
  const double share = 1 / (1 + mu * mu);
  derivative.row(0) << share, mu * share * z[1] / tangential, mu * share * z[2] / tangential;
  const Eigen::RowVector3d normal = derivative.row(0);
  scale_tangent(mu, mu * share * (mu * tangential + z[0]), z, normal, derivative);
  return derivative;
}

Matrix3d disc_derivative(double mu, const Vector3d& z) {
  Matrix3d derivative = Matrix3d::Zero();
  if (!(z[0] > 0)) return derivative;
  if (length_of(z[1], z[2]) <= mu * z[0]) return Matrix3d::Identity();
  derivative(0, 0) = 1;
  scale_tangent(mu, mu * z[0], z, Eigen::RowVector3d(1, 0, 0), derivative);
  return derivative;
}

Matrix3d box_derivative(double mu, const Vector3d& z) {
  Matrix3d derivative = Matrix3d::Zero();
  if (!(z[0] > 0)) return derivative;
  derivative(0, 0) = 1;
  for (const int axis : {1, 2})
    if (std::abs(z[axis]) <= mu * z[0])
      derivative(axis, axis) = 1;
    else
      derivative(axis, 0) = std::copysign(mu, z[axis]);
  return derivative;
}

/// A contact that slides by Coulomb's law: u_n = 0, |p_t| = mu p_n, u_t = -lambda p_t. Without p_n, by u_n =
/// 0, (A + lambda) p_t = -b. At lambda = 0 it sticks, which has been refused: |p_t| > mu p_n; as lambda grows
/// p_t vanishes and p_n > 0 is left, since q_n < 0. Between them Newton's method on mu p_n/|p_t| = 1, whose
/// left side is a line in lambda where A has equal eigenvalues (more1983computing of |p_t| = 1), from the
/// start's lambda; where it leaves what is known to hold a root, that is halved.
Vector3d slide(double mu, const Matrix3d& n, const Vector3d& q, const Vector3d& start) {
  const double pressed = -q[0] / n(0, 0);
  if (mu == 0) return {pressed, 0, 0};
  const Eigen::Vector2d coupling = n.bottomLeftCorner<2, 1>() / n(0, 0);
  const Eigen::Matrix2d a = n.bottomRightCorner<2, 2>() - coupling * n.topRightCorner<1, 2>();
  const Eigen::Vector2d b = q.tail<2>() - coupling * q[0];
  const double equal = a.trace() / 2;  // eigenvalues, at first
  double low = 0, high = infinity;
  double lambda = std::max(0.0, (b.norm() / mu - coupling.dot(b)) / pressed - equal);
  const double begun = -(n * start + q).tail<2>().dot(start.tail<2>()) / start.tail<2>().squaredNorm();
  constexpr double far = 1e3;  // beyond it digits are lost: a start that hardly rubs asks for any lambda
  if (begun > 0 && begun < far * (lambda + equal)) lambda = begun;
  Vector3d p;
  constexpr int most = 100;
  for (int k = 0; k < most; ++k) {
    const Eigen::Matrix2d inverse = (a + lambda * Eigen::Matrix2d::Identity()).inverse();
    p.tail<2>() = -inverse * b;
    const double lifted = coupling.dot(p.tail<2>()), squared = p.tail<2>().squaredNorm();
    const double tangential = std::sqrt(squared);
    p[0] = pressed - lifted;
    const double excess = tangential - mu * p[0];
    constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
    if (std::abs(excess) <= rounding * (tangential + mu * (pressed + std::abs(lifted)))) break;
    (excess > 0 ? low : high) = lambda;
    const Eigen::Vector2d derivative = -inverse * p.tail<2>();  // of p_t by lambda
    const double rise =
        -mu * (coupling.dot(derivative) * squared + p[0] * derivative.dot(p.tail<2>()));  // times |p_t|^3
    lambda += excess * squared / rise;
    if (!(lambda > low && lambda < high)) lambda = high < infinity ? low + (high - low) / 2 : 2 * low + equal;
  }
  return project(Friction::disc, mu, p, Vector3d::Zero());
}

}  // namespace

ProjectionDerivative project_derivative(Friction law, double mu, const Eigen::Vector3d& p,
                                        const Eigen::Vector3d& step) {
  Vector3d z = p + step;
  if (law != Friction::coulomb) {
    const Matrix3d derivative = law == Friction::cone   ? cone_derivative(mu, z)
                                : law == Friction::disc ? disc_derivative(mu, z)
                                                        : box_derivative(mu, z);
    return {derivative, derivative};
  }
  const double slip = length_of(step[1], step[2]);
  z[0] -= mu * slip;
  const Matrix3d derivative = cone_derivative(mu, z);
  Matrix3d shifted = Matrix3d::Identity();  // d(step - mu |step_t| e_n) by step
  if (slip > 0) shifted.row(0).tail<2>() = -mu / slip * step.tail<2>().transpose();
  return {derivative, derivative * shifted};
}

Eigen::Vector3d solve_contact(Friction law, double mu, const Eigen::Matrix3d& n, const Eigen::Vector3d& q,
                              const Eigen::Vector3d& start) {
  const double slip = length_of(q[1], q[2]);
  if (q[0] >= (law == Friction::cone ? mu * slip : 0.0)) return Eigen::Vector3d::Zero();
  constexpr double singular = 1e-12;  // of a determinant over that of equal eigenvalues
  const double mean = n.trace() / 3;
  if (n.determinant() > singular * mean * mean * mean) {
    Eigen::Vector3d sticking = -n.inverse() * q;
    if (project(law, mu, sticking, Eigen::Vector3d::Zero()) == sticking) return sticking;
    if (law == Friction::coulomb || law == Friction::disc) return slide(mu, n, q, start);
  }

  constexpr int most = 30;
  constexpr double settled = 1e-14;
  const double step = 1 / n.rowwise().lpNorm<1>().maxCoeff();  // at least the largest eigenvalue's inverse
  Eigen::Vector3d p = start;
  for (int k = 0; k < most; ++k) {
    const Eigen::Vector3d next = project(law, mu, p, -step * (n * p + q));
    const double change = (next - p).squaredNorm();
    p = next;
    if (change <= settled * settled * p.squaredNorm()) break;
  }
  return p;
}

}  // namespace pbd
