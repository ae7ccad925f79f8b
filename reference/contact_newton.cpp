#include "contact_newton.h"

#include <cmath>

#include "cone_newton.h"
#include "error.h"
#include "newton_search.h"
#include "rigid_kkt.h"
#include "step_rows.h"

namespace pbd::reference {
namespace {

/// One iterate's linear problem: what the contacts that take part see, by their forces.
class Linearised {
 public:
  /// False where the system is singular.
  bool compute(const ContactStep& own, const Vector& velocity, const Vector& gamma);

  /// Forces that solve the law; false if the cone's solver finds none. `increment` and `gamma` are what
  /// follows from them.
  bool solve(FrictionLaw law, ConeSolver solver, ContactStep& own, Vector& increment, Vector& gamma);

 private:
  void take_part(std::size_t contact);
  Vec3 seen_by(std::size_t contact, const Vector& increment) const;
  Eigen::Matrix3d response(std::size_t at, std::size_t by) const;

  const ContactStep* step_ = nullptr;
  RigidKkt kkt_;
  std::vector<ContactRow> rows_;
  std::vector<std::vector<std::pair<int, Eigen::Matrix3d>>> by_increment_;  // G
  Vector free_, free_gamma_;                                               // without contacts
  std::vector<std::size_t> taking_part_;
  std::vector<std::array<Vector, 3>> answer_, answer_gamma_;  // of each that takes part
};

bool Linearised::compute(const ContactStep& own, const Vector& velocity, const Vector& gamma) {
  step_ = &own;
  const RigidStep& step = own.step;
  RigidSystem system = system_at(step, velocity, gamma);
  system.tangent += own.stiffness(velocity);
  Scales scales = scales_of(step, system);
  constexpr double independent = 1e-10;
  drop_dependent(step.model, system, independent, scales);
  if (!kkt_.compute(step, system, scales)) return false;
  kkt_.solve(-system.load, -system.value, free_, free_gamma_);
  const State end = step.end(velocity);
  const Placement at = placement_of(end);
  // What the velocities change by, (dx, d) being one: a matrix for each three unknowns.
  const auto by_velocity = [&](int unknown) {
    Eigen::Matrix3d change;
    for (int k = 0; k < 3; ++k) {
      Vector one = Vector::Zero(step.model.unknowns);
      one[unknown + k] = 1;
      change.col(k) = velocity_change(step, velocity, one).segment<3>(unknown);
    }
    return change;
  };
  std::map<int, Eigen::Matrix3d> turned;  // of rotations
  for (const Rotor& rotor : step.model.rotors)
    if (rotor.unknown >= 0) turned[rotor.unknown] = by_velocity(rotor.unknown);
  for (std::size_t i = 0; i < own.contacts.size(); ++i) {
    rows_.push_back(own.row_of(own.contacts[i], at, end));
    auto& g = by_increment_.emplace_back();
    for (const auto& [unknown, c] : rows_.back().parts) {
      const auto found = turned.find(unknown);
      Eigen::Matrix3d by = found == turned.end() ? Eigen::Matrix3d(c / step.h) : Eigen::Matrix3d(c * found->second);
      if (!rows_.back().by_velocity) by.row(0) = c.row(0) / step.h;
      g.emplace_back(unknown, by);
    }
  }
  return free_.allFinite();
}

Vec3 Linearised::seen_by(std::size_t contact, const Vector& increment) const {
  Vec3 seen = rows_[contact].seen;
  for (const auto& [unknown, g] : by_increment_[contact]) seen += g * increment.segment<3>(unknown);
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
  for (const auto& [unknown, g] : by_increment_[taking_part_[at]])
    for (std::size_t k = 0; k < 3; ++k)
      w.col(static_cast<Eigen::Index>(k)) += g * answer_[by][k].segment<3>(unknown);
  return w;
}

/// From the last impulses if that leads to a solution: where several have the same velocities it is one near
/// by, so that the skew part's share settles.
ConeSolution solved(const ConeProblem& problem, FrictionLaw law, ConeSolver solver, const Vector& last) {
  constexpr double tolerance = 1e-10, rounding = 1e-14;
  ConeSolution near;
  near.impulse = last;
  if (!last.isZero(0)) {
    near.iterations = cone_newton(problem, law, rounding, near.impulse);
    certify(problem, law, tolerance, near);
    if (near.outcome == Outcome::ok) return near;
  }
  return solver(problem, law, tolerance);
}

bool Linearised::solve(FrictionLaw law, ConeSolver solver, ContactStep& own, Vector& increment, Vector& gamma) {
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
              response(i, k) / h;
    w = grown;
    for (std::size_t i = known; i < count; ++i)
      w(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * i)) +=
          own.contacts[taking_part_[i]].compliance / (h * h);
    known = count;
    const Eigen::MatrixXd symmetric = (w + w.transpose()) / 2, skew = (w - w.transpose()) / 2;
    ConeProblem problem;
    Triplets entries;
    for (Eigen::Index k = 0; k < w.cols(); ++k)
      for (Eigen::Index i = 0; i < w.rows(); ++i)
        if (symmetric(i, k) != 0) entries.emplace_back(i, k, symmetric(i, k));
    problem.delassus = from_triplets(w.rows(), w.cols(), entries);
    problem.friction.resize(static_cast<Eigen::Index>(count));
    Vector q(w.rows()), impulse(w.rows());
    for (std::size_t i = 0; i < count; ++i) {
      const JudgedContact& contact = own.contacts[taking_part_[i]];
      problem.friction[static_cast<Eigen::Index>(i)] = contact.law.friction;
      q.segment<3>(static_cast<Eigen::Index>(3 * i)) = seen_by(taking_part_[i], free_);
      impulse.segment<3>(static_cast<Eigen::Index>(3 * i)) = h * contact.force;
    }
    for (int pass = 0; pass < 5; ++pass) {
      problem.free_velocity = q + skew * impulse;
      const ConeSolution solution = solved(problem, law, solver, impulse);
      if (getenv("JUDGE_TRACE")) fprintf(stderr, "  cone %d contacts residual %g iterations %d %s\n", problem.contacts(), solution.measures.residual(), solution.iterations, solution.reason.c_str());
      if (!solution.impulse.allFinite()) return false;
      const double change = (skew * (solution.impulse - impulse)).norm();
      impulse = solution.impulse;
      if (!(change > 1e-14 * q.norm())) break;
    }
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
  throw SetupError("friction", "`" + std::string(friction_names[static_cast<std::size_t>(friction)]) + "`",
                   "coulomb, cone: the laws that the judges of contact know");
}

struct StepSearch {
  ContactStep step;
  FrictionLaw law;
  ConeSolver solver;
  Vector velocity, gamma;
  int iterations = 0;
  double correction = infinity;  // of the displacement

  /// Newton until its corrections are at rounding.
  bool run() {
    constexpr int most = 60;
    constexpr double near = 1e-3, converged = 1e-9, rounding = 1e-14;
    double previous = infinity;
    for (; iterations < most; ++iterations) {
      step.find_contacts(velocity, correction > near);
      Linearised linear;
      Vector increment, next;
      if (!linear.compute(step, velocity, gamma) || !linear.solve(law, solver, step, increment, next))
        return false;
      velocity += velocity_change(step.step, velocity, increment);
      gamma = next;
      correction = increment.cwiseProduct(step.step.model.radius).cwiseAbs().maxCoeff() /
                   displacement_of(step.step, velocity);
      if (getenv("JUDGE_TRACE")) fprintf(stderr, "it %d correction %g contacts %zu law %g\n", iterations, correction, step.contacts.size(), step.law_residual(law, velocity));
      if (getenv("JUDGE_TRACE2")) { Eigen::Index w; increment.cwiseProduct(step.step.model.radius).cwiseAbs().maxCoeff(&w); fprintf(stderr, " worst unknown %d\n", (int)w); for (auto& c : step.contacts) { auto r=step.row_of(c, step.step.placement(velocity), step.step.end(velocity)); if (c.force[0]>0||r.seen[0]<1e-6) fprintf(stderr, "   %d.%d.%d %d.%d.%d force %g %g %g seen %g %g %g\n", c.pair.name[0],c.pair.name[1],c.pair.name[2],c.pair.name[3],c.pair.name[4],c.pair.name[5], c.force[0],c.force[1],c.force[2], r.seen[0],r.seen[1],r.seen[2]); } }
      if (!std::isfinite(correction)) return false;
      if (correction <= rounding || (correction < converged && correction > 0.25 * previous)) {
        if (!step.collide(velocity)) return true;
        correction = infinity;
      }
      previous = correction;
    }
    return false;
  }
};

}  // namespace

ContactJudgement contact_newton(const Scene& scene, const State& state, double h, Friction friction,
                                ConeSolver solver) {
  const FrictionLaw law = law_of(friction);
  Clock clock;
  StepSearch search{{scene, state, h}, law, solver, {}, {}};
  ContactStep& own = search.step;
  search.velocity = own.step.start_velocity();
  search.gamma.setZero(own.step.model.rows());
  const bool converged = search.run();
  ContactJudgement j;
  report(own.step, search.velocity, search.gamma, j);
  const RigidSystem system = system_at(own.step, search.velocity, search.gamma);
  Vector magnitude = system.magnitude;
  const Vector force = system.force(search.gamma) - own.push(search.velocity, magnitude);
  const Vector per_length = own.step.model.radius.cwiseInverse();
  j.residual = force.cwiseProduct(per_length).cwiseAbs().maxCoeff() /
               std::max(magnitude.cwiseProduct(per_length).maxCoeff(), 1e-300);
  own.find_contacts(search.velocity, false);
  j.law = own.law_residual(law, search.velocity) * h / displacement_of(own.step, search.velocity);
  j.correction = search.correction;
  j.iterations = search.iterations;
  j.rank = -1;
  for (const JudgedContact& each : own.contacts) j.contacts += each.force[0] > 0;
  j.all = own.contacts;
  constexpr double allowed = 1e-9;
  const bool holds = j.residual <= allowed && j.infeasible <= allowed && j.law <= allowed;
  j.outcome = converged && holds ? Outcome::ok : Outcome::not_converged;
  if (!converged)
    j.reason = "stopped after " + std::to_string(search.iterations) + " iterations";
  else if (!holds)
    j.reason = "forces, constraints or contacts off by " +
               std::to_string(std::max({j.residual, j.infeasible, j.law}));
  j.seconds = clock.seconds();
  return j;
}

}  // namespace pbd::reference
