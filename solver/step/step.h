// One time step: integrator, then (linearise, relax) until the nonlinear residual is small or the budget is
// spent.
//
// With x(v) = x0 + d v and impulse scale s from the integrator, the step's solution (v, p) satisfies
//   primal   M (v - v_free) = J(x(v))^T p
//   dual     c(x(v)) / d + Sigma p = 0, Sigma = A/(s d)
//
// that is, impulses act along the directions at x(v), the end of the step (midpoint: its middle), and every
// constraint is met up to its compliance A. Where an impulse has bounds or a law of friction (limits,
// contacts), these hold in place of the dual equation; of contacts Sigma is A/(h d).
//
// Both residuals are measured in the same unit, sqrt(J): |v - v_free - W J^T p|_M and sqrt(sum_i r_i^T
// N_ii^-1 r_i) with r the dual residual (m/s for lengths) and N_ii = J_i W J_i^T + Sigma_i; of bounds and
// laws, what is left by them of a step -N_ii^-1 r_i of p (`squared_residual` in rows/laws.h). They are
// compared with scale = |v - v_l|_M + |v_free - v_l|_M, v_l being the velocity at the step's start and the
// first iterate. What rounding makes of x in a constraint's value counts as solved (RowResidual in
// rows/source.h). Where impulses balance each other to half of the digits, so that next to nothing moves, the
// rounding of their velocities counts as solved, too.
#pragma once

#include <memory>
#include <vector>

#include "method.h"
#include "rows/costs.h"
#include "scene.h"
#include "step/report.h"

namespace pbd {

struct WorkspaceData;

/// A scene and a method, and everything a step needs besides them and the state: rows, impulses,
/// factorisations. Allocated once.
class Workspace {
 public:
  /// Validates the scene and the method and looks up the method's names; throws SetupError.
  Workspace(Scene scene, Method method);
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

  const Scene& scene() const;
  const Method& method() const;

  /// Replaces effect `index` between two steps: other forces, rates, rest values, compliances or moduli of
  /// the same constraints. Throws SetupError, and changes nothing, if the scene would not be valid, if the
  /// effect is of another kind, acts on other nodes or bodies, has limits or damping where it had none (or
  /// the other way round), or hard constraints where they gave way (or the other way round); contact cannot
  /// be changed.
  void change(std::size_t index, const Effect& effect);

  /// Makes the next step a start (integrators.h), since something that leads the scene jumps, as a motor's
  /// rate. Does nothing without hard constraints: no velocity jumps then.
  void begin_anew();

  /// The next step goes on from the end of the other's last one, whose scene is the same: by what its
  /// integrator carries from step to step. Impulses and contacts are not taken over, nor that what missed
  /// steps left overlapping parts slowly. Throws SetupError for another integrator.
  void go_on_from(const Workspace& other);

  /// What each effect with rows cost, in the scene's order.
  std::vector<EffectCost> costs() const;

  /// Impulses of effect `index` after the last step, N s (N m s for angles, J s for strains), R for each of
  /// its constraints; NaN for those that are no rows (compliant ones under explicit forces). Of contact none:
  /// `contacts` tells them.
  std::vector<double> impulses(std::size_t index) const;

  /// Force multipliers of effect `index` at the end of the last step, the impulses over the step's s: N (N m
  /// for angles, J for strains). In the first step of a motion that begins with speed v, half of the force
  /// that bends its path: that leaves its tangent by v^2 h^2/(2 r) there, and is bent by v^2 h^2/r in each
  /// later step. J^T times them are the forces, of damped point joints and attachments along the axes of the
  /// first body, of axis and line joints along Eigen's unitOrthogonal() of its axis and the axis times that.
  std::vector<double> forces(std::size_t index) const;

  /// All contacts of the last step, open ones included.
  std::vector<ContactForce> contacts() const;

 private:
  std::unique_ptr<WorkspaceData> data_;
  friend Report step(Workspace&, double, State&, const Observer&);
};

/// Advances `state` by h seconds. Throws SetupError for a step that is not finite and above 0 and for a state
/// of another scene's size or with quaternions whose norm is not 1, and what the observer throws; `state` is
/// as it was then. What else goes wrong stands in the report. A diverged step (numbers that are not finite, a
/// residual that grows by 1e8, a body that turns by more than 4e7 rad) leaves `state` as it was, too.
Report step(Workspace& workspace, double h, State& state, const Observer& observer = {});

}  // namespace pbd
