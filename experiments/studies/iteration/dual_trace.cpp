#include "studies/iteration/dual_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cone_interior_point.h"
#include "cones/cone_relaxations.h"
#include "dense.h"
#include "planted_cones.h"

namespace pbdcheck {

using namespace pbd;
using namespace reference;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// NaN if there is none.
VectorXd judged_impulse(const ConeProblem& problem, FrictionLaw law) {
  const Eigen::Index contacts = 3 * problem.contacts(), others = problem.bounded();
  VectorXd impulse = VectorXd::Constant(problem.rows(), std::nan(""));
  ConeProblem left = problem;  // to the contacts
  MatrixXd answers;            // of the others to impulses of contacts, and
  VectorXd free;               // without them: both as what their own impulses take back
  if (others > 0) {
    SparseCholesky own;
    if (!own.compute(problem.delassus.block(contacts, contacts, others, others))) return impulse;
    const MatrixXd coupling = problem.delassus.block(contacts, 0, others, contacts);
    answers = own.solve(coupling);
    free = own.solve(VectorXd(problem.free_velocity.tail(others)));
    const MatrixXd among = problem.delassus.block(0, 0, contacts, contacts);
    left = {(among - transposed_product(coupling, answers)).sparseView(),
            problem.free_velocity.head(contacts) - coupling.transpose() * free, problem.friction};
  }
  const ConeSolution judged = cone_interior_point(left, law, dual_certain);
  if (judged.outcome != Outcome::ok) return impulse;
  impulse.head(contacts) = judged.impulse;
  if (others > 0) impulse.tail(others) = -(free + answers * judged.impulse);
  return impulse;
}

}  // namespace

DualCase dual_case(std::string name, const Scene& scene, double h, FrictionLaw law) {
  const auto law_name = friction_law_names[static_cast<std::size_t>(law)];
  LinearStep step = linear_step(scene, scene.initial, h, friction_by_name(law_name));
  DualCase made{std::move(name), law, h, std::move(step), {}};
  made.problem = cone_problem(made.step.rows, made.step.v_free);
  made.scale.setOnes(made.problem.rows());
  if (made.problem.bounded() > 0) {
    EquilibratedCone equilibrated = equilibrate(made.problem);
    made.problem = std::move(equilibrated.problem);
    made.scale = std::move(equilibrated.scale);
  }
  made.impulse = judged_impulse(made.problem, law);
  made.velocity = made.problem.velocity(made.impulse);
  return made;
}

DualCase planted_case(int contacts, double h, FrictionLaw law) {
  const PlantedCone planted = planted_regular(law, contacts, 1);
  LinearStep step{local_rows(planted.problem, law), planted.problem.free_velocity.reshaped(3, contacts)};
  return {"planted",
          law,
          h,
          std::move(step),
          planted.problem,
          VectorXd::Ones(planted.problem.rows()),
          planted.impulse,
          planted.velocity};
}

DualTrace::DualTrace(const DualCase& of)
    : of_(&of),
      scale_(1),
      weights_(of.problem.delassus.cwiseAbs()),
      impulse_(VectorXd::Zero(of.problem.free_velocity.size())),
      velocity_(of.problem.free_velocity) {
  scale_ = gap(impulse_, velocity_);
}

/// F(p) - F* = u*.(p - p*) + (p - p*).W (p - p*)/2: no difference of large numbers.
double DualTrace::gap(const VectorXd& impulse, const VectorXd& velocity) const {
  if (of_->law != FrictionLaw::cone) return std::nan("");
  const VectorXd away = impulse - of_->impulse;
  return std::abs(away.dot(of_->velocity) + away.dot(velocity - of_->velocity) / 2) / scale_;
}

void DualTrace::add(std::int64_t sweep, const VectorXd& of_rows) {
  const ConeProblem& problem = of_->problem;
  const VectorXd impulse = of_rows.cwiseQuotient(of_->scale);
  const double scale = problem.free_velocity.norm();
  const VectorXd velocity = problem.velocity(impulse), change = impulse - impulse_;
  const double rise = change.dot(velocity + velocity_) / 2;  // F(p) - F(p before), exactly
  // What rounding makes of u and of both impulses, in sums of this many terms.
  const double terms = static_cast<double>(impulse.size()) + static_cast<double>(sweep);
  const double rounding =
      change.norm() * ((weights_ * impulse.cwiseAbs()).norm() + scale) + impulse.norm() * velocity.norm();
  const VectorXd rates = velocity.cwiseQuotient(of_->scale);
  const double approach = -rates(Eigen::seqN(0, problem.contacts(), 3)).minCoeff<Eigen::PropagateNaN>();
  samples.push_back({sweep, natural_map(problem, of_->law, impulse).norm() / scale,
                     (velocity - of_->velocity).norm() / scale, gap(impulse, velocity),
                     of_->h * (approach < 0 ? 0 : approach),
                     !(rise <= std::numeric_limits<double>::epsilon() * terms * rounding)});
  impulse_ = impulse;
  velocity_ = velocity;
}

std::int64_t DualTrace::rises() const {
  return std::count_if(samples.begin(), samples.end(), [](const DualSample& each) { return each.rises; });
}

bool DualTrace::done() const {
  return !samples.empty() && !(samples.back().residual > dual_certain && samples.back().residual < infinity);
}

}  // namespace pbdcheck
