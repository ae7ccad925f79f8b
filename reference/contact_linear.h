// The linear problem of one iterate of contact_newton.h, and the cone problem that is left of it.
#pragma once

#include "contact_step.h"
#include "rigid_kkt.h"

namespace pbd::reference {

using ConeSolver = ConeSolution (*)(const ConeProblem& problem, FrictionLaw law, double tolerance,
                                    ConeWork* work);

/// Solves cone problems, from the last impulses if that leads to a solution: where several have the same
/// velocities it is one near by. What is far from solved is left so; a few times anew from nothing. When the
/// work is spent the last impulses are what is found.
class Cones {
 public:
  Cones(FrictionLaw law, ConeSolver solver, ConeWork work)
      : law_(law), solver_(solver), work_(std::move(work)) {}

  bool spent() const { return work_.spent(); }
  FrictionLaw law() const { return law_; }

  Vector solve(const ConeProblem& problem, const Vector& last);

 private:
  FrictionLaw law_;
  ConeSolver solver_;
  ConeWork work_;
  int anew_ = 3;  // that may still fail: each costs thousands of factorisations
};

/// One iterate's linear problem: what the contacts that take part, and all bounded rows, see by their forces.
class Linearised {
 public:
  /// False where the system is singular.
  bool compute(const ContactStep& own, const Vector& velocity, const Vector& gamma);

  /// Sets the contacts' forces, and what follows from them, bounded rows' own multipliers among it; false if
  /// that is not finite.
  bool solve(Cones& cones, ContactStep& own, Vector& increment, Vector& gamma);

 private:
  /// A direction of forces, what a force of 1 N (or the row's unit) along it moves, and the row's compliance.
  struct Pushed {
    std::vector<std::pair<int, double>> direction;  // by the unknowns (dx, d)
    Vector increment, gamma;
    double compliance = 0;
  };

  void add_pushed(std::vector<std::pair<int, double>> direction, double compliance);
  void add_bounded(const RigidSystem& system, const Vector& gamma);
  void take_part(std::size_t contact);
  void grow(Eigen::MatrixXd& w) const;
  ConeProblem problem(const Eigen::MatrixXd& w) const;
  Vec3 seen_by(std::size_t contact, const Vector& increment) const;
  double rounding_of(std::size_t contact) const;
  Vector last_impulses(const ContactStep& own) const;
  void take_impulses(const Vector& impulse, ContactStep& own, Vector& increment, Vector& gamma);

  const ContactStep* step_ = nullptr;
  RigidKkt kkt_;
  std::vector<ContactRow> rows_;
  Vector summed_;                        // the absolute contributions to the last increment
  Vector free_, free_gamma_;             // without contacts
  Vector bounded_value_, bounded_last_;  // c, and last multipliers, of bounded rows
  std::vector<std::size_t> taking_part_;
  std::vector<Pushed> pushed_;  // the bounded rows, then three of each contact that takes part
};

}  // namespace pbd::reference
