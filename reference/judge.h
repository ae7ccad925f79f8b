// What a reference says about one step, and the list of references.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "friction.h"
#include "scene.h"

namespace pbd::reference {

enum class Outcome { ok, not_converged, infeasible };
/// As result tables write them, where `status` knows no `infeasible`: the reason tells it apart.
inline constexpr std::array<std::string_view, 3> outcome_names{"ok", "not_converged", "not_converged"};

/// The implicit Euler step of length h from (x_l, v_l): M (v - v_l)/h = f - dU/dx(x) + J(x)^T gamma, x = x_l
/// + h v, hard c(x) = 0.
struct Judgement {
  Points x, v;                                  // end of the step, m and m/s, 3 x N
  std::vector<Eigen::Quaterniond> orientation;  // of the rigid bodies, and
  Points spin = Points(3, 0);                   // their angular velocities, 3 x B, rad/s
  Eigen::VectorXd
      multiplier;  // gamma of the hard rows in the scene's order, N for lengths; impulse p = h gamma
  Outcome outcome = Outcome::not_converged;
  std::string reason;  // empty if ok
  std::string note;    // what had to be done: indefinite Hessians, redundant constraints
  double residual =
      0;  // largest unbalanced force, relative to the largest sum of absolute force contributions
  double infeasible =
      0;  // largest |c| of a hard row, divided by the length of its gradient and by the displacement
  double correction =
      0;  // last Newton correction of x, relative to the step's largest displacement (or 1e-6 |x| if larger)
  bool certified = false;  // a strict local minimum: Hessian positive definite on the hard constraints' null
                           // space; with rigid bodies an isolated solution (rigid_newton.h)
  int rank = 0;            // of the hard constraints' Jacobian; -1 where the judge does not find it
  int iterations = 0;
  double seconds = 0;
  /// What the velocities and forces of a claim that a judge of contact started from leave of its equations,
  /// by the features that are there: the largest unbalanced force on a node or a body, of those that act on
  /// it, and how far a constraint or a contact's law is missed, of the displacement or the free motion's.
  /// Infinite where shapes are in each other; NaN without a claim or of what is not finite.
  double claim_residual = std::numeric_limits<double>::quiet_NaN();
};

/// Shown every iterate: seconds spent so far (observers excluded) and positions.
using IterateObserver = std::function<void(double seconds, const Points& x)>;

using Judge = Judgement (*)(const Scene& scene, const State& state, double h);
struct NamedJudge {
  std::string_view name;
  Judge judge;
};

/// Of scenes without contact: primal_newton and ipopt.
std::span<const NamedJudge> judges();

/// What a solution may leave of the equations of a judge of contact, of their scales.
inline constexpr double allowed_residual = 1e-9;

/// What a judge of contact spends on a step before it gives up: factorisations of 100 rows, of 0.2 ms each.
inline constexpr double default_contact_work = 2e4;

/// Where a judge of contact starts, since there may be several solutions: from the velocities where the step
/// begins, or from the end and the forces that somebody claims for it. What touches is decided by the poses
/// where the step ends; with `features_kept` it is the features that are near where it begins, too, which go
/// on as planes and lines that have no end.
/// `map` is that of another integrator than implicit Euler (rigid_step.h).
struct StepClaim;
struct IntegratorMap;
struct ContactStart {
  const StepClaim* near = nullptr;
  bool features_kept = false;
  std::function<void()> poll{};  // called now and then; what it throws ends the judge's work
  /// What the contacts' problems may cost before the judge gives up, in factorisations of 100 rows; larger
  /// ones count for more (ConeWork in cone_problem.h).
  double work = default_contact_work;
  const IntegratorMap* map = nullptr;
};

/// Of scenes with contact and damping, too, named by what solves the contacts' law: cone_interior_point and
/// cone_ipopt. Throw SetupError for what they do not know (contact_newton.h), the laws box and disc among it.
using ContactJudge = Judgement (*)(const Scene& scene, const State& state, double h, Friction friction,
                                   const ContactStart& start);
struct NamedContactJudge {
  std::string_view name;
  ContactJudge judge;
};
std::span<const NamedContactJudge> contact_judges();

/// Throws SetupError naming the allowed ones.
Judge find_judge(std::string_view name);

/// Names and versions of the libraries the judges are built on.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace pbd::reference
