// Contact problems with bounded rows (limits and motors of limited force) beside their cones, by hand and
// planted.
#include <catch2/catch.hpp>
#include <cmath>

#include "cone_interior_point.h"
#include "cone_ipopt.h"
#include "planted_draw.h"

using namespace pbd::reference;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using pbd::infinity;

namespace {

ConeProblem one_row(double w, double q, double lower, double upper) {
  ConeProblem problem;
  problem.delassus = MatrixXd::Constant(1, 1, w).sparseView();
  problem.free_velocity = VectorXd::Constant(1, q);
  problem.lower = VectorXd::Constant(1, lower);
  problem.upper = VectorXd::Constant(1, upper);
  return problem;
}

double impulse_of(const ConeProblem& problem, FrictionLaw law = FrictionLaw::cone) {
  const ConeSolution found = cone_interior_point(problem, law, 1e-12);
  INFO(found.reason);
  CHECK(found.outcome == Outcome::ok);
  return found.impulse(0);
}

/// Eight contacts and ten bounded rows at either bound, between them, and at the only one that they have.
PlantedCone with_bounds(FrictionLaw law, std::uint64_t seed, int coordinates) {
  constexpr int contacts = 8, bounded = 10;
  planted::Random random(seed);
  PlantedCone p;
  ConeProblem& problem = p.problem;
  const MatrixXd j =
      MatrixXd::NullaryExpr(3 * contacts + bounded, coordinates, [&] { return random.between(-1, 1); });
  problem.delassus = MatrixXd(j * j.transpose()).sparseView();
  problem.friction = planted::frictions(contacts, random);
  problem.lower.resize(bounded), problem.upper.resize(bounded);
  p.impulse.resize(problem.rows()), p.velocity.resize(problem.rows());
  VectorXd shift = VectorXd::Zero(problem.rows());
  const auto drawn = planted::plant_all(law, problem.friction, 0, random);
  for (int i = 0; i < contacts; ++i) {
    p.impulse.segment<3>(3 * i) = drawn[static_cast<std::size_t>(i)].r;
    p.velocity.segment<3>(3 * i) = drawn[static_cast<std::size_t>(i)].u;
  }
  for (int k = 0; k < bounded; ++k) {
    const int row = 3 * contacts + k;
    double &lower = problem.lower(k), &upper = problem.upper(k), &r = p.impulse(row), &u = p.velocity(row);
    lower = -random.between(0.1, 1), upper = random.between(0.1, 1);
    const double away = random.between(0.1, 1), inside = random.between(0.01, 0.09);
    switch (k % 5) {
      case 0:
        r = lower, u = away;
        break;
      case 1:
        r = upper, u = -away;
        break;
      case 2:
        r = inside, u = 0;
        break;
      case 3:
        r = lower = 0, u = away, upper = infinity;
        break;
      default:
        r = upper = inside, u = -away, lower = -infinity;
        break;
    }
  }
  problem.free_velocity = p.velocity - problem.delassus * p.impulse;
  return p;
}

}  // namespace

TEST_CASE("one bounded row is at the bound that its velocity asks for or else at rest") {
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb}) {
    CHECK(std::abs(impulse_of(one_row(2, -1, -3, 3), law) - 0.5) <= 1e-12);
    CHECK(std::abs(impulse_of(one_row(2, -10, -3, 3), law) - 3) <= 1e-12);
    CHECK(std::abs(impulse_of(one_row(2, 10, -2, 3), law) + 2) <= 1e-12);
    CHECK(std::abs(impulse_of(one_row(2, -10, 0, infinity), law) - 5) <= 1e-12);
    CHECK(std::abs(impulse_of(one_row(2, 10, 0, infinity), law)) <= 1e-12);
    CHECK(std::abs(impulse_of(one_row(2, 10, -infinity, 0), law) + 5) <= 1e-12);
  }
}

TEST_CASE("residuals of bounded rows tell an impulse off its bounds and a velocity that no bound answers") {
  const ConeProblem problem = one_row(2, -10, 0, 3);  // p = 3 and u = -4 solve it
  const auto natural = [&](double impulse) {
    return measure_cone(problem, FrictionLaw::cone, VectorXd::Constant(1, impulse)).natural_residual;
  };
  CHECK(natural(3) == 0);
  CHECK(std::abs(natural(2) - 0.1) <= 1e-15);  // |2 - clamp(2 + 6)| over |q|
  CHECK(std::abs(natural(4) - 0.1) <= 1e-15);
  CHECK(measure_cone(problem, FrictionLaw::cone, VectorXd::Constant(1, 4.0)).impulse_distance == 0.25);
  // From below alone it has to go where its velocity is not negative.
  const ConeProblem limit = one_row(2, -10, 0, infinity);
  CHECK(measure_cone(limit, FrictionLaw::cone, VectorXd::Constant(1, 3.0)).velocity_distance == 0.4);
}

TEST_CASE("planted velocities of contacts beside bounded rows are found, of the convex law the only ones") {
  for (int seed = 1; seed <= planted_seeds; ++seed)
    for (const int coordinates : {60, 20}) {
      INFO(seed << " " << coordinates);
      const PlantedCone p = with_bounds(FrictionLaw::cone, static_cast<std::uint64_t>(seed), coordinates);
      CHECK(measure_cone(p.problem, FrictionLaw::cone, p.impulse).natural_residual < 1e-13);
      const ConeSolution found = cone_interior_point(p.problem, FrictionLaw::cone, 1e-10);
      CHECK(found.outcome == Outcome::ok);
      CHECK((found.velocity - p.velocity).norm() <= 1e-10 * p.problem.free_velocity.norm());
      const PlantedCone of_coulomb =
          with_bounds(FrictionLaw::coulomb, static_cast<std::uint64_t>(seed), coordinates);
      CHECK(cone_interior_point(of_coulomb.problem, FrictionLaw::coulomb, 1e-10).outcome == Outcome::ok);
    }
}

TEST_CASE("interior point alone comes near bounded rows at their bounds and off them") {
  const PlantedCone p = with_bounds(FrictionLaw::cone, 3, 60);
  ConeSolution found = interior_point(p.problem);
  certify(p.problem, FrictionLaw::cone, 1e-4, found);
  INFO(found.reason);
  CHECK(found.outcome == Outcome::ok);
}

TEST_CASE("Ipopt finds the planted velocity beside bounded rows") {
  for (int seed = 1; seed <= 3; ++seed) {
    const PlantedCone p = with_bounds(FrictionLaw::cone, static_cast<std::uint64_t>(seed), 60);
    const ConeSolution found = cone_ipopt(p.problem, FrictionLaw::cone, 1e-8);
    INFO(found.reason);
    CHECK((found.velocity - p.velocity).norm() <= 1e-6 * p.problem.free_velocity.norm());
  }
}

TEST_CASE("work that is spent ends a cone problem with what was found so far") {
  const PlantedCone p = with_bounds(FrictionLaw::coulomb, 1, 60);
  int polled = 0;
  ConeWork work{5, [&] { ++polled; }};
  const ConeSolution found = cone_interior_point(p.problem, FrictionLaw::coulomb, 1e-10, &work);
  CHECK(found.outcome == Outcome::not_converged);
  CHECK_FALSE(found.reason.empty());
  CHECK(found.iterations <= 5);
  CHECK(polled >= 5);
  CHECK(work.spent());
}
