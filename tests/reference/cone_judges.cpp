// The judges of contact with friction against planted solutions, and against each other.
#include <catch2/catch.hpp>

#include "cone_fixed_point.h"
#include "cone_interior_point.h"
#include "cone_ipopt.h"
#include "cone_newton.h"
#include "planted_cones.h"

using namespace pbd::reference;
using Eigen::VectorXd;

namespace {

double velocity_error(const PlantedCone& planted, const ConeSolution& found) {
  return (found.velocity - planted.velocity).norm() / planted.problem.free_velocity.norm();
}

}  // namespace

TEST_CASE("planted impulses solve their problems, of both laws, and not those of the other") {
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb})
    for (const auto& family : planted_families()) {
      INFO(family.name);
      double other = 0;
      for (int seed = 1; seed <= planted_seeds; ++seed) {
        const PlantedCone p = family.draw(law, seed);
        const auto wrong = law == FrictionLaw::cone ? FrictionLaw::coulomb : FrictionLaw::cone;
        CHECK(measure_cone(p.problem, law, p.impulse).natural_residual < 1e-14);
        other = std::max(other, measure_cone(p.problem, wrong, p.impulse).natural_residual);
      }
      CHECK((other > 1e-6) == (family.name != "wedge"));  // where nothing slips the laws agree
    }
}

TEST_CASE("interior point and polish find the planted velocity of all 200 cones") {
  for (const auto& family : planted_families())
    for (int seed = 1; seed <= planted_seeds; ++seed) {
      INFO(family.name << " " << seed);
      const PlantedCone p = family.draw(FrictionLaw::cone, seed);
      const ConeSolution found = cone_interior_point(p.problem, FrictionLaw::cone, 1e-10);
      CHECK(found.outcome == Outcome::ok);
      CHECK(found.measures.natural_residual <= 1e-10);
      CHECK(velocity_error(p, found) < 1e-10);
      CHECK(found.measures.gap < 1e-10);
      CHECK(found.measures.feasibility() < 1e-10);
    }
}

TEST_CASE("interior point alone is near, its velocity within the root of its gap") {
  for (const auto& family : planted_families()) {
    INFO(family.name);
    const PlantedCone p = family.draw(FrictionLaw::cone, 1);
    ConeSolution found = interior_point(p.problem);
    certify(p.problem, FrictionLaw::cone, 1e-4, found);
    CHECK(found.outcome == Outcome::ok);
  }
}

TEST_CASE("Coulomb's law: all 200 are solved to rounding, by the planted velocity or another") {
  for (const auto& family : planted_families())
    for (int seed = 1; seed <= planted_seeds; ++seed) {
      INFO(family.name << " " << seed);
      const PlantedCone p = family.draw(FrictionLaw::coulomb, seed);
      const ConeSolution found = cone_interior_point(p.problem, FrictionLaw::coulomb, 1e-10);
      CHECK(measure_cone(p.problem, FrictionLaw::coulomb, found.impulse).natural_residual <= 1e-10);
      if (family.name == "full_rank" || family.name == "wedge") CHECK(velocity_error(p, found) < 1e-10);
    }
}

TEST_CASE(
    "a hundred and fifty contacts with mass ratio 1e4, redundant, some with neither impulse nor velocity") {
  for (int seed = 1; seed <= 2; ++seed) {
    const PlantedCone p = planted_hard(FrictionLaw::cone, 150, seed);
    CHECK(velocity_error(p, cone_interior_point(p.problem, FrictionLaw::cone, 1e-10)) < 1e-10);
  }
}

TEST_CASE("the answer does not depend on units") {
  const PlantedCone p = planted_families()[6].draw(FrictionLaw::cone, 3);
  for (const double unit : {1e-6, 1e6}) {
    ConeProblem other = p.problem;  // velocities times `unit`, impulses as they are
    other.delassus *= unit;
    other.free_velocity *= unit;
    const ConeSolution found = cone_interior_point(other, FrictionLaw::cone, 1e-10);
    CHECK((found.velocity / unit - p.velocity).norm() < 1e-10 * p.problem.free_velocity.norm());
  }
}

TEST_CASE("Newton's polish never makes impulses worse") {
  const PlantedCone p = planted_families()[1].draw(FrictionLaw::coulomb, 4);
  for (const double size : {0.0, 1.0, 100.0}) {
    VectorXd impulse = VectorXd::Constant(p.impulse.size(), size);
    const double before = measure_cone(p.problem, FrictionLaw::coulomb, impulse).natural_residual;
    cone_newton(p.problem, FrictionLaw::coulomb, 1e-15, impulse);
    CHECK(measure_cone(p.problem, FrictionLaw::coulomb, impulse).natural_residual <= before);
  }
}

TEST_CASE("the fixed point needs no polish where friction couples little") {
  const PlantedCone p = planted_families()[0].draw(FrictionLaw::coulomb, 2);
  const auto minimum = [](const ConeProblem& q) { return cone_interior_point(q, FrictionLaw::cone, 1e-14); };
  const ConeSolution found = coulomb_by_fixed_point(p.problem, 1e-11, {minimum, {}});
  CHECK(found.outcome == Outcome::ok);
  CHECK(velocity_error(p, found) < 1e-9);
}

TEST_CASE("Ipopt finds the planted velocities without looking at its status") {
  for (const auto& family : planted_families())
    for (int seed = 1; seed <= 3; ++seed) {
      INFO(family.name << " " << seed);
      const PlantedCone p = family.draw(FrictionLaw::cone, seed);
      const ConeSolution found = cone_ipopt(p.problem, FrictionLaw::cone, 1e-8);
      CHECK(found.outcome == Outcome::ok);
      CHECK(velocity_error(p, found) < 1e-6);
    }
  const PlantedCone p = planted_families()[0].draw(FrictionLaw::coulomb, 1);
  CHECK(velocity_error(p, cone_ipopt(p.problem, FrictionLaw::coulomb, 1e-8)) < 1e-6);
}

TEST_CASE("Ipopt says which problems are too large for it") {
  const PlantedCone p = planted_regular(FrictionLaw::cone, most_ipopt_contacts + 1, 1);
  const ConeSolution refused = cone_ipopt(p.problem, FrictionLaw::cone, 1e-8);
  CHECK(refused.outcome == Outcome::not_converged);
  CHECK(refused.reason.find("contacts") != std::string::npos);
}
