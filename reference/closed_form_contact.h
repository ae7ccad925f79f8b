// Contact and friction with a formula. SI units; g is a positive acceleration (m/s^2), mu a coefficient of
// friction, angles in rad.
#pragma once

namespace pbd::reference {

/// m x'' = -k x -+ mu m g: each half swing is shorter than the last by 2 mu m g/k (m); it stays where
/// |x| <= mu m g/k at a turn.
double friction_swing_loss(double stiffness, double mass, double mu, double g);
/// Where it comes to rest after it was let go at x = amplitude.
double friction_swing_rest(double stiffness, double mass, double mu, double g, double amplitude);

/// A mass dropped from a height on a massless spring that it does not stick to.
struct Landing {
  double compression;  // m, the largest: s + sqrt(s^2 + 2 s height), s = m g/k
  double time;         // s, of contact: 2/w (pi/2 + atan(g/(w v)))
};
Landing spring_landing(double stiffness, double mass, double g, double height);

/// A body of inertia share m r^2 that slips at `speed` until it rolls, at speed/(1 + share).
struct SlipToRoll {
  double time, speed, way;  // s, m/s, m
};
SlipToRoll slip_to_roll(double share, double speed, double mu, double g);

/// Time (s) in which friction stops a body of inertia share m r^2 that spins flat on the plane about its
/// axis: pressed uniformly under a disc, lever 2 r/3, or on its rim, lever r.
double spin_down_disc(double share, double spin, double radius, double mu, double g);
double spin_down_rim(double share, double spin, double radius, double mu, double g);

/// Largest overhang (m) of n bricks of a length on each other: length/2 (1 + 1/2 + ... + 1/n).
double brick_overhang(int n, double length);
/// Least friction on the floor under a uniform ladder at `angle` from the floor against a smooth wall:
/// 1/(2 tan(angle)).
double ladder_friction(double angle);
/// Friction from which a uniform rod that slides at `angle` on its lower end has no accelerations:
/// (1 + 3 cos^2)/(3 sin cos), least 4/3 at tan(angle) = 2.
double painleve_friction(double angle);

/// Kinetic energy (J) that a body of mass m (kg) and moment of inertia (kg m^2) gains by an impact in a
/// plane. Its point (x, z) from the centre (m) strikes a plane across z at the velocity (u, w) (m/s), sticks,
/// and comes back at -e w, as Newton's restitution says (kane1985dynamics): p . (u, (1 - e) w)/2, W p = (-u,
/// -(1 + e) w), W = 1/m + [z^2, -x z; -x z, x^2]/inertia.
double newton_impact_gain(double m, double inertia, double x, double z, double u, double w, double e);

/// Ratio of the tensions of a rope that slides over a drum by an angle: exp(mu angle), and of one of `links`
/// massless links with `links` nodes on the drum: ((1 + mu t)/(1 - mu t))^links, t = tan(angle/links/2).
double capstan_ratio(double mu, double angle);
double capstan_ratio_of_links(double mu, double angle, int links);

/// Rate (rad/s) at which a thin disc's tilt circles as it rolls, its centre at rest, at `angle` from the
/// floor: sqrt(4 g/(radius sin(angle))).
double rolling_disc_rate(double radius, double angle, double g);

}  // namespace pbd::reference
