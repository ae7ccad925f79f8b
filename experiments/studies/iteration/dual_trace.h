// What the sweeps of a method make of one step's contacts, by a judge's or the planted solution p*, u*.
#pragma once

#include <string>
#include <vector>

#include "cone_problem.h"
#include "harness/rows_of_step.h"

namespace pbdcheck {

inline constexpr double dual_certain = 1e-12;  // natural residual that a judge is asked for

/// One linearised step of h seconds. p* and u* are NaN if no solution was found. Beside contacts rows of
/// other units may stand; the problem is then the equilibrated one, the rows' impulses `scale` times the
/// problem's.
struct DualCase {
  std::string scene;
  pbd::reference::FrictionLaw law;
  double h;
  LinearStep step;
  pbd::reference::ConeProblem problem;
  Eigen::VectorXd scale{};
  Eigen::VectorXd impulse{}, velocity{};  // p*, N s; u*, m/s; of the problem
};

/// The rows of a scene's first step, each contact with friction, all others without bounds; solved by
/// `cone_interior_point`, from whose problem those others are eliminated.
DualCase dual_case(std::string name, const pbd::Scene& scene, double h, pbd::reference::FrictionLaw law);

/// A planted problem, as if of a step of h seconds.
DualCase planted_case(int contacts, double h, pbd::reference::FrictionLaw law);

/// After a sweep. `sweep` counts what the method did before its first one, too.
struct DualSample {
  std::int64_t sweep;
  double residual;     // |natural map| / |q|
  double error;        // |u - u*| / |q|
  double gap;          // |F(p) - F*| / (F(0) - F*) of the convex law; else NaN
  double penetration;  // m, deepest overlap at the step's end
  bool rises;          // F(p) is larger than a sweep before, by more than the rounding of sums so far
};

/// The samples of one run, one a sweep.
class DualTrace {
 public:
  explicit DualTrace(const DualCase& of);
  void add(std::int64_t sweep, const Eigen::VectorXd& impulse);  // of the rows

  std::int64_t rises() const;

  /// True if there is nothing left to see: solved as well as p* is, or not finite.
  bool done() const;

  std::vector<DualSample> samples;

 private:
  double gap(const Eigen::VectorXd& impulse, const Eigen::VectorXd& velocity) const;

  const DualCase* of_;
  double scale_;                          // F(0) - F*, J
  pbd::reference::SparseMatrix weights_;  // |W|
  Eigen::VectorXd impulse_, velocity_;    // of the sweep before
};

}  // namespace pbdcheck
