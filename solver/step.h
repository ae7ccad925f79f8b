// One time step: integrator, then (linearise, relax) until the nonlinear residual is small or the budget is
// spent.
//
// With x(v) = x0 + d v and impulse scale s from the integrator, the step's solution (v, p) satisfies
//   primal   M (v - v_free) = J(x(v))^T p
//   dual     c(x(v)) / d + Sigma p = 0, Sigma = A/(s d)
//
// that is, impulses act along the directions at x(v), the end of the step (midpoint: its middle), and every
// constraint is met up to its compliance A.
//
// Both residuals are measured in the same unit, sqrt(J): |v - v_free - W J^T p|_M and sqrt(sum_i r_i^T
// N_ii^-1 r_i) with r the dual residual (m/s for lengths) and N_ii = J_i W J_i^T + Sigma_i; they are compared
// with scale = |v - v_old|_M + |v_free - v_old|_M. The first iterate is v = v_old. What rounding makes of x in
// a constraint's value counts as solved (BlockResidual in linearise.h); where impulses balance each other to
// half of the digits, so that next to nothing moves, what it makes of their velocities does, too.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "method.h"
#include "scene.h"

namespace pbd {

enum class Status { ok, not_converged, diverged };
inline constexpr std::array<std::string_view, 3> status_names{"ok", "not_converged", "diverged"};

/// What one effect cost in a step.
struct EffectCost {
  std::string_view effect;
  std::int64_t rows = 0;
  std::int64_t bytes = 0;  // of its rows
  double seconds = 0;      // linearising, and relaxing as the first of each outer iteration's sweeps took;
                           // what `direct` spends in its common factorisation is in no effect's share
  double contraction = 0;  // bound of the effect's own geometric stiffness over inertia, last step
};

/// What a contact does at the end of a step, in the world: `force` acts on a, its opposite on b.
struct ContactForce {
  std::array<int, 2> collider;  // a and b: colliders, then the effect's nodes, then (surfaces) the scene's
  Vec3 point;                   // m
  Vec3 normal;                  // from b to a
  Vec3 force;                   // N
  Vec3 slip;                    // m/s, of a against b across the normal
  double gap;                   // m
};

/// What a step reached. Residuals are absolute, in sqrt(J).
struct Report {
  Status status = Status::ok;
  std::string_view reason;  // empty if ok
  int outer_iterations = 0;
  std::int64_t sweeps = 0;
  std::int64_t row_updates = 0;
  double primal = 0;
  double dual = 0;
  double scale = 0;
  double contraction = std::nan("");  // of plain at the step's end: what it multiplies an error by; an
                                      // estimate, for quasi_newton an upper bound

  /// Largest residual relative to `scale`; 0 if both vanish.
  double residual() const;
};

/// State of the iteration at an outer iterate, shown to an observer before the iterate is improved.
struct Iterate {
  int outer_iteration;
  std::int64_t sweeps;
  std::int64_t row_updates;
  double primal, dual, scale;
  const Points& x;  // x(v)
  const Points& v;
};
using Observer = std::function<void(const Iterate&)>;

/// Everything a step needs besides scene and state: rows, impulses, factorisations. Allocated once.
class Workspace {
 public:
  /// Validates the scene and the method and looks up the method's names; throws SetupError.
  Workspace(const Scene& scene, const Method& method);
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

  /// Rows, bytes and seconds per effect with rows, in the scene's order, summed over all steps so far.
  std::vector<EffectCost> costs() const;

  /// Impulses of effect `index` after the last step, N s (N m s for angles, J s for strains), R for each of
  /// its constraints that is a row.
  std::vector<double> impulses(std::size_t index) const;

  /// Force multipliers of effect `index` at the end of the last step, the impulses over the step's s: N (N m
  /// for angles, J for strains), R for each of its constraints; NaN for those that are no rows (compliant
  /// ones under explicit forces). J^T times them are the forces.
  std::vector<double> forces(std::size_t index) const;

  /// All contacts of the last step, open ones included.
  std::vector<ContactForce> contacts() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
  friend Report step(const Scene&, const Method&, double, State&, Workspace&, const Observer&);
};

/// Advances `state` by h seconds. Does not throw: what went wrong stands in the report. A diverged step
/// leaves `state` as it was.
Report step(const Scene& scene, const Method& method, double h, State& state, Workspace& workspace,
            const Observer& observer = {});

}  // namespace pbd
