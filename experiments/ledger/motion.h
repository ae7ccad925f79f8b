// What the ledger's rows do with the solver: steps that must be solved, equilibria, times of passage,
// frequencies.
#pragma once

#include <array>
#include <functional>
#include <string_view>

#include "step/step.h"

namespace pbdcheck::ledger {

/// `relaxation = direct`, tolerance 1e-12.
pbd::Method direct_method(std::string_view integrator = "implicit_euler");

/// A scene in motion. A step that is not ok throws std::runtime_error with its reason; Ctrl-C Interrupted.
class Motion {
 public:
  Motion(const pbd::Scene& scene, const pbd::Method& method);

  void advance(double h, std::int64_t steps = 1);

  pbd::Workspace workspace;
  pbd::State state;
};

/// Joins each of the scene's nodes to the next by a hard link of `length` (m), under gravity.
void add_links(pbd::Scene& scene, double length);

/// A number of a state, and its rate.
using Observable = std::function<double(const pbd::State&)>;

/// The state after `steps` steps of h seconds.
pbd::State state_after(const pbd::Scene& scene, const pbd::Method& method, double h, std::int64_t steps);

/// Equilibrium as the end of implicit Euler's motion: it multiplies a mode by 1/sqrt(1 + (w h)^2) a step.
/// Ends where a step moves nothing by more than the method's tolerance times the largest coordinate; throws
/// std::runtime_error after 1000 steps.
pbd::State equilibrium(Motion& motion, double h);
pbd::State equilibrium(const pbd::Scene& scene, const pbd::Method& method, double h);

/// Steps of `first` and ever more, each 1.1 times the last, up to h: a motion that starts far from rest.
void calm(Motion& motion, double first, double h);

/// Time of the n-th passage of `value` through zero, by the cubic of value and rate at the ends of its step.
/// Throws std::runtime_error if it does not come before `latest`.
double passage(const pbd::Scene& scene, const pbd::Method& method, double h, const Observable& value,
               const Observable& rate, double latest, int n = 1);

/// Richardson: f(h) and f(h/2) with an error of order p give f(h/2) + (f(h/2) - f(h))/(2^p - 1).
double extrapolated(const std::function<double(double h)>& f, double h, int order);

/// The value between `low` and `high` from which on `holds` is true, bisected to `resolution`. Throws
/// std::runtime_error if it is true at `low` or false at `high`.
double threshold(double low, double high, double resolution, const std::function<bool(double)>& holds);

/// Frequency (Hz) of the slowest mode, about a state of rest at which `value` is zero. Implicit Euler leaves
/// of a mode 1/(1 + i w h) a step: the slowest is what is left after `settling` steps, and q_n+1 = (2 q_n -
/// q_n-1)/(1 + (w h)^2).
double slowest_frequency(const pbd::Scene& scene, const pbd::Method& method, double h, int settling,
                         const Observable& value);

/// Rate (rad/s) at which a direction has turned about `axis`, by less than half a turn, in `time`.
double turning_rate(const pbd::Vec3& axis, const pbd::Vec3& before, const pbd::Vec3& after, double time);

}  // namespace pbdcheck::ledger
