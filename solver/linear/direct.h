// The composition that solves any rows. Without contacts it is `ldlt`. With contacts a sweep is an iteration
// of `semismooth_newton`; where none of its steps reduces the residual, that of `augmented_lagrangian` may,
// or else sweeps of `gauss_seidel`, of both the more the longer nothing has been gained. Where the augmented
// Lagrangian does not apply and sweeps gained nothing, the path of smoothed laws, once, or a round of the
// proximal point method comes before them. After `most_patience` iterations without a gain it gives the rows
// up; the step's next ones, a little changed, get one less each time, until some are solved.
#pragma once

#include "linear/augmented_lagrangian.h"
#include "linear/ldlt.h"
#include "linear/semismooth_newton.h"

namespace pbd {

class Direct {
 public:
  static constexpr std::string_view name = "direct";
  static constexpr bool solves_any_rows = true;
  void begin(Rows& rows, const Points& v, bool fresh);
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);

  /// Since `begin`, besides one an iteration: factorisations of the augmented Lagrangian and of
  /// rounds, sweeps of Gauss-Seidel.
  std::int64_t further_sweeps() const { return further_sweeps_; }

  /// The name of the part that worked last.
  std::string_view part() const { return part_; }

 private:
  // Iterations without a gain.
  static constexpr int most_patience = 10;
  static constexpr int by_sweeps = 2;  // before rounds: earlier ones leave one of `cone_problems` unsolved

  bool gave_up() const { return idle_ > patience_; }
  void restore(Rows& rows, Points& v) const;
  bool augment(Rows& rows, Points& v, double residual);
  bool follow_path(Rows& rows, Points& v, double residual);
  bool advance(Rows& rows, Points& v);

  Ldlt ldlt_;
  SemismoothNewton newton_;
  AugmentedLagrangian augmented_;
  std::string_view part_ = Ldlt::name;
  std::vector<double> kept_;  // impulses and biases, and
  Points start_;              // velocities where none of Newton's steps reduces the residual
  double lowest_ = infinity;  // residual since `begin`
  int idle_ = 0;              // iterations since the residual was clearly lower than ever
  bool followed_ = false;     // the path of smoothed laws, since `begin`
  int patience_ = most_patience;
  std::int64_t further_sweeps_ = 0;
};

}  // namespace pbd
