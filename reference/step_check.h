// Whether a step that somebody claims to have solved can be true, by its state, forces and contacts alone. No
// solve: each claim is evaluated by the judges' own values, derivatives and shapes and compared with what the
// step's tolerance leaves open.
//
//   level       = tolerance scale + rounding (sqrt(J)): both residuals of the step are below it. The scale of
//               implicit_euler is the judge's own, by states and given forces; of others it is the one told.
//   motion      x1 - x0 - h v1 (m), and the turn R1 against R0 exp(h w1) (rad); what is fixed keeps its
//               velocities, and goes so by any integrator.
//   momentum    g = M (v1 - v0) - h (f + J^T gamma + contact forces), of rotations with the torques about
//               the bodies' centres: |g| in the metric of inverse masses <= level.
//   constraints r = c + A gamma: sqrt(sum r^T (h^2 J W J^T + A)^-1 r) <= level; of bounded forces what the
//               bounds leave of a change -r/N.
//   contacts    contact_check.h
//   energy      step_energy.h
//
// J and c are taken at the step's end; under symplectic_euler J where it begins. What an error of the
// impulses of W J^T p costs is counted in the same metric, so that no conditioning enters a bound. Rounding
// is 64 units of the largest terms: a sum of some ten terms, each rounded a few times. A turn h w is rounded
// in proportion to itself.
//
// Limits: momentum is judged of implicit_euler (directions at the end) and symplectic_euler, of other
// integrators hard constraints alone, and under newmark, bdf2 and generalised_alpha contacts. Nodes of
// surfaces that press on themselves or each other are judged by their sum, since it is not told how a
// contact's force is shared among them; bodies in contact under symplectic_euler by their linear momentum.
// Damped constraints are not judged by their values, and what damped point joints and attachments act on not
// by its momentum. Angles of pi, where they jump, are left out.
#pragma once

#include <optional>

#include "step_equations.h"

namespace pbd::reference {

/// Made once of a scene; anew where its forces or rest values change.
class StepCheck {
 public:
  /// Throws SetupError for an invalid scene.
  explicit StepCheck(const Scene& scene);

  /// Of a step of the same scene.
  Findings judge(const StepClaim& claim) const;

 private:
  std::optional<StepModel> model_;  // none where nothing moves
};

}  // namespace pbd::reference
