// How well are contact problems with friction solved whose answer was planted? By judges, the solver's
// relaxations, and Siconos.
#include "cones/cone_solvers.h"
#include "cones/velocity_share.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "dense.h"
#include "harness/measure.h"
#include "linear/linear_names.h"
#include "planted_cones.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd::reference;
using Eigen::VectorXd;

constexpr double tightest = 1e-8, loose = 1e-4;  // a relaxation is timed to both
constexpr double certain = 1e-10;                // what the interior point is asked for

double largest_entry(const VectorXd& v) {
  return v.allFinite() ? v.cwiseAbs().maxCoeff() : std::nan("");
}

/// Largest over smallest eigenvalue of W that is not zero, its contacts equilibrated.
double condition_of(const ConeProblem& problem) {
  const Eigen::MatrixXd w = equilibrate(problem).problem.delassus;
  const VectorXd all = symmetric_eigen(w).values;
  const double zero = std::numeric_limits<double>::epsilon() * static_cast<double>(w.rows()) * all.maxCoeff();
  const auto smallest = std::find_if(all.begin(), all.end(), [&](double value) { return value > zero; });
  return all.maxCoeff() / *smallest;
}

struct NamedCone {
  std::string family;
  int number;
  PlantedCone planted;
  double condition = std::nan("");
  bool demanded = false;  // that relaxations solve it

  bool large() const { return planted.problem.contacts() > 20; }
};

/// The 200 small ones. Relaxations are to solve those whose W is well-conditioned.
std::vector<NamedCone> small_problems(FrictionLaw law) {
  std::vector<NamedCone> all;
  for (const auto& family : planted_families())
    for (int i = 1; i <= planted_seeds; ++i) {
      const PlantedCone planted = family.draw(law, static_cast<std::uint64_t>(i));
      const double condition = condition_of(planted.problem);
      constexpr double good = 1e3;
      all.push_back({std::string(family.name), i, planted, condition, condition <= good});
    }
  return all;
}

std::vector<NamedCone> large_problems(FrictionLaw law, bool full) {
  std::vector<NamedCone> all;
  const int each = full ? 3 : 1;
  for (const int contacts : full ? std::vector{150, 450, 900, 3000} : std::vector{150, 450, 900})
    for (int i = 1; i <= each; ++i) {
      const auto drawn = static_cast<std::uint64_t>(i);
      all.push_back({"regular", i, planted_regular(law, contacts, drawn), std::nan(""), true});
      all.push_back({"hard", i, planted_hard(law, contacts, drawn)});
    }
  return all;
}

std::vector<std::string> cone_columns() {
  return {"family",    "number",           "contacts", "condition",   "law",           "relaxation",
          "tolerance", "natural_residual", "gap",      "feasibility", "error_m_per_s", "difference_m_per_s",
          "sweeps",    "wall_s",           "status",   "reason"};
}

/// Problems that a judge takes, and those that it leaves.
struct Judged {
  int taken = 0, unsolved = 0;

  void add(bool solved) {
    ++taken;
    unsolved += solved ? 0 : 1;
  }
  /// NaN if it took none.
  double left() const { return taken > 0 ? unsolved : std::nan(""); }
};

struct Found {
  Judged interior_point, ipopt_taken;
  Worst planted, ipopt, relaxed;           // velocities' shares: judge, second judge, relaxations
  std::map<std::string, double> unsolved;  // problems demanded and not solved, of each relaxation
};

/// Under Coulomb's law Ipopt is slow, as it solves a sequence of problems: it takes the first of each family,
/// or five. Of large problems the judge takes the convex ones.
bool taken(const ConeSolver& solver, FrictionLaw law, const NamedCone& p, bool full) {
  const bool convex = law == FrictionLaw::cone, ipopt = solver.name == "cone_ipopt";
  if (solver.kind == ConeSolverKind::rival) return !convex;
  if (solver.kind == ConeSolverKind::relaxation) return true;
  if (p.large()) return convex && !ipopt;
  return convex || !ipopt || p.number <= (full ? 5 : 1);
}

/// Solves a problem by all; the first judge's velocity is what the others are compared with.
class Solves {
 public:
  Solves(Context& context, std::string_view table)
      : context_(context), table_(context.table(table, cone_columns())) {}

  void solve(const NamedCone& p, FrictionLaw law) {
    const int sweeps = p.demanded ? most_sweeps : context_.full() && !p.large() ? 20000 : 2000;
    judged_ = {};
    for (const ConeSolver& solver : cone_solvers()) {
      if (!taken(solver, law, p, context_.full())) continue;
      if (solver.kind != ConeSolverKind::judge) add(p, law, solver, {p.planted.problem, law, loose, sweeps});
      const bool first = solver.name == "cone_interior_point";
      const ConeSolution last =
          add(p, law, solver, {p.planted.problem, law, first ? certain : tightest, sweeps});
      if (first) found.interior_point.add(last.measures.natural_residual <= certain);
      if (solver.name == "cone_ipopt") found.ipopt_taken.add(last.measures.natural_residual <= tightest);
      if (solver.kind == ConeSolverKind::relaxation && p.demanded)
        found.unsolved[solver.name] += !(last.measures.natural_residual <= tightest);
      if (law == FrictionLaw::cone && !p.large()) compare(p, solver, last);
    }
    context_.advance(fmt::format("{} {}", p.family, friction_law_names[static_cast<std::size_t>(law)]));
  }
  void close() { table_.close(); }

  Found found;

 private:
  void compare(const NamedCone& p, const ConeSolver& solver, const ConeSolution& now) {
    const ConeProblem& problem = p.planted.problem;
    if (solver.name == "cone_interior_point") {
      ConeSolution planted;
      planted.impulse = p.planted.impulse;
      planted.velocity = p.planted.velocity;
      found.planted.add(velocity_share(problem, planted, now, certain));
      return;
    }
    const double share = velocity_share(problem, judged_, now, certain + tightest);
    if (solver.kind == ConeSolverKind::judge) found.ipopt.add(share);
    if (solver.kind == ConeSolverKind::relaxation && p.demanded) found.relaxed.add(share, solver.name);
  }

  /// A row: the error is to the planted velocity.
  ConeSolution add(const NamedCone& p, FrictionLaw law, const ConeSolver& solver, const ConeTask& task) {
    ConeSolution now = solver.solve(task);
    if (solver.name == "cone_interior_point") judged_ = now;
    const auto& m = now.measures;
    table_.row({p.family, std::int64_t{p.number}, std::int64_t{p.planted.problem.contacts()}, p.condition,
                std::string(friction_law_names[static_cast<std::size_t>(law)]), solver.name, task.tolerance,
                m.natural_residual, m.gap, m.feasibility(), largest_entry(now.velocity - p.planted.velocity),
                judged_.velocity.size() > 0 ? largest_entry(now.velocity - judged_.velocity) : std::nan(""),
                std::int64_t{now.iterations}, now.seconds,
                std::string(outcome_names[static_cast<std::size_t>(now.outcome)]), now.reason});
    return now;
  }

  Context& context_;
  Table table_;
  ConeSolution judged_;
};

void unsolved(Context& context, const std::string& id, std::string_view kind, std::string_view of,
              const Found& found) {
  Worst worst;
  for (const auto& [relaxation, problems] : found.unsolved) worst.add(problems, relaxation);
  context.verdict(
      Basis::robustness, id,
      fmt::format("the relaxations solve every {} problem {} within {} sweeps", kind, of, most_sweeps),
      fmt::format("problems left (most by {})", worst.owner()), worst.value(), 0);
}

}  // namespace

void cone_problems(Context& context) {
  const auto left = fmt::format("problems left above {:g} of |q|", certain);
  Solves small(context, "solves"), large(context, "large");
  context.begin(2 * std::ssize(planted_families()) * planted_seeds + 4 * (context.full() ? 12 : 3));
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb}) {
    const bool convex = law == FrictionLaw::cone;
    small.found = large.found = {};
    for (const NamedCone& p : small_problems(law)) small.solve(p, law);
    for (const NamedCone& p : large_problems(law, context.full())) large.solve(p, law);
    const std::string name(friction_law_names[static_cast<std::size_t>(law)]);
    const char* of = convex ? "of the convex law" : "of Coulomb's law";
    context.verdict(Basis::robustness, "cone_problems." + name,
                    fmt::format("cone_interior_point solves every planted problem {}", of), left,
                    small.found.interior_point.left(), 0);
    unsolved(context, "cone_problems.unsolved." + name, "well-conditioned", of, small.found);
    unsolved(context, "cone_problems.large.unsolved." + name, "large regular", of, large.found);
    if (!convex) continue;
    context.verdict(Basis::robustness, "cone_problems.ipopt_solves",
                    "cone_ipopt solves every planted problem that it takes (convex law)",
                    fmt::format("problems left above {:g} of |q|", tightest), small.found.ipopt_taken.left(),
                    0);
    const char* share = "largest |du|^2 over what the residuals asked for allow";
    context.verdict(Basis::theory, "cone_problems.velocity",
                    "cone_interior_point finds the planted velocity (convex law)", share,
                    small.found.planted.value(), 1);
    context.verdict(Basis::theory, "cone_problems.ipopt", "cone_ipopt finds the same velocities (convex law)",
                    share, small.found.ipopt.value(), 1);
    context.verdict(Basis::theory, "cone_problems.relaxations",
                    "on well-conditioned problems the relaxations find the same velocities (convex law)",
                    fmt::format("{} ({})", share, small.found.relaxed.owner()), small.found.relaxed.value(),
                    1);
    context.verdict(Basis::robustness, "cone_problems.large",
                    "cone_interior_point solves every large problem of the convex law", left,
                    large.found.interior_point.left(), 0);
  }
  small.close();
  large.close();
}

}  // namespace pbdcheck
