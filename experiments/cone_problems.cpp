// How well are contact problems with friction solved whose answer was planted?
#include "cone_solvers.h"

#include <cmath>

#include "experiments.h"
#include "measure.h"
#include "planted_cones.h"

namespace pbdcheck {
namespace {

using namespace pbd::reference;
using Eigen::VectorXd;

constexpr double tolerance = 1e-8;
constexpr double agreement = 1e-6;  // m/s; planted velocities are of 1 m/s

double largest(const VectorXd& v) {
  return v.allFinite() ? v.cwiseAbs().maxCoeff() : std::nan("");
}

struct Problem {
  std::string family;
  int number;
  PlantedCone planted;
};

/// The 200 small ones.
std::vector<Problem> small_problems(FrictionLaw law) {
  std::vector<Problem> all;
  for (const auto& family : planted_families())
    for (int i = 1; i <= planted_seeds; ++i)
      all.push_back({std::string(family.name), i, family.draw(law, static_cast<std::uint64_t>(i))});
  return all;
}

std::vector<Problem> large_problems(FrictionLaw law, bool full) {
  std::vector<Problem> all;
  const int each = full ? 3 : 1;
  for (const int contacts : full ? std::vector{150, 450, 900, 3000} : std::vector{150, 450, 900})
    for (int i = 1; i <= each; ++i) {
      const auto drawn = static_cast<std::uint64_t>(i);
      all.push_back({"regular", i, planted_regular(law, contacts, drawn)});
      all.push_back({"hard", i, planted_hard(law, contacts, drawn)});
    }
  return all;
}

std::vector<std::string> columns() {
  return {"family",           "number", "contacts",    "law",           "relaxation",
          "natural_residual", "gap",    "feasibility", "error_m_per_s", "difference_m_per_s",
          "sweeps",           "wall_s", "status",      "reason"};
}

/// A row: the error is to the planted velocity, the difference to the first judge's.
void add_row(Table& table, const Problem& p, const std::string& law, const std::string& name,
             const ConeSolution& found, const VectorXd& judged) {
  const auto& m = found.measures;
  table.row({p.family, std::int64_t{p.number}, std::int64_t{p.planted.problem.contacts()}, law, name,
             m.natural_residual, m.gap, m.feasibility(), largest(found.velocity - p.planted.velocity),
             largest(found.velocity - judged), std::int64_t{found.iterations}, found.seconds,
             std::string(outcome_names[static_cast<std::size_t>(found.outcome)]), found.reason});
}

struct Found {
  Worst residual, error;
  int compared = 0, apart = 0;
};

/// Under Coulomb's law Ipopt is slow, as it solves a sequence of problems: it takes the first of each family,
/// or five.
bool taken(const ConeSolver& solver, FrictionLaw law, int number, bool full) {
  return law == FrictionLaw::cone || solver.name != "cone_ipopt" || number <= (full ? 5 : 1);
}

Found solve_all(Context& context, Table& table, const std::vector<Problem>& problems, const std::string& law,
                bool judge_only) {
  Found all;
  for (const Problem& p : problems) {
    VectorXd judged;
    for (const ConeSolver& solver : cone_solvers()) {
      if (!taken(solver, friction_law(law), p.number, context.full()) || (judge_only && judged.size() > 0))
        continue;
      const ConeSolution found = solver.solve(p.planted.problem, friction_law(law), tolerance);
      const bool first = judged.size() == 0;
      if (first) judged = found.velocity;
      add_row(table, p, law, solver.name, found, judged);
      if (first) {
        all.residual.add(found.measures.natural_residual);
        all.error.add(largest(found.velocity - p.planted.velocity));
      } else if (solver.name == "cone_ipopt") {
        ++all.compared;
        all.apart += !(largest(found.velocity - judged) <= agreement);
      }
    }
    context.advance(p.family + " " + law);
  }
  return all;
}

}  // namespace

void cone_problems(Context& context) {
  const auto cones = small_problems(FrictionLaw::cone), coulombs = small_problems(FrictionLaw::coulomb);
  const auto large = large_problems(FrictionLaw::cone, context.full());
  context.begin(std::ssize(cones) + std::ssize(coulombs) + std::ssize(large));
  Table small = context.table("solves", columns()), big = context.table("large", columns());
  const Found cone = solve_all(context, small, cones, "cone", false);
  const Found coulomb = solve_all(context, small, coulombs, "coulomb", false);
  const Found many = solve_all(context, big, large, "cone", true);
  small.close();
  big.close();
  constexpr double certain = 1e-10;
  const char* residual = "largest natural residual, |r - P_K(r - u)| / |q|";
  context.verdict("cone_problems.cone", "cone_interior_point solves every planted problem of the convex law",
                  residual, cone.residual.value(), certain);
  context.verdict("cone_problems.velocity", "cone_interior_point finds the planted velocity (convex law)",
                  "largest error, m/s", cone.error.value(), 1e-9);
  context.verdict("cone_problems.coulomb",
                  "cone_interior_point solves every planted problem of Coulomb's law", residual,
                  coulomb.residual.value(), certain);
  context.verdict("cone_problems.ipopt", "cone_ipopt finds the same velocities within 1e-6 m/s (convex law)",
                  "share of problems where it does not",
                  cone.compared > 0 ? static_cast<double>(cone.apart) / cone.compared : std::nan(""), 0.1);
  context.verdict("cone_problems.large", "cone_interior_point solves every large problem of the convex law",
                  residual, many.residual.value(), certain);
}

}  // namespace pbdcheck
