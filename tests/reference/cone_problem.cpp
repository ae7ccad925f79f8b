// The cone's projection against its definition, and contacts whose answer is a formula.
#include "cone_problem.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "cone_interior_point.h"
#include "cone_ipopt.h"

using namespace pbd;
using namespace pbd::reference;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr std::array frictions{0.0, 0.1, 0.7, 1.0, 3.0};

/// Points in every region of a cone: inside, in the polar cone, and between; none on a boundary but the apex
/// and the axis, where Ipopt is within the root of its tolerance.
std::vector<Vector3d> points() {
  std::vector<Vector3d> all{Vector3d::Zero(), {1, 0, 0}, {-1, 0, 0}, {0.01, 1, 0}, {0.02, 0, -2}};
  for (int k = 0; k < 40; ++k)
    all.emplace_back(2 * Vector3d(std::sin(1 + 2.3 * k), std::sin(2 + 1.7 * k), std::sin(3 + 3.1 * k)));
  return all;
}

double outside(const Vector3d& r, double mu) {
  return std::max(0.0, r.tail<2>().norm() - mu * r.x());
}
double outside_dual(const Vector3d& u, double mu) {
  return std::max(0.0, mu * u.tail<2>().norm() - u.x());
}

ConeProblem contact(const Matrix3d& w, const Vector3d& q, double mu) {
  return {w.sparseView(), q, VectorXd::Constant(1, mu)};
}

Vector3d solved(const ConeProblem& problem, FrictionLaw law) {
  const ConeSolution found = cone_interior_point(problem, law, 1e-12);
  CHECK(found.outcome == Outcome::ok);
  return found.impulse;
}

}  // namespace

TEST_CASE("projection on a cone: Moreau's conditions, idempotent, non-expansive") {
  for (const double mu : frictions)
    for (const Vector3d& p : points()) {
      const Vector3d r = project_on_cone(p, mu),
                     rest = r - p;  // p = r - rest, r in K, rest in K*, r.rest = 0
      CHECK(outside(r, mu) < 1e-14);
      CHECK(outside_dual(rest, mu) < 1e-14);
      CHECK(std::abs(r.dot(rest)) < 1e-14);
      CHECK((project_on_cone(r, mu) - r).norm() < 1e-15);
      for (const Vector3d& other : points())
        CHECK((r - project_on_cone(other, mu)).norm() <= (p - other).norm() + 1e-15);
    }
}

TEST_CASE("projection on a pyramid: Moreau's conditions, idempotent, non-expansive") {
  for (const double mu : frictions)
    for (const Vector3d& p : points()) {
      const Vector3d r = project_on_pyramid(p, mu), rest = r - p;
      CHECK(r.tail<2>().lpNorm<Eigen::Infinity>() <= mu * r.x());
      CHECK(rest.x() >= mu * rest.tail<2>().lpNorm<1>() - 1e-14);
      CHECK(std::abs(r.dot(rest)) < 1e-14);
      CHECK((project_on_pyramid(r, mu) - r).norm() < 1e-15);
      for (const Vector3d& other : points())
        CHECK((r - project_on_pyramid(other, mu)).norm() <= (p - other).norm() + 1e-15);
    }
}

TEST_CASE("projection on a cone, region by region") {
  CHECK(project_on_cone({2, 0.6, 0.8}, 0.5) == Vector3d(2, 0.6, 0.8));
  CHECK(project_on_cone({-1, 0.6, 0.8}, 0.5) == Vector3d::Zero());
  // On the ray (1, mu t): (n + mu |t|)/(1 + mu^2) times it.
  CHECK((project_on_cone({0, 3, 4}, 1) - Vector3d(2.5, 1.5, 2)).norm() < 1e-15);
  CHECK(project_on_cone({2, 3, 4}, 0) == Vector3d(2, 0, 0));
  CHECK(project_on_cone({-2, 0, 0}, 0) == Vector3d::Zero());
}

TEST_CASE("projection's derivative is that of differences away from the cones' surfaces") {
  constexpr double step = 1e-6;
  for (const double mu : frictions)
    for (const Vector3d& p : points()) {
      const double tau = p.tail<2>().norm();
      if (tau < 0.1 || std::abs(tau - mu * p.x()) < 0.01 || std::abs(mu * tau + p.x()) < 0.01) continue;
      Matrix3d differences;
      for (int k = 0; k < 3; ++k) {
        const Vector3d d = step * Vector3d::Unit(k);
        differences.col(k) = (project_on_cone(p + d, mu) - project_on_cone(p - d, mu)) / (2 * step);
      }
      CHECK((cone_projection_derivative(p, mu) - differences).norm() < 1e-8);
    }
}

TEST_CASE("projection on a cone is what Ipopt finds nearest") {
  for (const double mu : frictions)
    for (const Vector3d& p : points()) {
      if (p.norm() == 0) continue;
      const ConeSolution found = cone_ipopt(contact(Matrix3d::Identity(), -p, mu), FrictionLaw::cone, 1e-12);
      CHECK((found.impulse - project_on_cone(p, mu)).norm() < 1e-9 * std::max(1.0, p.norm()));
    }
}

TEST_CASE("one contact that sticks: the velocity is cancelled, by both laws") {
  Matrix3d w;
  w << 2, 0.3, -0.2, 0.3, 1.5, 0.1, -0.2, 0.1, 1;
  const Vector3d r(1.2, 0.3, -0.4), q = -w * r;
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb})
    CHECK((solved(contact(w, q, 0.6), law) - r).norm() < 1e-12);
}

TEST_CASE(
    "one contact that slides: Coulomb's impulse stops the normal velocity, the cone's leaves mu |u_T|") {
  const double normal = 2, tangent = 0.8, mu = 0.5, slip = 3, approach = 1;
  const Eigen::Vector2d t(0.6, 0.8);
  const ConeProblem problem = contact(Vector3d(normal, tangent, tangent).asDiagonal(),
                                      Vector3d(-approach, slip * t.x(), slip * t.y()), mu);
  const auto along = [&](double r_n) { return Vector3d(r_n, -mu * r_n * t.x(), -mu * r_n * t.y()); };
  // u_N = 0; and the minimum along the ray d = (1, -mu t): -q.d / d.W d.
  const Vector3d coulomb = solved(problem, FrictionLaw::coulomb), cone = solved(problem, FrictionLaw::cone);
  CHECK((coulomb - along(approach / normal)).norm() < 1e-12);
  CHECK((cone - along((approach + mu * slip) / (normal + mu * mu * tangent))).norm() < 1e-12);
  const Vector3d u = problem.velocity(cone);
  CHECK(std::abs(u.x() - mu * u.tail<2>().norm()) < 1e-12);
}

TEST_CASE("one contact by the law box: each tangent has a bound of its own") {
  const ConeProblem problem = contact(Vector3d(2, 1, 0.8).asDiagonal(), Vector3d(-1, 3, -0.1), 0.5);
  const Vector3d exact(0.5, -0.25, 0.125);  // u_N = 0; tangent 1 slides, tangent 2 sticks
  CHECK(measure_cone(problem, FrictionLaw::box, exact).residual() < 1e-15);
  CHECK(measure_cone(problem, FrictionLaw::box, exact).gap < 1e-15);
  CHECK(measure_cone(problem, FrictionLaw::box, exact).feasibility() < 1e-15);
  const Vector3d free = Vector3d(-1, 3, -0.1);
  for (int axis = 0; axis < 3; ++axis)  // a thousandth beside it
    CHECK(measure_cone(problem, FrictionLaw::box, exact + 1e-3 * Vector3d::Unit(axis)).natural_residual >
          1e-4 / free.norm());
  CHECK(measure_cone(problem, FrictionLaw::coulomb, exact).natural_residual > 1e-3);
  const ConeProblem both = contact(Vector3d(2, 1, 0.8).asDiagonal(), Vector3d(-1, 3, -4), 0.5);
  CHECK(measure_cone(both, FrictionLaw::box, Vector3d(0.5, -0.25, 0.25)).residual() < 1e-15);  // both slide
}

TEST_CASE("one contact that separates: nothing by Coulomb's law, an impulse by the cone's if it slips fast") {
  const Matrix3d w = Matrix3d::Identity();
  for (const double away : {0.1, 2.0}) {
    const ConeProblem problem = contact(w, Vector3d(away, 2, 0), 0.5);
    CHECK(solved(problem, FrictionLaw::coulomb).norm() < 1e-13);
    // -q projected: zero where q_N >= mu |q_T|.
    CHECK((solved(problem, FrictionLaw::cone) - project_on_cone({-away, -2, 0}, 0.5)).norm() < 1e-13);
  }
  CHECK(solved(contact(w, Vector3d(0.1, 2, 0), 0.5), FrictionLaw::cone).norm() > 0.1);
}

TEST_CASE("a contact without friction: r_N = max(0, -q_N / W_NN)") {
  const Matrix3d w = Vector3d(4, 1, 2).asDiagonal();
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb})
    for (const double q : {-3.0, 3.0})
      CHECK((solved(contact(w, Vector3d(q, 1, -2), 0), law) - Vector3d(std::max(0.0, -q / 4), 0, 0)).norm() <
            1e-12);
}

TEST_CASE("measures of impulses that are wrong by known amounts") {
  const ConeProblem problem = contact(Matrix3d::Identity(), Vector3d(-1, 0, 0), 0.5);  // r* = (1, 0, 0)
  const ConeMeasures none = measure_cone(problem, FrictionLaw::cone, Vector3d::Zero());
  CHECK(none.natural_residual == 1);   // 0 - P_K(0 - q) = -(1, 0, 0)
  CHECK(none.velocity_distance == 1);  // u = q
  const ConeMeasures half = measure_cone(problem, FrictionLaw::cone, Vector3d(0.5, 0, 0));
  CHECK(std::abs(half.natural_residual - 0.5) < 1e-15);
  CHECK(std::abs(half.gap - 0.25 / 0.75) < 1e-15);  // r.u = -1/4 over r.W r + |r.q| = 1/4 + 1/2
  CHECK(std::abs(half.objective + 0.375) < 1e-15);
  const ConeMeasures beside = measure_cone(problem, FrictionLaw::cone, Vector3d(0, 2, 0));
  CHECK(std::abs(beside.impulse_distance - 2 / std::sqrt(1.25) / 2) <
        1e-15);  // of (0, 2) from the ray (1, mu)
  ConeSolution spoilt;
  spoilt.impulse = Vector3d(std::nan(""), 0, 0);
  certify(problem, FrictionLaw::cone, 1, spoilt);
  CHECK(spoilt.outcome == Outcome::not_converged);
}

TEST_CASE("wrong impulses are not ok, whatever the unit of mass") {
  Matrix3d w;
  w << 2, 0.3, 0.1, 0.3, 1.5, 0.2, 0.1, 0.2, 1;
  const Vector3d q(-1, 0.1, 0.05);  // sticks
  for (const double unit : {1e-12, 1e-6, 1.0, 1e6, 1e12})
    for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb}) {
      const ConeProblem problem = contact(unit * w, q, 0.7);
      ConeSolution right, wrong;
      right.impulse = -w.inverse() * q / unit;
      wrong.impulse = 0.99 * right.impulse;
      certify(problem, law, 1e-8, right);
      certify(problem, law, 1e-3, wrong);
      INFO(unit);
      CHECK(right.outcome == Outcome::ok);
      CHECK(wrong.outcome == Outcome::not_converged);
    }
}

TEST_CASE("what overflows is not ok") {
  ConeSolution none;
  none.impulse = Vector3d::Zero();
  certify(contact(Matrix3d::Identity(), Vector3d(-1e300, 0, 0), 0.5), FrictionLaw::cone, 1e-8, none);
  CHECK(none.outcome == Outcome::not_converged);
}

TEST_CASE("no impulse holds a contact that nothing moves") {
  const ConeProblem fixed = contact(Matrix3d::Zero(), Vector3d(-1, 0.5, 0), 0.5);
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb})
    for (const auto& found : {cone_interior_point(fixed, law, 1e-10), cone_ipopt(fixed, law, 1e-10)}) {
      CHECK(found.outcome == Outcome::not_converged);
      CHECK_FALSE(found.reason.empty());
    }
}

TEST_CASE("impulses so large that rounding hides the velocity are not certified") {
  const ConeProblem fixed = contact(Matrix3d::Zero(), Vector3d(-1, 0, 0), 0.5);
  ConeSolution large;
  large.impulse = Vector3d(1e17, 0, 0);  // 1e17 + 1 is 1e17
  certify(fixed, FrictionLaw::coulomb, 1e-8, large);
  CHECK(large.measures.residual() <= 1e-8);
  CHECK(large.outcome == Outcome::not_converged);
}
