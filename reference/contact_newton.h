// The step of a scene with contact by Newton's method, the contacts' law held in each of its linear systems.
//
// At each iterate the equations of contact_step.h are linearised, contact forces' own change with the pose
// among them, and everything but the contacts is eliminated,
//
//   [ K  -J^T ] [ (dx, d) ]   [ -load + C^T lambda ]
//   [ J   A   ] [  gamma  ] = [ -c                 ]      (UMFPACK; K holds the last iterate's forces)
//
// so that W = C [..]^-1 C^T/h^2 and what the contacts see without forces pose a cone problem
// (cone_problem.h). K enters by its symmetric part, and forces of contacts by what is positive semidefinite
// of their change with the pose: W is then symmetric and semidefinite, and the iteration converges linearly,
// the faster the less the bodies turn in a step. Features are searched at every iterate, near the solution by
// its own pose alone. Where it ends shapes are measured by their support functions (contact_check.h): those
// in each other get the features that part them soonest, however these were at the step's start, and it goes
// on.
//
// With a map of ContactStart it is that integrator's step. After the work of ContactStart it gives up. Where
// solutions lie beside each other, Newton's method from what is claimed ends at another one: `claim_residual`
// tells what the claim leaves as it is.
//
// Limits: no damped point joints or attachments, and not the laws box and disc. Overlaps that a missed step
// has left part as `recovery` says, not by a tenth. Coulomb's law may have several solutions, and where it
// leaves velocities open other solvers find others.
#pragma once

#include "contact_linear.h"

namespace pbd::reference {

struct ContactJudgement : Judgement {
  int contacts = 0;  // that carry a force
  double law = 0;    // residual of their law, times h over the displacement
  std::vector<JudgedContact> all{};
};

/// Throws SetupError for an invalid scene or what the judge does not know.
void require_judged(const Scene& scene, const State& state, double h, Friction friction);

/// Throws SetupError for an invalid scene or what the judge does not know; else all is in the judgement: ok
/// if forces balance, hard constraints and the law are fulfilled to 1e-9, the last correction was below that,
/// and no convex shapes are deeper in each other than the step began and 1e-6 of their size.
ContactJudgement contact_newton(const Scene& scene, const State& state, double h, Friction friction,
                                ConeSolver solver, const ContactStart& start = {});

}  // namespace pbd::reference
