#include "contact_linear.h"

#include "cone_newton.h"

namespace pbd::reference {

Vector Cones::solve(const ConeProblem& problem, const Vector& last) {
  constexpr double tolerance = 1e-9, rounding = 1e-14;
  if (work_.poll) work_.poll();
  ConeSolution near;
  near.impulse = last;
  if (!last.isZero(0)) {
    near.iterations = cone_newton(problem, law_, rounding, near.impulse, &work_);
    certify(problem, law_, tolerance, near);
  }
  const bool at_rounding = near.iterations > 0 && near.measures.residual() <= near.measures.rounding;
  if (near.outcome == Outcome::ok || at_rounding || anew_ == 0 || work_.spent()) return near.impulse;
  ConeSolution far = solver_(problem, law_, tolerance, &work_);
  if (far.outcome != Outcome::ok) --anew_;
  return far.measures.residual() < near.measures.residual() || near.iterations == 0 ? far.impulse
                                                                                    : near.impulse;
}

bool Linearised::compute(const ContactStep& own, const Vector& velocity, const Vector& gamma) {
  step_ = &own;
  const RigidStep& step = own.step;
  RigidSystem system = system_at(step, velocity, gamma);
  system.tangent += own.stiffness(velocity);
  system.tangent = SparseMatrix(system.tangent + SparseMatrix(system.tangent.transpose())) / 2;
  Scales scales = scales_of(step, system);
  for (const BoundedRow& bounded : own.bounded) scales.row(bounded.row) = 0;  // no equation: pushed instead
  constexpr double independent = 1e-10;
  drop_dependent(step.model, system, independent, scales);
  if (!kkt_.compute(step, system, scales)) return false;
  kkt_.solve(-system.load, -system.value, free_, free_gamma_);
  const ContactPose pose = own.pose_at(velocity);
  for (const JudgedContact& contact : own.contacts) rows_.push_back(own.row_of(contact, pose));
  add_bounded(system, gamma);
  summed_ = free_.cwiseAbs();
  return free_.allFinite();
}

void Linearised::add_bounded(const RigidSystem& system, const Vector& gamma) {
  const auto count = std::ssize(step_->bounded);
  bounded_value_.resize(count);
  bounded_last_.resize(count);
  const SparseMatrix by_row = system.jacobian.transpose();
  for (Eigen::Index i = 0; i < count; ++i) {
    const int row = step_->bounded[static_cast<std::size_t>(i)].row;
    bounded_value_[i] = system.value[row];
    bounded_last_[i] = gamma[row];
    std::vector<std::pair<int, double>> direction;
    for (SparseMatrix::InnerIterator it(by_row, row); it; ++it)
      direction.emplace_back(static_cast<int>(it.row()), it.value());
    add_pushed(std::move(direction), system.compliance.coeff(row, row));
  }
}

Vec3 Linearised::seen_by(std::size_t contact, const Vector& increment) const {
  const double d = step_->step.d();
  Vec3 seen = rows_[contact].seen;
  for (const auto& [unknown, c] : rows_[contact].parts) seen += c * increment.segment<3>(unknown) / d;
  return seen;
}

/// What rounding may make of the normal velocity that a contact sees, m/s: what holds a heavy body against
/// another is much more than what is left of it.
double Linearised::rounding_of(std::size_t contact) const {
  double sum = std::abs(rows_[contact].seen[0]) * step_->step.h;
  for (const auto& [unknown, c] : rows_[contact].parts)
    sum += c.row(0).cwiseAbs() * summed_.segment<3>(unknown);
  return step_rounding * sum / step_->step.h;
}

void Linearised::add_pushed(std::vector<std::pair<int, double>> direction, double compliance) {
  const RigidModel& model = step_->step.model;
  Pushed& pushed = pushed_.emplace_back();
  pushed.direction = std::move(direction);
  pushed.compliance = compliance;
  Vector force = Vector::Zero(model.unknowns);
  for (const auto& [unknown, c] : pushed.direction) force[unknown] += c;
  kkt_.solve(force, Vector::Zero(model.rows()), pushed.increment, pushed.gamma);
}

void Linearised::take_part(std::size_t contact) {
  taking_part_.push_back(contact);
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::vector<std::pair<int, double>> direction;
    for (const auto& [unknown, c] : rows_[contact].parts)
      for (int axis = 0; axis < 3; ++axis) direction.emplace_back(unknown + axis, c(k, axis));
    add_pushed(std::move(direction), k == 0 ? step_->compliance_of(step_->contacts[contact]) : 0);
  }
}

/// W's rows and columns of what has come to be pushed.
void Linearised::grow(Eigen::MatrixXd& w) const {
  const Eigen::Index known = w.rows(), count = std::ssize(pushed_);
  const double scale = step_->step.d() * step_->step.s();
  w.conservativeResize(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index k = i < known ? known : 0; k < count; ++k) {
      const Vector& increment = pushed_[static_cast<std::size_t>(k)].increment;
      double sum = 0;
      for (const auto& [unknown, c] : pushed_[static_cast<std::size_t>(i)].direction)
        sum += c * increment[unknown];
      w(i, k) = sum / scale;
    }
  for (Eigen::Index i = known; i < count; ++i)
    w(i, i) += pushed_[static_cast<std::size_t>(i)].compliance / scale;
}

ConeProblem Linearised::problem(const Eigen::MatrixXd& w) const {
  const Eigen::Index bounded = bounded_value_.size(), size = w.rows(), of_contacts = size - bounded;
  const double d = step_->step.d(), s = step_->step.s();
  const auto place = [&](Eigen::Index i) { return i < bounded ? of_contacts + i : i - bounded; };
  ConeProblem problem;
  Triplets entries;
  for (Eigen::Index k = 0; k < size; ++k)
    for (Eigen::Index i = 0; i < size; ++i)
      if (w(i, k) != 0) entries.emplace_back(place(i), place(k), (w(i, k) + w(k, i)) / 2);
  problem.delassus = from_triplets(size, size, entries);
  problem.friction.resize(std::ssize(taking_part_));
  problem.free_velocity.resize(size);
  problem.lower.resize(bounded);
  problem.upper.resize(bounded);
  Eigen::Index i = 0;
  for (const std::size_t contact : taking_part_) {
    problem.friction[i] = step_->contacts[contact].law.friction;
    problem.free_velocity.segment<3>(3 * i++) = seen_by(contact, free_);
  }
  for (i = 0; i < bounded; ++i) {
    double seen = bounded_value_[i];
    for (const auto& [unknown, c] : pushed_[static_cast<std::size_t>(i)].direction)
      seen += c * free_[unknown];
    problem.free_velocity[of_contacts + i] = seen / d;
    const auto& [lower, upper] = step_->bounded[static_cast<std::size_t>(i)].bounds;
    problem.lower[i] = s * lower;
    problem.upper[i] = s * upper;
  }
  return problem;
}

Vector Linearised::last_impulses(const ContactStep& own) const {
  const Eigen::Index of_contacts = 3 * std::ssize(taking_part_);
  Vector impulse(of_contacts + bounded_last_.size());
  for (std::size_t i = 0; i < taking_part_.size(); ++i)
    impulse.segment<3>(static_cast<Eigen::Index>(3 * i)) = own.contacts[taking_part_[i]].force;
  impulse.tail(bounded_last_.size()) = bounded_last_;
  return own.step.s() * impulse;
}

void Linearised::take_impulses(const Vector& impulse, ContactStep& own, Vector& increment, Vector& gamma) {
  const Eigen::Index bounded = bounded_value_.size(), of_contacts = impulse.size() - bounded;
  const Vector force = impulse / own.step.s();
  for (std::size_t i = 0; i < taking_part_.size(); ++i)
    own.contacts[taking_part_[i]].force = force.segment<3>(static_cast<Eigen::Index>(3 * i));
  increment = free_;
  gamma = free_gamma_;
  summed_ = free_.cwiseAbs();
  for (Eigen::Index i = 0; i < impulse.size(); ++i) {
    const double own_force = force[i < bounded ? of_contacts + i : i - bounded];
    const Pushed& pushed = pushed_[static_cast<std::size_t>(i)];
    increment += own_force * pushed.increment;
    summed_ += std::abs(own_force) * pushed.increment.cwiseAbs();
    gamma += own_force * pushed.gamma;
  }
  for (Eigen::Index i = 0; i < bounded; ++i)
    gamma[own.bounded[static_cast<std::size_t>(i)].row] = force[of_contacts + i];
}

bool Linearised::solve(Cones& cones, ContactStep& own, Vector& increment, Vector& gamma) {
  constexpr int rounds = 50;
  std::vector<bool> part(rows_.size(), false);
  Eigen::MatrixXd w;  // per impulse
  increment = free_;
  gamma = free_gamma_;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!part[i] && (own.contacts[i].force[0] > 0 || seen_by(i, increment)[0] < -rounding_of(i))) {
        part[i] = true;
        take_part(i);
      }
    if (w.rows() == std::ssize(pushed_)) break;
    grow(w);
    const Vector impulse = cones.solve(problem(w), last_impulses(own));
    if (!impulse.allFinite()) return false;
    take_impulses(impulse, own, increment, gamma);
    bounded_last_ = impulse.tail(bounded_last_.size()) / own.step.s();
  }
  return increment.allFinite();
}

}  // namespace pbd::reference
