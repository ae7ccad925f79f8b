// Trajectories of a scene in continuous time: the judge of integrators.
//
//   compliant constraints alone   M x'' = f - dU/dx(x)      positions and velocities
//   a planar hard chain           planar_chain.h            angles and rates
//
// Integrated twice by an explicit method of order 8 (numerics.h), so that the result says how far it can be
// trusted. No time step, constraint solver or multiplier takes part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "judge.h"
#include "numerics.h"

namespace pbd::reference {

struct Trajectory {
  std::vector<State> samples;  // one per time asked, at the initial time plus it; none unless ok
  /// Per sample: largest distance of a node (m), and of its velocity (m/s), to the run with a hundred times
  /// the tolerance. Bounds the error of that run and so, generously, of this one.
  std::vector<double> position_error, velocity_error;
  /// Largest change of T + U - f.x over the samples, relative to the largest |T| + |U - f.x| (x counted from
  /// the start); none where supports move and do work.
  std::optional<double> energy_drift;
  Outcome outcome = Outcome::not_converged;  // ok or not_converged
  std::string reason;                        // empty if ok
  long evaluations = 0;                      // of the accelerations, by the finer run
  double seconds = 0;                        // of both runs
};

/// The motion from the scene's initial state, at increasing times (s) >= 0 after it. Throws SetupError for a
/// scene that is invalid, or has hard constraints and is no planar chain (`hung_chain`).
Trajectory ode(const Scene& scene, const std::vector<double>& times, const OdeSettings& settings = {});

}  // namespace pbd::reference
