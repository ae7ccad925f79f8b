// Contact beside known answers: one table `answers` of what was measured and what is expected, and a verdict
// for each quantity, by the relaxation that is farthest off.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment.h"
#include "harness/integrator_rules.h"
#include "harness/measure.h"

namespace pbdcheck {

inline constexpr double contact_h = 0.01;  // s, the step where a study has but one

struct ContactRun : Simulation {
  std::int64_t sweeps = 0;
};

/// Called after each step that is not refused; the workspace knows its contacts.
using AfterContactStep = std::function<void(const pbd::State& after, const pbd::Workspace& workspace)>;

/// `steps` steps of h seconds from the scene's initial state, fewer if one diverges or says ok and is refuted
/// (`StepChecks`), which counts as diverged. Throws Interrupted.
ContactRun simulate_contacts(const pbd::Scene& scene, const pbd::Method& method, double h, std::int64_t steps,
                             const AfterContactStep& after_step = {});

/// The default method by another relaxation and law, its tolerance 1e-12.
pbd::Method contact_method(std::string_view relaxation, std::string_view friction = "coulomb");

/// The same with up to ten million sweeps a step. Contacts at the edge of sliding take about the inverse of
/// their distance from it, here a millionth, and two cubes the ratio of their masses.
pbd::Method patient_method(std::string_view relaxation, std::string_view friction = "coulomb");

/// |a - b| / |b|
double relative_difference(double a, double b);

/// v_k+1 = max(least, v_k - h deceleration), x_k+1 = x_k + h v_k+1: implicit Euler by a constant force.
struct Slide {
  double v, x = 0;
};
Slide slide(double v, double deceleration, double h, std::int64_t steps, double least = 0);

/// What is asked of an experiment: its error, in a unit, is at most the bound.
struct Quantity {
  std::string name, statement, unit;
  double bound;
  Basis basis = Basis::theory;
};

class KnownAnswers {
 public:
  KnownAnswers(Context& context, std::string experiment, std::vector<Quantity> quantities);

  /// `error` of what was measured; without a number where the run diverged. With `judged` false it is shown
  /// alone.
  void add(std::string_view quantity, std::string_view scene, const pbd::Method& method, double h,
           double measured, double expected, double error, const ContactRun& run, bool judged = true);

  /// Ends the table and gives the verdicts.
  void close();

 private:
  Context& context_;
  std::string experiment_;
  std::vector<Quantity> quantities_;
  std::map<std::string, Worst> worst_;  // errors of each quantity, over the linear solvers
  Table table_;
};

}  // namespace pbdcheck
