// Trajectories of a scene in continuous time: the judge of integrators.
//
//   compliant constraints alone   M x'' = f - dU/dx(x)      positions and velocities
//   a planar hard chain           planar_chain.h            angles and rates
//   rigid bodies                  rigid_motion.h            positions, velocities, quaternions, spins
//
// Integrated twice by an explicit method of order 8 (numerics.h), so that the result says how far it can be
// trusted. No time step takes part; constraints and multipliers
// only where there are rigid bodies, whose hard joints hold by their accelerations: they drift, and are
// measured.
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
  /// Likewise the largest angle between orientations (rad) and distance of spins (rad/s) of rigid bodies.
  std::vector<double> orientation_error, spin_error;
  /// Of hard constraints over the samples, where there are rigid bodies: largest |c| over the length of its
  /// gradient (m) and of its rate (m/s). Not ok where the first exceeds ten times the errors.
  std::optional<double> position_drift, velocity_drift;
  /// Largest change of T + U - f.x over the samples, relative to the largest |T| + |U - f.x| (x counted from
  /// the start); none where supports, motors or torques do work.
  std::optional<double> energy_drift;
  Outcome outcome = Outcome::not_converged;  // ok or not_converged
  std::string reason;                        // empty if ok
  long evaluations = 0;                      // of the accelerations, by the finer run
  double seconds = 0;                        // of both runs
};

/// The motion from the scene's initial state, at increasing times (s) >= 0 after it. Throws SetupError for a
/// scene that is invalid, or has hard constraints and neither is a planar chain (`hung_chain`) nor has rigid
/// bodies, or starts off its hard joints.
Trajectory ode(const Scene& scene, const std::vector<double>& times, const OdeSettings& settings = {});

}  // namespace pbd::reference
