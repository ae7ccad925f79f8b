// An unsymmetric W by problems with its symmetric part: where that converges, and how it ends elsewhere.
#include "cones/cone_solvers.h"

#include <catch2/catch.hpp>
#include <limits>

#include "dense.h"
#include "planted_family.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using namespace pbd::reference;
using Eigen::MatrixXd;

namespace {

constexpr double asked = 1e-8;

/// S + K, S symmetric and regular, |S^-1/2 K S^-1/2| = `size`.
ConeProblem unsymmetric(FrictionLaw law, double size) {
  ConeProblem problem = draw_planted("full_rank", law, 1).problem;
  const MatrixXd s = problem.delassus;
  const auto eigen = symmetric_eigen(s);
  const MatrixXd root = eigen.vectors * eigen.values.cwiseSqrt().asDiagonal();
  MatrixXd skew = MatrixXd::NullaryExpr(s.rows(), s.cols(), [](Eigen::Index i, Eigen::Index j) {
    return std::sin(static_cast<double>(i * i + 3 * j));
  });
  skew = (skew - skew.transpose()).eval();
  const double norm = std::sqrt(symmetric_eigen(transposed_product(skew, skew)).values.maxCoeff());
  problem.delassus = (s + size / norm * congruence(skew, root.transpose())).sparseView();
  return problem;
}

/// A judge that counts its calls and finds `impulse`.
ConeSolver counted(int& calls, double impulse, const std::string& reason) {
  return {"counted",
          {},
          [=, &calls](const ConeTask& task) {
            ++calls;
            ConeSolution found;
            found.impulse = Eigen::VectorXd::Constant(task.problem.free_velocity.size(), impulse);
            found.reason = reason;
            return found;
          },
          ConeSolverKind::judge};
}

}  // namespace

TEST_CASE("an unsymmetric W is solved by problems with its symmetric part while these contract") {
  const ConeProblem problem = unsymmetric(FrictionLaw::cone, 0.8);
  const ConeTask task{problem, FrictionLaw::cone, asked, most_sweeps};
  for (const auto* name : {"cone_interior_point", "gauss_seidel"}) {
    const ConeSolution found = solve_as_given(find_cone_solver(name, "cone"), task);
    CHECK(found.outcome == Outcome::ok);
    CHECK(found.reason.empty());
    CHECK(measure_cone(problem, FrictionLaw::cone, found.impulse).natural_residual <= asked);
  }
}

TEST_CASE("where they do not contract the best of them stays, with the asymmetry as the reason") {
  const ConeProblem problem = unsymmetric(FrictionLaw::coulomb, 50);
  const auto& judge = find_cone_solver("cone_interior_point", "coulomb");
  const ConeProblem part = symmetric(problem);
  const ConeSolution first = judge.solve({part, FrictionLaw::coulomb, 0.1 * asked, most_sweeps});
  const ConeSolution found = solve_as_given(judge, {problem, FrictionLaw::coulomb, asked, most_sweeps});
  CHECK(found.outcome == Outcome::not_converged);
  CHECK_THAT(found.reason, Catch::StartsWith("splitting W does not contract (asymmetry ") &&
                               Catch::Contains("asked for 1e-08"));
  CHECK(found.measures.residual() <= measure_cone(problem, FrictionLaw::coulomb, first.impulse).residual());
}

TEST_CASE("problems with the symmetric part end where one is not solved, not finite or no better") {
  const ConeProblem problem = unsymmetric(FrictionLaw::coulomb, 0.5);
  const ConeTask task{problem, FrictionLaw::coulomb, asked, most_sweeps};
  struct End {
    double impulse;
    std::string reason;
    int calls;
    std::string why;
  };
  for (const auto& [impulse, reason, calls, why] :
       {End{std::nan(""), "", 1, "impulses are not finite"},
        {std::numeric_limits<double>::infinity(), "", 1, "impulses are not finite"},
        {1, "", 6, "splitting W does not contract"},  // the first, and five that are no better
        {1, "no step helps", 2, "W's symmetric part is not solved: no step helps"}}) {
    INFO(why << " " << impulse);
    int called = 0;
    const ConeSolution found = solve_as_given(counted(called, impulse, reason), task);
    CHECK(called == calls);
    CHECK(found.outcome == Outcome::not_converged);
    CHECK_THAT(found.reason, Catch::StartsWith(why + " (asymmetry "));
  }
}
