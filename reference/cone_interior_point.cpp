#include "cone_interior_point.h"

#include <chrono>
#include <cmath>

#include "cone_fixed_point.h"
#include "cone_newton.h"
#include "lorentz_cone.h"

namespace pbd::reference {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The problem in x and z, for q of size 1. Where mu = 0 the cone's second part is zero and stays so. A
/// bounded row is x = |p - bound| >= 0 from its lower bound if that is finite, else from its upper one; where
/// the other one is finite, too, with its room, length - x, and a second z, `far`.
class InteriorPoint {
 public:
  explicit InteriorPoint(const ConeProblem& problem)
      : contacts_(problem.contacts()), bounded_(problem.bounded()) {
    unscale_.setOnes(problem.rows());
    offset_.setZero(problem.rows());
    x_.setZero(problem.rows()), z_.setZero(problem.rows());
    for (int i = 0; i < contacts_; ++i) {
      const double mu = problem.friction(i);
      unscale_.segment<3>(3 * i) = mu > 0 ? Vector3d(1 / mu, 1, 1) : Vector3d(1, 0, 0);
      x_(3 * i) = z_(3 * i) = 1;  // in the middle of both cones
    }
    room_.setOnes(bounded_), far_.setZero(bounded_), ends_.setZero(bounded_);
    for (int k = 0; k < bounded_; ++k) {
      const int row = 3 * contacts_ + k;
      const double lower = problem.lower(k), upper = problem.upper(k), length = upper - lower;
      if (!std::isfinite(lower)) unscale_(row) = -1;
      offset_(row) = std::isfinite(lower) ? lower : upper;
      x_(row) = std::min(1.0, length / 2), z_(row) = 1;
      if (std::isfinite(length)) room_(k) = length - x_(row), far_(k) = ends_(k) = 1;
    }
    n_ = scaled(unscale_, problem.delassus, unscale_);
    c_ = unscale_.cwiseProduct(problem.velocity(offset_));
  }

  /// Iterates until gap and residual are rounding, or nothing moves any more; returns the iterations.
  int run(ConeWork* work) {
    constexpr int most = 100;
    int iteration = 0;
    double best = infinity;
    VectorXd best_x = x_;
    const double size = c_.norm() > 0 ? c_.norm() : 1;
    for (int since = 0; iteration < most && since < 15; ++iteration, ++since) {
      VectorXd residual = n_ * x_ + c_ - z_;
      residual.tail(bounded_) += far_;
      const double merit =
          std::max((x_.dot(z_) + room_.dot(far_)) / (1 + std::abs(c_.dot(x_))), residual.norm() / size);
      if (merit < best) best = merit, best_x = x_, since = 0;
      if (best < 1e-15 || (work != nullptr && !work->spend(static_cast<double>(n_.nonZeros())))) break;
      if (!advance(residual)) break;
    }
    x_ = best_x;
    return iteration;
  }

  VectorXd impulse() const { return offset_ + unscale_.cwiseProduct(x_); }

 private:
  /// f of each contact, and behind them what is one number a bounded row.
  template <class F>
  VectorXd each(const F& f, const VectorXd& of_bounded) const {
    VectorXd all(x_.size());
    for (int i = 0; i < contacts_; ++i) all.segment<3>(3 * i) = f(i);
    all.tail(bounded_) = of_bounded;
    return all;
  }
  Vector3d x(int i) const { return x_.segment<3>(3 * i); }
  Vector3d z(int i) const { return z_.segment<3>(3 * i); }

  struct Direction {
    VectorXd x, z, far;

    bool finite() const { return x.allFinite() && z.allFinite() && far.allFinite(); }
  };

  double longest(const Direction& d) const {
    double length = 1 / 0.99;
    for (int i = 0; i < contacts_; ++i) {
      length = step_length(x(i), d.x.segment<3>(3 * i), length);
      length = step_length(z(i), d.z.segment<3>(3 * i), length);
    }
    const auto shorten = [&length](double from, double change) {
      if (change < 0) length = std::min(length, -from / change);
    };
    for (int k = 0; k < bounded_; ++k) {
      const int row = 3 * contacts_ + k;
      shorten(x_(row), d.x(row)), shorten(z_(row), d.z(row));
      if (ends_(k) > 0) shorten(room_(k), -d.x(row)), shorten(far_(k), d.far(k));
    }
    return length;
  }

  /// x.z after a share of a direction, of both ends.
  double products(const Direction& d, double length) const {
    return (x_ + length * d.x).dot(z_ + length * d.z) +
           (room_ - length * ends_.cwiseProduct(d.x.tail(bounded_))).dot(far_ + length * d.far);
  }

  /// N + Theta^2, and of bounded rows N + z/x + far/room.
  SparseMatrix matrix(const std::vector<Scaling>& scaling) const {
    Triplets entries;
    for (int i = 0; i < contacts_; ++i) {
      const Matrix3d square = scaling[i].theta * scaling[i].theta;
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
          entries.emplace_back(3 * i + row, 3 * i + column, square(row, column));
    }
    for (int k = 0; k < bounded_; ++k) {
      const int row = 3 * contacts_ + k;
      entries.emplace_back(row, row, z_(row) / x_(row) + far_(k) / room_(k));
    }
    SparseMatrix sum = from_triplets(n_.rows(), n_.cols(), entries);
    sum += n_;
    return sum;
  }

  /// One step of predictor and corrector; false if the factorisation fails or nothing moves.
  bool advance(const VectorXd& residual) {
    std::vector<Scaling> scaling;
    for (int i = 0; i < contacts_; ++i) scaling.emplace_back(x(i), z(i));
    const SparseMatrix matrix = this->matrix(scaling);
    SparseCholesky factor;
    if (!factor.compute(matrix)) return false;

    const VectorXd bounded_x = x_.tail(bounded_), bounded_z = z_.tail(bounded_);
    const VectorXd root = bounded_z.cwiseQuotient(bounded_x).cwiseSqrt();
    const auto theta = [&](const VectorXd& b) {
      return each([&](int i) { return Vector3d(scaling[i].theta * b.segment<3>(3 * i)); },
                  root.cwiseProduct(b.tail(bounded_)));
    };
    const auto inverse = [&](const VectorXd& b) {
      return each([&](int i) { return Vector3d(scaling[i].inverse * b.segment<3>(3 * i)); },
                  b.tail(bounded_).cwiseQuotient(root));
    };
    const VectorXd lambda = theta(x_);
    const VectorXd square =
        each([&](int i) { return jordan_product(lambda.segment<3>(3 * i), lambda.segment<3>(3 * i)); },
             bounded_x.cwiseProduct(bounded_z));
    // lambda o (Theta dx + Theta^-1 dz) = target,  room dfar - far dx = far_target,  N dx - dz + dfar =
    // -residual
    const auto direction = [&](const VectorXd& target, const VectorXd& far_target) {
      Direction d;
      const VectorXd quotients =
          each([&](int i) { return quotient(lambda.segment<3>(3 * i), target.segment<3>(3 * i)); },
               target.tail(bounded_).cwiseQuotient(lambda.tail(bounded_)));
      VectorXd rhs = theta(quotients) - residual;
      rhs.tail(bounded_) -= far_target.cwiseQuotient(room_);
      d.x = factor.solve(rhs);
      d.x += factor.solve(VectorXd(rhs - matrix * d.x));
      d.far = (far_target + far_.cwiseProduct(d.x.tail(bounded_))).cwiseQuotient(room_);
      d.z = n_ * d.x + residual;
      d.z.tail(bounded_) += d.far;
      return d;
    };
    const Direction predictor = direction(-square, -room_.cwiseProduct(far_));
    if (!predictor.finite()) return false;
    const double count = contacts_ + bounded_ + ends_.sum();
    const double mean = (x_.dot(z_) + room_.dot(far_)) / count;
    const double predicted = products(predictor, std::min(1.0, longest(predictor))) / count;
    const double centring = std::pow(std::clamp(predicted / mean, 0.0, 1.0), 3) * mean;
    const VectorXd moved_x = theta(predictor.x), moved_z = inverse(predictor.z);
    const VectorXd target = each(
        [&](int i) {
          return Vector3d(Vector3d(centring, 0, 0) - square.segment<3>(3 * i) -
                          jordan_product(moved_x.segment<3>(3 * i), moved_z.segment<3>(3 * i)));
        },
        (centring - square.tail(bounded_).array() -
         moved_x.tail(bounded_).array() * moved_z.tail(bounded_).array())
            .matrix());
    const VectorXd far_target =
        centring * ends_ - room_.cwiseProduct(far_) + predictor.x.tail(bounded_).cwiseProduct(predictor.far);
    const Direction corrector = direction(target, far_target);
    if (!corrector.finite()) return false;
    const double length = std::min(1.0, 0.99 * longest(corrector));
    x_ += length * corrector.x;
    z_ += length * corrector.z;
    far_ += length * corrector.far;
    room_ -= length * ends_.cwiseProduct(corrector.x.tail(bounded_));
    return length > 1e-10;
  }

  int contacts_, bounded_;
  VectorXd unscale_, offset_;  // r = offset + unscale x, z = unscale u
  SparseMatrix n_;
  VectorXd c_, x_, z_;
  VectorXd room_, far_, ends_;  // of bounded rows; 1, 0 and 0 of those with one bound, else `ends_` is 1
};

}  // namespace

ConeSolution interior_point(const ConeProblem& problem, ConeWork* work) {
  EquilibratedCone scaled = equilibrate(problem);
  const double size = scaled.problem.free_velocity.cwiseAbs().maxCoeff();
  ConeSolution solution;
  solution.impulse.setZero(problem.rows());
  if (size == 0) return solution;
  scaled.problem.free_velocity /= size;
  scaled.problem.lower /= size;
  scaled.problem.upper /= size;
  InteriorPoint method(scaled.problem);
  solution.iterations = method.run(work);
  solution.impulse = size * scaled.scale.cwiseProduct(method.impulse());
  return solution;
}

ConeSolution cone_interior_point(const ConeProblem& problem, FrictionLaw law, double tolerance,
                                 ConeWork* work) {
  constexpr double rounding = 1e-15;
  if (law == FrictionLaw::coulomb)
    return coulomb_by_fixed_point(problem, tolerance,
                                  {[work](const ConeProblem& convex) {
                                     return cone_interior_point(convex, FrictionLaw::cone, rounding, work);
                                   },
                                   [work](const ConeProblem& given, VectorXd& impulse) {
                                     return cone_newton(given, FrictionLaw::coulomb, rounding, impulse, work);
                                   }},
                                  work);
  const auto begin = std::chrono::steady_clock::now();
  ConeSolution solution = interior_point(problem, work);
  solution.iterations += cone_newton(problem, law, rounding, solution.impulse, work);
  certify(problem, law, tolerance, solution);
  solution.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return solution;
}

}  // namespace pbd::reference
