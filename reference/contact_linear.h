// The linear problem of one iterate of contact_newton.h, and the cone problem that is left of it.
#pragma once

#include <functional>

#include "contact_step.h"
#include "rigid_kkt.h"

namespace pbd::reference {

using ConeSolver = ConeSolution (*)(const ConeProblem& problem, FrictionLaw law, double tolerance);

/// Solves cone problems, from the last impulses if that leads to a solution: where several have the same
/// velocities it is one near by. What is far from solved is left so; a few times anew from nothing.
class Cones {
 public:
  Cones(FrictionLaw law, ConeSolver solver, const std::function<void()>& poll)
      : law_(law), solver_(solver), poll_(poll) {}

  Vector solve(const ConeProblem& problem, const Vector& last);

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
  void grow(Eigen::MatrixXd& w) const;
  ConeProblem problem(const Eigen::MatrixXd& w) const;
  Vec3 seen_by(std::size_t contact, const Vector& increment) const;
  Eigen::Matrix3d response(std::size_t at, std::size_t by) const;

  const ContactStep* step_ = nullptr;
  RigidKkt kkt_;
  std::vector<ContactRow> rows_;
  Vector free_, free_gamma_;  // without contacts
  std::vector<std::size_t> taking_part_;
  std::vector<std::array<Vector, 3>> answer_, answer_gamma_;  // of each that takes part
};

}  // namespace pbd::reference
