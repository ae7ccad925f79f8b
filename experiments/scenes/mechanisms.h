// Rigid bodies and mechanisms shared by experiments and tests. SI units.
#pragma once

#include "scene.h"

namespace pbdcheck {

/// One free body of these principal moments (kg m^2) and angular velocity (rad/s, its own axes), 1 kg,
/// without gravity.
pbd::Scene free_body(const pbd::Vec3& inertia, const pbd::Vec3& spin, bool implicit = true);

/// A disc of 1 kg and radius 0.1 m on a massless axis of 0.1 m (moments 0.0125 and 0.005 kg m^2 about its
/// foot), which a joint holds at the origin. Its axis is tilted by `tilt` (rad) from the vertical about x and
/// precesses about it at `precession` (rad/s); the disc turns about it at `spin` (rad/s, of the body).
pbd::Scene heavy_top(double tilt, double spin, double precession, double compliance = 0);

/// IFToMM A01: 1 kg at the end of a massless rod of 1 m, let go horizontally from (-1, 0, 0) in the plane z =
/// 0, gravity along -y.
pbd::Scene point_pendulum();

/// IFToMM A02: N four-bar loops side by side, 2N + 1 uniform rods of 1 m and 1 kg: N + 1 legs upright on
/// the ground 1 m apart and N couplers on their tops, moving at 1 m/s along x. `extra` more hinges hold what
/// the loops hold already, each beside one of those of the tops.
pbd::Scene four_bars(int loops, int extra = 0);

/// IFToMM A03, Andrews' squeezing mechanism: seven planar bodies, a spring and a constant torque on the crank
/// (schiehlen1990multibody, hairer1996solving). Bodies 1 to 7 are K1 to K7, body 0 the ground.
pbd::Scene andrews_squeezer();

/// Crank of 0.2 m turned by a motor at `rate` rad/s, rod of 0.5 m, and a slider of 1 kg on the x axis.
pbd::Scene slider_crank(double rate);

/// `count` uniform rods of 1/count kg and 1/count m, a ball joint between neighbours and to the ground, let
/// go horizontally; the last rod is `ratio` times as heavy.
pbd::Scene rod_chain(int count, double ratio = 1);

}  // namespace pbdcheck
