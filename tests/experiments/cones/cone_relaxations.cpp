// The solver's relaxations on contact problems given by W alone: planted ones, and those of a step's rows.
#include "cones/cone_relaxations.h"

#include <catch2/catch.hpp>

#include "harness/rows_of_step.h"
#include "linear/linear_names.h"
#include "planted_family.h"
#include "scenes/contacts.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using namespace pbd::reference;
using Eigen::VectorXd;

namespace {

constexpr double tolerance = 1e-8;

/// A pyramid whose top slides.
pbd::Scene sliding_top() {
  pbd::Scene scene = pyramid(2);
  const auto top = static_cast<Eigen::Index>(scene.nodes() - 1);
  scene.initial.v.col(top) = pbd::Vec3(1, 0.5, 0);
  return scene;
}

}  // namespace

TEST_CASE("every relaxation solves planted problems whose W is well-conditioned, by both laws") {
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb})
    for (const auto* family : {"full_rank", "both_zero"})
      for (const auto relaxation : pbd::general_solver_names())
        for (int seed = 1; seed <= 3; ++seed) {
          INFO(relaxation << " " << family << " " << seed);
          const PlantedCone p = draw_planted(family, law, seed);
          const ConeSolution found = relax_cone(relaxation, {p.problem, law, tolerance, 2000});
          CHECK(found.outcome == Outcome::ok);
          CHECK(measure_cone(p.problem, law, found.impulse).natural_residual <= tolerance);
          CHECK((found.velocity - p.velocity).norm() < 1e-5 * p.problem.free_velocity.norm());
        }
}

TEST_CASE(
    "every relaxation finds a contact that slides along one axis and sticks along the other by the law box") {
  ConeProblem problem;
  problem.delassus = Eigen::Vector3d(2, 1, 0.8).asDiagonal().toDenseMatrix().sparseView();
  problem.free_velocity = Eigen::Vector3d(-1, 3, -0.1);
  problem.friction = VectorXd::Constant(1, 0.5);
  for (const auto relaxation : pbd::general_solver_names()) {
    INFO(relaxation);
    const ConeSolution found = relax_cone(relaxation, {problem, FrictionLaw::box, tolerance, 2000});
    CHECK(found.outcome == Outcome::ok);
    CHECK((found.impulse - Eigen::Vector3d(0.5, -0.25, 0.125)).norm() < 1e-7);
  }
}

TEST_CASE("direct solves redundant problems, where Newton's step alone gains nothing at times") {
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb})
    for (int seed = 1; seed <= planted_seeds; ++seed) {
      INFO(seed);
      const PlantedCone p = draw_planted("redundant", law, seed);
      CHECK(relax_cone("direct", {p.problem, law, tolerance, 200}).outcome == Outcome::ok);
    }
}

TEST_CASE("large regular problems are solved") {
  const PlantedCone p = planted_regular(FrictionLaw::cone, 450, 1);
  for (const auto* relaxation : {"gauss_seidel", "nesterov_jacobi", "direct"})
    CHECK(relax_cone(relaxation, {p.problem, FrictionLaw::cone, tolerance, 2000}).outcome == Outcome::ok);
}

TEST_CASE("a step's rows and the columns of their W are swept alike") {
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb}) {
    const LinearStep step =
        linear_step(sliding_top(), sliding_top().initial, 0.01,
                    law == FrictionLaw::cone ? pbd::Friction::cone : pbd::Friction::coulomb);
    const ConeProblem problem = cone_problem(step.rows, step.v_free);
    REQUIRE(problem.contacts() >= 12);
    // Of direct one iteration: where its steps fail it goes other ways by rows than by columns. By rows it
    // eliminates impulses, which rounding sees through the shift, 1e-8 of W, each row's.
    const double eliminated =
        1e8 * std::numeric_limits<double>::epsilon() * static_cast<double>(row_count(step.rows));
    struct Alike {
      std::string_view relaxation;
      int sweeps;
      double rounding;
    };
    for (const auto& [relaxation, sweeps, rounding] :
         {Alike{"gauss_seidel", 3, 1e-9}, {"conjugate_gradients", 3, 1e-9}, {"direct", 1, eliminated}}) {
      INFO(relaxation);
      const ConeTask task{problem, law, 1e-300, sweeps};
      const VectorXd rows = relax_cone(relaxation, step.rows, step.v_free, task).impulse;
      const VectorXd columns = relax_cone(relaxation, task).impulse;
      CHECK(rows.norm() > 0.01);
      CHECK((problem.delassus * (rows - columns)).norm() < rounding * problem.free_velocity.norm());
    }
    for (const auto relaxation : pbd::general_solver_names()) {
      INFO(relaxation);
      const ConeTask task{problem, law, tolerance, 20000};
      CHECK(relax_cone(relaxation, step.rows, step.v_free, task).outcome == Outcome::ok);
      CHECK(relax_cone(relaxation, task).outcome == Outcome::ok);
    }
  }
}

TEST_CASE("a contact that nothing can move stays as it is, whatever happens to the others") {
  PlantedCone p = draw_planted("full_rank", FrictionLaw::coulomb, 1);
  const auto rows = p.problem.free_velocity.size();
  ConeProblem wider;
  wider.delassus = p.problem.delassus;
  wider.delassus.conservativeResize(rows + 3, rows + 3);
  wider.free_velocity.resize(rows + 3);
  wider.free_velocity << p.problem.free_velocity, 1, 0, 0;
  wider.friction.resize(p.problem.contacts() + 1);
  wider.friction << p.problem.friction, 0.5;
  for (const auto relaxation : pbd::general_solver_names()) {
    INFO(relaxation);
    const ConeSolution found = relax_cone(relaxation, {wider, FrictionLaw::coulomb, tolerance, 2000});
    CHECK(found.outcome == Outcome::ok);
    CHECK(found.impulse.tail<3>().isZero(0));
    wider.free_velocity(rows) = -1;  // now it is pressed into what does not give way
    const ConeSolution refused = relax_cone(relaxation, {wider, FrictionLaw::coulomb, tolerance, 2000});
    CHECK(refused.outcome == Outcome::not_converged);
    CHECK(refused.impulse.allFinite());
    wider.free_velocity(rows) = 1;
  }
}
