// Projections of friction laws, and the impulse of one contact.
#include "rows/laws.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include <Eigen/Dense>

using namespace pbd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr std::array coefficients{0.0, 1e-6, 0.3, 1.0, 10.0, 1e6};

struct Random {
  std::mt19937_64 engine{1};
  std::normal_distribution<double> normal;
  Vector3d operator()() { return {normal(engine), normal(engine), normal(engine)}; }
};

bool in_cone(double mu, const Vector3d& p, double slack) {
  return std::hypot(p[1], p[2]) <= mu * p[0] + slack;
}

/// u_n >= mu |u_t|
bool in_dual(double mu, const Vector3d& u, double slack) {
  return u[0] >= mu * std::hypot(u[1], u[2]) - slack;
}

Matrix3d random_delassus(Random& random) {
  Matrix3d root;
  for (int k = 0; k < 3; ++k) root.col(k) = random();
  return root * root.transpose() + 0.1 * Matrix3d::Identity();
}

}  // namespace

TEST_CASE("the projection onto a cone splits points as Moreau says") {
  Random random;
  std::array<int, 3> regions{};
  for (const double mu : coefficients)
    for (int k = 0; k < 2000; ++k) {
      const Vector3d p = random(), q = random();
      const Vector3d to = project_to_cone(mu, p);
      const double slack = 1e-14 * (1 + mu) * p.norm();
      INFO("mu " << mu << " p " << p.transpose());
      CHECK(in_cone(mu, to, slack));
      CHECK(in_dual(mu, to - p, slack));  // p = to - rest, rest in the dual cone
      CHECK(std::abs(to.dot(to - p)) <= slack * p.norm());
      CHECK((project_to_cone(mu, to) - to).norm() <= slack);
      CHECK((project_to_cone(mu, q) - to).norm() <= (p - q).norm() * (1 + 1e-14) + slack);
      ++regions[to == p ? 0 : to.isZero(0) ? 1 : 2];
    }
  for (const int visited : regions) CHECK(visited > 100);
}

TEST_CASE("derivatives of the laws' projections are those of central differences") {
  Random random;
  constexpr double shift = 1e-6;
  for (const Friction law : {Friction::coulomb, Friction::cone, Friction::box, Friction::disc}) {
    int smooth = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vector3d p = project_to_cone(0.7, random()), step = random();
      const auto found = project_derivative(law, 0.7, p, step);
      Matrix3d by_p, by_step;
      double bend = 0;  // of the projection within the shift: a kink
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d e = shift * Vector3d::Unit(axis);
        const Vector3d middle = project(law, 0.7, p, step);
        const Vector3d up = project(law, 0.7, p, step + e), down = project(law, 0.7, p, step - e);
        by_step.col(axis) = (up - down) / (2 * shift);
        by_p.col(axis) = (project(law, 0.7, p + e, step) - project(law, 0.7, p - e, step)) / (2 * shift);
        bend = std::max(bend, (up - 2 * middle + down).norm() / shift);
      }
      if (bend > 1e-3) continue;
      ++smooth;
      INFO(friction_names[static_cast<std::size_t>(law)] << " p " << p.transpose() << " step "
                                                         << step.transpose());
      CHECK((found.by_p - by_p).norm() <= 1e-4);
      CHECK((found.by_step - by_step).norm() <= 1e-4);
    }
    CHECK(smooth > 1900);
  }
}

TEST_CASE("one contact's impulse obeys its law") {
  Random random;
  std::array<int, 3> kinds{};  // open, sticking, sliding
  for (const double mu : {0.0, 0.3, 0.8, 5.0, 1e6}) {
    const int slid_before = kinds[2];
    for (int k = 0; k < 500; ++k) {
      const Matrix3d n = random_delassus(random);
      const Vector3d q = random();
      INFO("mu " << mu << " q " << q.transpose());
      const std::array<Vector3d, 4> starts{Vector3d::Zero(), random(), {1, 1e-9, 1e-9}, {1, 1e-40, 1e-40}};
      const Vector3d p = solve_contact(Friction::coulomb, mu, n, q, starts[k % starts.size()]);
      const Vector3d u = n * p + q;
      // |p_t| and mu p_n are compared to their rounding, which a large mu makes of p_n.
      const double rounding = 16 * std::numeric_limits<double>::epsilon() * mu * std::abs(q[0]) / n(0, 0);
      const double slip = u.tail<2>().norm(), slack = 1e-9 * (1 + q.norm()) + n.norm() * rounding;
      CHECK(in_cone(mu, p, slack));
      CHECK(u[0] >= -slack);
      CHECK(std::abs(p[0] * u[0]) <= slack);
      if (p.isZero(0)) {
        ++kinds[0];
      } else if (slip <= slack) {
        ++kinds[1];
      } else {
        ++kinds[2];
        CHECK((p.tail<2>() + mu * p[0] / slip * u.tail<2>()).norm() <= slack * (1 + 1 / slip));
      }
      if (mu > 1) continue;  // projections are slow there
      Vector3d convex = Vector3d::Zero();
      for (int call = 0; call < 200; ++call) convex = solve_contact(Friction::cone, mu, n, q, convex);
      const Vector3d rest = n * convex + q;
      CHECK(in_cone(mu, convex, slack));
      CHECK(in_dual(mu, rest, slack));
      CHECK(std::abs(convex.dot(rest)) <= slack);
    }
    CHECK(kinds[2] > slid_before + 20);
  }
  for (const int kind : kinds) CHECK(kind > 20);
}

TEST_CASE("one contact slides whose friction turns far on its way from sticking") {
  Matrix3d n;
  n << 635, 386, 616, 386, 238, 363, 616, 363,
      638;  // condition 2e4: Newton's method alone goes round
  const Vector3d q(-6, -4, -3), p = solve_contact(Friction::coulomb, 1, n, q, Vector3d::Zero()),
                                u = n * p + q;
  CHECK(std::abs(u[0]) <= 1e-9 * q.norm());
  CHECK((p.tail<2>() * u.tail<2>().norm() + p[0] * u.tail<2>()).norm() <= 1e-9 * p.norm() * u.norm());
}

TEST_CASE("one contact whose Delassus matrix is singular, and one without friction") {
  const auto check = [](Friction law, double mu, const Matrix3d& n, const Vector3d& q) {
    Vector3d p = Vector3d::Zero();
    for (int call = 0; call < 1000; ++call) p = solve_contact(law, mu, n, q, p);
    INFO(friction_names[static_cast<std::size_t>(law)] << " " << mu << " " << p.transpose());
    CHECK(in_cone(mu, p, 1e-9));
    CHECK((project(law, mu, p, -(n * p + q)) - p).norm() <= 1e-9 * q.norm());
  };
  const Vector3d along(1, 0.5, -0.25);
  const Matrix3d rank_one = along * along.transpose();
  Matrix3d rank_two;  // its inverse would be infinite, not NaN
  rank_two << 2, -1, -1, -1, 2, -1, -1, -1, 2;
  for (const Friction law : {Friction::disc, Friction::coulomb, Friction::cone})
    for (const double mu : {0.0, 0.5})
      for (const Matrix3d& n : {rank_one, rank_two})
        for (const Vector3d& q : {Vector3d(-2 * along), Vector3d(-1, -1, -1)}) check(law, mu, n, q);
  check(Friction::disc, 1e6, rank_one, -2 * along);
  CHECK(project_to_cone(0, {-1, 0, 0}).isZero(0));
  CHECK(project_derivative(Friction::cone, 0, {-1, 0, 0}, Vector3d::Zero()).by_p.isZero(0));
}

TEST_CASE("friction laws have names") {
  for (std::size_t i = 0; i < friction_names.size(); ++i)
    CHECK(static_cast<std::size_t>(friction_by_name(friction_names[i])) == i);
  CHECK_THROWS(friction_by_name("pyramid"));
}
