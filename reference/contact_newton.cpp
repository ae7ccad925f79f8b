#include "contact_newton.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "cone_newton.h"
#include "contact_check.h"
#include "error.h"
#include "newton_search.h"
#include "rigid_kkt.h"
#include "step_equations.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

/// Solves cone problems, from the last impulses if that leads to a solution: where several have the same
/// velocities it is one near by. What is far from solved is left so; a few times anew from nothing.
class Cones {
 public:
  Cones(FrictionLaw law, ConeSolver solver, const std::function<void()>& poll)
      : law_(law), solver_(solver), poll_(poll) {}

  FrictionLaw law() const { return law_; }

  Vector solve(const ConeProblem& problem, const Vector& last) {
    constexpr double tolerance = 1e-9, rounding = 1e-14;
    if (poll_) poll_();
    ConeSolution near;
    near.impulse = last;
    if (!last.isZero(0)) {
      near.iterations = cone_newton(problem, law_, rounding, near.impulse);
      certify(problem, law_, tolerance, near);
    }
    if (near.outcome == Outcome::ok || anew_ == 0) return near.impulse;
    ConeSolution far = solver_(problem, law_, tolerance);
    if (far.outcome != Outcome::ok) --anew_;
    return far.measures.residual() < near.measures.residual() || near.iterations == 0 ? far.impulse
                                                                                      : near.impulse;
  }

 private:
  FrictionLaw law_;
  ConeSolver solver_;
  const std::function<void()>& poll_;
  int anew_ = 3;  // that may still fail: each costs thousands of factorisations
};

/// One iterate's linear problem: what the contacts that take part see, by their forces.
class Linearised {
 public:
  /// False where the system is singular.
  bool compute(const ContactStep& own, const Vector& velocity, const Vector& gamma);

  /// Sets the contacts' forces, and what follows from them; false if that is not finite.
  bool solve(Cones& cones, ContactStep& own, Vector& increment, Vector& gamma);

 private:
  void take_part(std::size_t contact);
  Vec3 seen_by(std::size_t contact, const Vector& increment) const;
  Eigen::Matrix3d response(std::size_t at, std::size_t by) const;

  const ContactStep* step_ = nullptr;
  RigidKkt kkt_;
  std::vector<ContactRow> rows_;
  Vector free_, free_gamma_;  // without contacts
  std::vector<std::size_t> taking_part_;
  std::vector<std::array<Vector, 3>> answer_, answer_gamma_;  // of each that takes part
};

bool Linearised::compute(const ContactStep& own, const Vector& velocity, const Vector& gamma) {
  step_ = &own;
  const RigidStep& step = own.step;
  RigidSystem system = system_at(step, velocity, gamma);
  system.tangent += own.stiffness(velocity);
  system.tangent = SparseMatrix(system.tangent + SparseMatrix(system.tangent.transpose())) / 2;
  Scales scales = scales_of(step, system);
  constexpr double independent = 1e-10;
  drop_dependent(step.model, system, independent, scales);
  if (!kkt_.compute(step, system, scales)) return false;
  kkt_.solve(-system.load, -system.value, free_, free_gamma_);
  const State end = step.end(velocity);
  const Placement at = placement_of(end);
  const auto least = own.least_gaps(at);
  for (const JudgedContact& contact : own.contacts) rows_.push_back(own.row_of(contact, at, end, least));
  return free_.allFinite();
}

Vec3 Linearised::seen_by(std::size_t contact, const Vector& increment) const {
  const double h = step_->step.h;
  Vec3 seen = rows_[contact].seen;
  for (const auto& [unknown, c] : rows_[contact].parts) seen += c * increment.segment<3>(unknown) / h;
  return seen;
}

void Linearised::take_part(std::size_t contact) {
  taking_part_.push_back(contact);
  const RigidModel& model = step_->step.model;
  auto& answer = answer_.emplace_back();
  auto& gamma = answer_gamma_.emplace_back();
  for (int k = 0; k < 3; ++k) {
    Vector force = Vector::Zero(model.unknowns);
    for (const auto& [unknown, c] : rows_[contact].parts) force.segment<3>(unknown) += c.row(k).transpose();
    kkt_.solve(force, Vector::Zero(model.rows()), answer[static_cast<std::size_t>(k)],
               gamma[static_cast<std::size_t>(k)]);
  }
}

Eigen::Matrix3d Linearised::response(std::size_t at, std::size_t by) const {
  Eigen::Matrix3d w = Eigen::Matrix3d::Zero();
  for (const auto& [unknown, c] : rows_[taking_part_[at]].parts)
    for (std::size_t k = 0; k < 3; ++k)
      w.col(static_cast<Eigen::Index>(k)) += c * answer_[by][k].segment<3>(unknown);
  return w / (step_->step.h * step_->step.h);
}

bool Linearised::solve(Cones& cones, ContactStep& own, Vector& increment, Vector& gamma) {
  const double h = step_->step.h;
  std::vector<bool> part(rows_.size(), false);
  std::size_t known = 0;
  Eigen::MatrixXd w;  // per impulse
  increment = free_;
  for (int round = 0; round < 50; ++round) {
    const std::size_t before = taking_part_.size();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!part[i] && (own.contacts[i].force[0] > 0 || seen_by(i, increment)[0] < 0)) {
        part[i] = true;
        take_part(i);
      }
    if (round > 0 && taking_part_.size() == before) break;
    const std::size_t count = taking_part_.size();
    if (count == 0) break;
    Eigen::MatrixXd grown(3 * count, 3 * count);
    grown.topLeftCorner(3 * known, 3 * known) = w;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < count; ++k)
        if (i >= known || k >= known)
          grown.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * k)) =
              response(i, k);
    w = grown;
    for (std::size_t i = known; i < count; ++i)
      w(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * i)) +=
          own.contacts[taking_part_[i]].compliance / (h * h);
    known = count;
    ConeProblem problem;
    Triplets entries;
    for (Eigen::Index k = 0; k < w.cols(); ++k)
      for (Eigen::Index i = 0; i < w.rows(); ++i)
        if (w(i, k) != 0) entries.emplace_back(i, k, (w(i, k) + w(k, i)) / 2);
    problem.delassus = from_triplets(w.rows(), w.cols(), entries);
    problem.friction.resize(static_cast<Eigen::Index>(count));
    problem.free_velocity.resize(w.rows());
    Vector last(w.rows());
    for (std::size_t i = 0; i < count; ++i) {
      const JudgedContact& contact = own.contacts[taking_part_[i]];
      problem.friction[static_cast<Eigen::Index>(i)] = contact.law.friction;
      problem.free_velocity.segment<3>(static_cast<Eigen::Index>(3 * i)) = seen_by(taking_part_[i], free_);
      last.segment<3>(static_cast<Eigen::Index>(3 * i)) = h * contact.force;
    }
    const Vector impulse = cones.solve(problem, last);
    if (!impulse.allFinite()) return false;
    increment = free_;
    gamma = free_gamma_;
    for (std::size_t i = 0; i < count; ++i) {
      Vec3& force = own.contacts[taking_part_[i]].force;
      force = impulse.segment<3>(static_cast<Eigen::Index>(3 * i)) / h;
      for (std::size_t k = 0; k < 3; ++k) {
        increment += force[static_cast<Eigen::Index>(k)] * answer_[i][k];
        gamma += force[static_cast<Eigen::Index>(k)] * answer_gamma_[i][k];
      }
    }
  }
  if (taking_part_.empty()) gamma = free_gamma_;
  return increment.allFinite();
}

FrictionLaw law_of(Friction friction) {
  if (friction == Friction::coulomb) return FrictionLaw::coulomb;
  if (friction == Friction::cone) return FrictionLaw::cone;
  throw SetupError("method.friction",
                   "`" + std::string(friction_names[static_cast<std::size_t>(friction)]) + "`",
                   "coulomb, cone: the laws that the judges of contact know");
}

struct StepSearch {
  ContactStep step;
  Cones cones;
  Vector velocity, gamma;
  bool features_kept = false;
  int iterations = 0;
  double correction = infinity;  // of the displacement

  /// Newton until its corrections are at rounding.
  bool run() {
    constexpr int most = 60;
    constexpr double near = 1e-3, converged = 1e-9, rounding = 1e-14;
    double previous = infinity;
    bool came_near = false;  // from then on features are those of the iterates alone
    for (; iterations < most; ++iterations) {
      came_near = came_near || correction < near;
      step.find_contacts(velocity, features_kept || !came_near);
      Linearised linear;
      Vector increment, next;
      if (!linear.compute(step, velocity, gamma) || !linear.solve(cones, step, increment, next)) return false;
      velocity += velocity_change(step.step, velocity, increment);
      gamma = next;
      correction = increment.cwiseProduct(step.step.model.radius).cwiseAbs().maxCoeff() /
                   displacement_of(step.step, velocity);
      if (!std::isfinite(correction)) return false;
      if (correction <= rounding || (correction < converged && correction > 0.25 * previous)) {
        const bool own_features = came_near || features_kept;
        if (!step.collide(velocity) && own_features) return true;
        came_near = true;
        correction = infinity;
      }
      previous = correction;
    }
    return false;
  }
};

/// What of bodies, nodes and triangles is deeper in others than where the step begins, by their support
/// functions: the features may all have been overlooked.
Findings depths_of(const Scene& scene, const ContactStep& own, const Vector& velocity) {
  const State end = own.step.end(velocity);
  const StepClaim claim{.scene = scene, .start = own.step.start, .end = end, .h = own.step.h};
  Findings findings;
  if (!own.contact.collider.empty() || !own.contact.triangle.empty())
    check_depths(claim, own.contact, 0, findings);
  return findings;
}

}  // namespace

void require_judged(const Scene& scene, const State& state, double h, Friction friction) {
  law_of(friction);
  ContactStep(scene, state, h);
}

ContactJudgement contact_newton(const Scene& scene, const State& state, double h, Friction friction,
                                ConeSolver solver, const ContactStart& start) {
  const FrictionLaw law = law_of(friction);
  Clock clock;
  StepSearch search{{scene, state, h}, {law, solver, start.poll}, {}, {}};
  ContactStep& own = search.step;
  search.velocity = own.step.start_velocity();
  search.gamma.setZero(own.step.model.rows());
  search.features_kept = start.features_kept;
  if (const StepClaim* near = start.near; near != nullptr) {
    RigidStep ended = own.step;
    ended.start = near->end;
    search.velocity = ended.start_velocity();
    if (Vector told; gather_forces(*near, own.step.model, told) && told.allFinite()) search.gamma = told;
    own.find_contacts(search.velocity, true);
    own.take_forces(near->contacts, search.velocity);
  }
  const bool converged = search.run();
  ContactJudgement j;
  report(own.step, search.velocity, search.gamma, j);
  const RigidSystem system = system_at(own.step, search.velocity, search.gamma);
  Vector magnitude = system.magnitude;
  const Vector force = system.force(search.gamma) - own.push(search.velocity, magnitude);
  const Vector per_length = own.step.model.radius.cwiseInverse();
  j.residual = force.cwiseProduct(per_length).cwiseAbs().maxCoeff() /
               std::max(magnitude.cwiseProduct(per_length).maxCoeff(), 1e-300);
  constexpr double allowed = 1e-9;
  j.contacts = static_cast<int>(std::count_if(own.contacts.begin(), own.contacts.end(),
                                              [](const JudgedContact& each) { return each.force[0] > 0; }));
  j.all = own.contacts;
  j.law = own.law_residual(law, search.velocity);
  own.find_contacts(search.velocity, start.features_kept);  // others may be in each other by now
  // Gaps are known to the rounding of positions.
  const double known = step_rounding * j.x.cwiseAbs().maxCoeff();
  j.law = larger(j.law, own.law_residual(law, search.velocity)) * h /
          std::max(displacement_of(own.step, search.velocity), known / allowed);
  j.correction = search.correction;
  j.iterations = search.iterations;
  j.rank = -1;
  std::ostringstream reason;
  const auto say = [&reason]() -> std::ostringstream& {
    if (!reason.str().empty()) reason << ", ";
    return reason;
  };
  if (!converged)
    say() << "stopped after " << search.iterations << " iterations, the last correction " << j.correction;
  for (const auto& [name, off] :
       {std::pair{"forces", j.residual}, {"constraints", j.infeasible}, {"contacts", j.law}})
    if (converged && !(off <= allowed)) say() << name << " off by " << off << ", allowed " << allowed;
  if (const Findings deep = depths_of(scene, own, search.velocity); converged && !deep.refuted.empty())
    say() << deep.refuted.front().what << " in each other by " << deep.refuted.front().number;
  j.reason = reason.str();
  j.outcome = j.reason.empty() ? Outcome::ok : Outcome::not_converged;
  j.seconds = clock.seconds();
  return j;
}

}  // namespace pbd::reference
