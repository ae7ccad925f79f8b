// auto: quasi_newton for compliant solids, sheets and links, in contact too; else plain where that contracts,
// as predicted by the last step's end and a bound of this one's, and as far as the iterates so far show; else
// aitken where contacts stiffen more than all else, and proximal where not. A step that surprises both
// predictions shows it in two slow iterations, after which it goes on as one of these. Where J is taken
// between the step's start and end (direction_blend below 1) nothing is predicted: plain, until it is slow.
// Where conjugate gradients spend all sweeps of an iteration on few contacts with friction, direct takes over
// for the rest of the step. On many, whose factorisations cost more than sweeps, nesterov_jacobi does after
// three such iterations in a row, and gauss_seidel where that spends its sweeps, too: near sliding they may
// hardly get on. The other two take over from quasi_newton for the rest of the step where it arrives, but the
// rounding of its elimination misses the tolerance; on sheets where it stalls, or without contacts is not
// there after 60 iterations, 30 where it is far, as where much is compressed; and where an iterate asks many
// contacts for impulses: its problem of n such contacts is dense, n^2 blocks of 72 bytes. Many are a
// thousand, or 50 on sheets where plain contracts.
#pragma once

#include <array>
#include <optional>

#include "outer/aitken.h"
#include "outer/proximal.h"
#include "outer/quasi_newton.h"

namespace pbd {

class Automatic {
 public:
  static constexpr bool solves_step = true;

  explicit Automatic(StepSystem& system);

  bool on_potential() const { return quasi_newton_ && !taken_over_; }

  void begin(StepSystem& system);
  RowResidual refresh(StepSystem& system);
  void iterate(StepSystem& system, Progress& progress);
  void forget();
  void forget_stiffness() {
    for (LinearSolver& solver : solvers_) pbd::forget(solver);
    if (quasi_newton_) quasi_newton_->forget_stiffness();
  }
  void end(StepSystem& system);
  std::optional<RowResidual> settle(StepSystem& system, const Progress& progress, bool stalled);
  void unsettle(StepSystem& system);
  bool takes_over() const { return takes_over_; }

 private:
  static constexpr double near = 1e-6;  // of the scale: quasi_newton has arrived

  struct Gain {                // of an iteration
    double lowest = infinity;  // residual when it last halved, sqrt(J),
    int iterations_since = 0;

    void note(double residual);
  };

  void take_over(StepSystem& system);
  bool is_spent(const StepSystem& system, const Progress& progress);
  bool crowded(StepSystem& system, const Progress& progress);
  bool plain_is_slow(const Progress& progress);
  bool plain_contracts(StepSystem& system, const Progress& progress);
  bool contacts_stiffen_most(StepSystem& system);
  void leave_aitken_without_gain(const Progress& progress);
  std::size_t successor(std::size_t contacts) const;
  void take_solver(StepSystem& system, std::size_t next);

  std::optional<QuasiNewton> quasi_newton_;  // where it suits
  bool taken_over_ = false;                  // the others go on from where it arrived
  bool takes_over_ = false;                  // with the next iteration
  bool leaves_ = false;                      // they do where its settling is refused
  Gain gain_, of_aitken_;                    // the first of quasi_newton
  // The method's own solver, and those that take over from it.
  enum : std::size_t { own, direct, nesterov_jacobi, gauss_seidel };
  std::array<LinearSolver, 4> solvers_{LinearSolver{}, Direct{}, NesterovJacobi{}, GaussSeidel{}};
  std::size_t solver_ = own;  // that the step's system has; its place here is empty
  int spent_ = 0;             // iterations in a row whose sweeps were not enough
  Aitken aitken_;
  Proximal proximal_;
  GeometricMass mass_;
  int slow_changes_ = 0;             // of v in this step, in a row
  std::optional<bool> uses_aitken_;  // in this step, in proximal's place
};

}  // namespace pbd
