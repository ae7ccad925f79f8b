// Do the impulses of one step's contacts obey the law of friction? Bodies that stick, slide and leave each
// other: the rows linearised where a step begins, solved by each relaxation, judged as a contact problem.
//
// With e the natural map and i a contact, r - e is in K, u~ - e in K*, and they are perpendicular (Moreau),
// so
//   |r_N (u~_N - mu |u_T|)|, |mu r_N |u_T| + r_T.u_T|  <=  (1 + sqrt(1 + mu^2)) |e| (|r| + |u~| + |e|)
// the errors of complementarity and of maximum dissipation, in J; their signed sum is r.u~. Of the convex
// law, u is unique, see velocity_share.h.
#include <fmt/format.h>

#include <cmath>

#include "cone_interior_point.h"
#include "cones/cone_solvers.h"
#include "cones/velocity_share.h"
#include "harness/measure.h"
#include "harness/rows_of_step.h"
#include "linear/linear_names.h"
#include "scenes/contacts.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using namespace reference;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double cone_tolerance = 1e-8, cone_h = 0.01;

struct Errors {
  double complementarity, dissipation, allowed;  // J
};

Errors errors_of(FrictionLaw law, double mu, const Vector3d& r, const Vector3d& u, double map) {
  const double slip = u.tail<2>().norm();
  const Vector3d shifted = u + (law == FrictionLaw::cone ? 0.0 : mu * slip) * Vector3d::UnitX();
  return {std::abs(r[0] * (shifted[0] - mu * slip)),
          std::abs(mu * r[0] * slip + r.tail<2>().dot(u.tail<2>())),
          (1 + std::sqrt(1 + mu * mu)) * map * (r.norm() + shifted.norm() + map)};
}

struct JudgedCone {
  const ConeProblem& problem;
  FrictionLaw law;
  std::string law_name;
  ConeSolution truth;  // of the first judge
};

double share_of(const JudgedCone& by, const ConeSolution& found) {
  return velocity_share(by.problem, by.truth, found, 2 * cone_tolerance);
}

class Tables {
 public:
  explicit Tables(Context& context)
      : contacts_(context.table(
            "contacts", {"law", "relaxation", "contact", "coefficient", "normal_n_s", "tangent1_n_s",
                         "tangent2_n_s", "slip_m_per_s", "complementarity_j", "dissipation_j", "allowed_j"})),
        solves_(context.table(
            "solves", {"law", "relaxation", "contacts", "natural_residual", "complementarity_share",
                       "dissipation_share", "velocity_share", "sweeps", "wall_s", "status", "reason"})) {}

  /// Adds a solution; returns the largest share of the allowed errors that its contacts have.
  double add(const JudgedCone& by, const std::string& name, const ConeSolution& found) {
    const double map = cone_tolerance * by.problem.free_velocity.norm();
    Worst complementarity, dissipation;
    for (int i = 0; i < by.problem.contacts(); ++i) {
      const Vector3d r = found.impulse.segment<3>(3 * i), u = found.velocity.segment<3>(3 * i);
      const double mu = by.problem.friction(i);
      const Errors errors = errors_of(by.law, mu, r, u, map);
      complementarity.add(errors.complementarity / errors.allowed);
      dissipation.add(errors.dissipation / errors.allowed);
      contacts_.row({by.law_name, name, std::int64_t{i + 1}, mu, r[0], r[1], r[2], u.tail<2>().norm(),
                     errors.complementarity, errors.dissipation, errors.allowed});
    }
    solves_.row({by.law_name, name, std::int64_t{by.problem.contacts()}, found.measures.natural_residual,
                 complementarity.value(), dissipation.value(), share_of(by, found),
                 std::int64_t{found.iterations}, found.seconds,
                 std::string(outcome_names[static_cast<std::size_t>(found.outcome)]), found.reason});
    Worst worst;
    worst.add(complementarity.value());
    worst.add(dissipation.value());
    return worst.value();
  }
  void close() {
    contacts_.close();
    solves_.close();
  }

 private:
  Table contacts_, solves_;
};

}  // namespace

void friction_cone(Context& context) {
  const Scene scene = pile();
  context.begin(2 * std::count_if(cone_solvers().begin(), cone_solvers().end(),
                                  [](const ConeSolver& each) { return each.kind != ConeSolverKind::rival; }));
  Tables tables(context);
  for (const FrictionLaw law : {FrictionLaw::cone, FrictionLaw::coulomb}) {
    const std::string name(friction_law_names[static_cast<std::size_t>(law)]);
    const LinearStep step = linear_step(scene, scene.initial, cone_h, friction_by_name(name));
    const ConeProblem problem = cone_problem(step.rows, step.v_free);
    const JudgedCone by{problem, law, name, cone_interior_point(problem, law, cone_tolerance)};
    Worst errors, velocities;
    for (const ConeSolver& solver : cone_solvers()) {
      if (solver.kind == ConeSolverKind::rival) continue;
      const ConeTask task{problem, law, cone_tolerance, most_sweeps};
      const ConeSolution found = solver.kind == ConeSolverKind::judge
                                     ? solver.solve(task)
                                     : relax_cone(solver.name, step.rows, step.v_free, task);
      const double share = tables.add(by, solver.name, found);
      context.advance(name + " " + solver.name);
      if (solver.name == "cone_ipopt" && found.outcome != Outcome::ok)
        continue;  // a second judge, and it says so
      errors.add(share, solver.name);
      if (law == FrictionLaw::cone && solver.name != "cone_interior_point")
        velocities.add(share_of(by, found), solver.name);
    }
    const std::string id = "friction_cone." + name;
    context.verdict(Basis::code, id, "the contacts' impulses obey the law " + name,
                    "largest error of complementarity and dissipation, over what the tolerance allows (" +
                        errors.owner() + ")",
                    errors.value(), 1);
    if (law == FrictionLaw::cone)
      context.verdict(Basis::theory, id + ".velocity", "all find the judge's velocities (convex law)",
                      "|du|^2 over what the tolerance allows (" + velocities.owner() + ")",
                      velocities.value(), 1);
  }
  tables.close();
}

}  // namespace pbdcheck
