// A judge of whole steps with contact: the judges of contact problems solve them one linear problem at a
// time.
#pragma once

#include "cones/cone_solvers.h"
#include "scene.h"

namespace pbdcheck {

struct ContactJudgement {
  pbd::State end;
  std::string status, reason;  // ok or not_converged
  int iterations = 0;
  double seconds = 0;
  double residual = 0;  // last change of a velocity, relative to the largest free one
};

/// The implicit Euler step of h seconds from `state` of bodies that nothing but contacts hold, all with
/// friction and without restitution, compliance, damping or gyroscopic torque. The rows, which are the
/// solver's own, are linearised at the judge's iterates until velocities stay within 1e-12 of the largest
/// free one. Throws Interrupted, and SetupError where contacts have restitution: rows of bodies that collide
/// are others.
ContactJudgement judge_contacts(const ConeSolver& judge, const pbd::Scene& scene, const pbd::State& state,
                                double h, pbd::reference::FrictionLaw law);

}  // namespace pbdcheck
