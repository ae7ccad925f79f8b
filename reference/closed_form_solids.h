// Elastic bodies with a formula, beyond the beams of closed_form.h: torsion, large deflection, buckling. SI
// units.
#pragma once

#include "geometry.h"

namespace pbd::reference {

/// Saint-Venant's torsion of a square bar of `side` a: angle (rad) T L/(beta G a^4), beta = 1/3 (1 - 192/pi^5
/// sum over odd n of tanh(n pi/2)/n^5) = 0.1406.
double square_bar_twist(double length, double side, double shear_modulus, double torque);

/// Elastica clamped at one end under a load P across it at the other, `load` = P L^2/(E I): how far its tip
/// drops and comes near, over L, and its angle (rad). With k^2 = (1 + sin(angle))/2 and sin(phi) =
/// 1/(k sqrt(2)): sqrt(load) = K(k) - F(phi, k), drop 1 - 2 (E(k) - E(phi, k))/sqrt(load)
/// (landau1976mechanics has the pendulum that its tangent swings as).
struct TipPlace {
  double drop, shortening, angle;
};
TipPlace elastica(double load);

/// A chain of n rigid links of L/n between hinges with springs of stiffness E I n/L, at the clamp twice that:
/// half of a chain of 2 n links that is symmetric about the clamp. The elastica's second-order approximation;
/// place and angle of its tip.
TipPlace elastica_of_links(double load, int links);

/// Loads along it that bend a straight elastica, over E I/L^2: pi^2/4 clamped and free, pi^2 pinned at both
/// ends; of n links as above 4 n^2 sin^2(pi/(4 n)) and, without a spring at the ends, 4 n^2 sin^2(pi/(2 n)).
double euler_load(bool pinned);
double euler_load_of_links(bool pinned, int links);

/// Greenhill's: rho A g L^3/(E I) at which a clamped column bends under its weight, 9/4 j^2 with j the first
/// zero of J_(-1/3); of n links as above the lowest root of det(K - load G), G_i = (n - i - 1/2)/n^2 from the
/// clamp on.
double greenhill_load();
double greenhill_load_of_links(int links);

/// Bar of the energy mu/2 (I1 - 3) - mu ln(J) + lambda/2 ln^2(J) under a stretch l: nominal stress (Pa) mu (l
/// - 1/l) + lambda ln(J)/l and lateral stretch t, by mu (t^2 - 1) + lambda ln(l t^2) = 0.
struct BarState {
  double stress, lateral;
};
BarState neo_hookean_bar(double young, double poisson, double stretch);

/// Lattice of one node a cell, of volume V, joined by springs of stiffness k along vectors l n (m, a column
/// each): strained evenly it is in balance, by symmetry, so that C_ijpq = sum of k l^2 n_i n_j n_p n_q / V.
/// Its lateral (y) over axial strain under a stress along x. C is symmetric in all its indices (Cauchy's
/// relations): where it is isotropic, lambda = mu, and this is 1/4 (love1927treatise).
double spring_lattice_poisson(const Points& springs, const Eigen::VectorXd& stiffness);

/// Force (N) on a rigid sphere pressed by `depth` into an elastic half space: 4/3 E/(1 - nu^2) sqrt(R)
/// d^(3/2).
double hertz_force(double young, double poisson, double radius, double depth);

/// Boussinesq: displacements (m) of an elastic half space under a force (N) into it at the origin of its
/// surface, at the depth z and the distance r from the force's line, rho^2 = r^2 + z^2. Inwards F/(4 pi G)
/// (z^2/rho^3 + 2 (1 - nu)/rho), outwards F r/(4 pi G) (z/rho^3 - (1 - 2 nu)/(rho (rho + z))).
struct Sunk {
  double inwards, outwards;
};
Sunk point_load_displacement(double young, double poisson, double force, double z, double r);

/// Lame's thick sphere, `inner` to `outer` radius a to b (m): displacement outwards (m) at radius r under a
/// pressure (Pa) within, p a^3 r/(E (b^3 - a^3)) (1 - 2 nu + (1 + nu) b^3/(2 r^3)).
struct ThickSphere {
  double young, poisson, inner, outer;
};
double thick_sphere_displacement(const ThickSphere& sphere, double pressure, double r);

/// A bar held at one end with a rigid mass at the other: slowest frequency along it (Hz) c x/(2 pi L), where
/// x tan(x) = `ratio`; of n equal linear elements, masses lumped, n c sin(x/(2 n))/(pi L), where tan(x)
/// tan(x/(2 n)) = ratio/(2 n): u_i = sin(x i/n) meets the equation of each node, and that of the mass.
struct LoadedBar {
  double length, wave_speed;  // L (m), c = sqrt(E/rho) (m/s)
  double ratio;               // the bar's mass over the other
};
double loaded_bar_frequency(const LoadedBar& bar);
double loaded_bar_frequency_of_elements(const LoadedBar& bar, int elements);
/// Share of its speed that the mass has a time (s) after it was struck along the bar: the bar takes rho c A v
/// of momentum a second, exp(-ratio c t/L), until the wave is back at 2 L/c.
double struck_mass_speed(const LoadedBar& bar, double time);

}  // namespace pbd::reference
