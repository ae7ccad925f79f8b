#include "contact_linear.h"

#include "cone_newton.h"

namespace pbd::reference {

Vector Cones::solve(const ConeProblem& problem, const Vector& last) {
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
  const ContactPose pose = own.pose_at(velocity);
  for (const JudgedContact& contact : own.contacts) rows_.push_back(own.row_of(contact, pose));
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

/// Rows and columns of the contacts that have come to take part.
void Linearised::grow(Eigen::MatrixXd& w) const {
  const Eigen::Index known = w.rows() / 3, count = std::ssize(taking_part_);
  w.conservativeResize(3 * count, 3 * count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < count; ++k)
      if (i >= known || k >= known)
        w.block<3, 3>(3 * i, 3 * k) = response(static_cast<std::size_t>(i), static_cast<std::size_t>(k));
  const double h = step_->step.h;
  for (Eigen::Index i = known; i < count; ++i)
    w(3 * i, 3 * i) += step_->contacts[taking_part_[static_cast<std::size_t>(i)]].compliance / (h * h);
}

ConeProblem Linearised::problem(const Eigen::MatrixXd& w) const {
  ConeProblem problem;
  Triplets entries;
  for (Eigen::Index k = 0; k < w.cols(); ++k)
    for (Eigen::Index i = 0; i < w.rows(); ++i)
      if (w(i, k) != 0) entries.emplace_back(i, k, (w(i, k) + w(k, i)) / 2);
  problem.delassus = from_triplets(w.rows(), w.cols(), entries);
  problem.friction.resize(std::ssize(taking_part_));
  problem.free_velocity.resize(w.rows());
  Eigen::Index i = 0;
  for (const std::size_t contact : taking_part_) {
    problem.friction[i] = step_->contacts[contact].law.friction;
    problem.free_velocity.segment<3>(3 * i++) = seen_by(contact, free_);
  }
  return problem;
}

bool Linearised::solve(Cones& cones, ContactStep& own, Vector& increment, Vector& gamma) {
  constexpr int rounds = 50;
  const double h = own.step.h;
  std::vector<bool> part(rows_.size(), false);
  Eigen::MatrixXd w;  // per impulse
  increment = free_;
  gamma = free_gamma_;
  for (int round = 0; round < rounds; ++round) {
    const std::size_t before = taking_part_.size();
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!part[i] && (own.contacts[i].force[0] > 0 || seen_by(i, increment)[0] < 0)) {
        part[i] = true;
        take_part(i);
      }
    if (taking_part_.size() == before) break;
    grow(w);
    Vector impulse(w.rows());
    for (std::size_t i = 0; i < taking_part_.size(); ++i)
      impulse.segment<3>(static_cast<Eigen::Index>(3 * i)) = h * own.contacts[taking_part_[i]].force;
    impulse = cones.solve(problem(w), impulse);
    if (!impulse.allFinite()) return false;
    increment = free_;
    gamma = free_gamma_;
    for (std::size_t i = 0; i < taking_part_.size(); ++i) {
      Vec3& force = own.contacts[taking_part_[i]].force;
      force = impulse.segment<3>(static_cast<Eigen::Index>(3 * i)) / h;
      for (std::size_t k = 0; k < 3; ++k) {
        increment += force[static_cast<Eigen::Index>(k)] * answer_[i][k];
        gamma += force[static_cast<Eigen::Index>(k)] * answer_gamma_[i][k];
      }
    }
  }
  return increment.allFinite();
}

}  // namespace pbd::reference
