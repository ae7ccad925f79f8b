// Problems with a formula. SI units; g is a positive acceleration (m/s^2).
//
// Elliptic functions and Bessel zeros from GSL. Trap: gsl_sf_ellint takes the modulus k, gsl_sf_elljac the
// parameter m = k^2.
#pragma once

#include <functional>
#include <vector>

namespace pbd::reference {

/// Root of f in [low, high] by Brent's method to rounding. Throws std::runtime_error if f has the same sign
/// at both ends.
double find_root(const std::function<double(double)>& f, double low, double high);
/// Integral over [low, high] to about 1e-12 relative (adaptive Gauss-Kronrod). Throws std::runtime_error if
/// not reached.
double integrate(const std::function<double(double)>& f, double low, double high);
/// State at time `end` of y' = f(t, y) from y(0), by Dormand-Prince 8(7) with tolerance 1e-14.
std::vector<double> solve_ode(const std::function<std::vector<double>(double, const std::vector<double>&)>& f,
                              std::vector<double> y, double end);

/// Pendulum released at rest at `amplitude` (rad): T = 4 sqrt(l/g) K(sin(amplitude/2)), s.
double pendulum_period(double length, double g, double amplitude);
struct Angle {
  double angle;  // rad
  double rate;   // rad/s
};
/// Its motion: sin(angle/2) = k sn(K - t sqrt(g/l)), k = sin(amplitude/2).
Angle pendulum_motion(double length, double g, double amplitude, double time);

/// One step of x'' = -w^2 x multiplies the amplitude by `growth` and turns the phase by `phase` (rad); wh is
/// w times h.
struct Discrete {
  double growth;
  double phase;
};
Discrete implicit_euler_oscillator(double wh);    // 1/sqrt(1 + (wh)^2), atan(wh)
Discrete newmark_oscillator(double wh);           // beta 1/4, gamma 1/2: 1, 2 atan(wh/2)
Discrete bdf2_oscillator(double wh);              // principal root of (3 - 2 i wh) z^2 - 4 z + 1 = 0
Discrete symplectic_euler_oscillator(double wh);  // 1, 2 asin(wh/2), wh < 2

/// Chain of n masses and springs hung from a support: stretch m g n (n+1)/(2k) (m) and its lowest frequency
/// (Hz).
double spring_chain_stretch(int n, double stiffness, double mass, double g);
double spring_chain_frequency(int n, double stiffness, double mass);

/// Mode n = 1, 2, ... of a uniform hanging chain: j_{0,n}/2 sqrt(g/L)/(2 pi), Hz.
double hanging_chain_frequency(int mode, double length, double g);

/// A uniform chain between supports at the same height, a span apart.
struct Catenary {
  double parameter;    // a = H/w, m: horizontal tension over weight per length
  double sag;          // m
  double end_tension;  // over weight per length, m
};
/// Throws std::runtime_error unless length > span.
Catenary catenary(double span, double length);
/// The same for n equal straight links, each with its weight (or half of it at either end).
struct DiscreteCatenary {
  double sag;               // m
  double horizontal_share;  // horizontal tension over total weight
};
DiscreteCatenary discrete_catenary(double span, double length, int links);

/// Prismatic beam of rectangular section, width (across) x height (along the load), m; Young (Pa), Poisson,
/// kg/m^3.
struct Beam {
  double length, width, height, young, poisson, density;
  double area() const { return width * height; }
  double second_moment() const { return width * height * height * height / 12; }
  double shear_stiffness() const;  // kappa G A with kappa = 10 (1 + nu)/(12 + 11 nu) (Cowper 1966), N
};
enum class BeamTheory { euler_bernoulli, timoshenko };
/// Tip deflection of a cantilever (m) under a tip force (N), and under its weight.
double tip_deflection(const Beam& beam, double force, BeamTheory theory);
double weight_deflection(const Beam& beam, double g, BeamTheory theory);
/// Frequency (Hz) of mode n = 1, 2, ...; free-free modes without the rigid ones, Euler-Bernoulli.
double cantilever_frequency(const Beam& beam, int mode);
double free_beam_frequency(const Beam& beam, int mode);
/// Timoshenko's: root of Huang's (1961) equation for the clamped-free beam.
double timoshenko_cantilever_frequency(const Beam& beam, int mode);
/// The same as det of the free end's block of exp(L A) for the first-order system of (w, phi, M, Q): zero at
/// a frequency.
double timoshenko_determinant(const Beam& beam, double frequency);

/// St Venant-Kirchhoff: nominal stress E l (l^2 - 1)/2 (Pa) and lateral stretch of a bar stretched by l.
double kirchhoff_uniaxial_stress(double young, double stretch);
double kirchhoff_lateral_stretch(double poisson, double stretch);
/// First Piola stress of simple shear F = I + s e1 e2^T: P12 = mu s + (lambda/2 + mu) s^3, P22 = (lambda/2 +
/// mu) s^2, Pa.
struct ShearStress {
  double p12, p22;
};
ShearStress kirchhoff_shear(double young, double poisson, double shear);

/// Lengthening (m) of a bar hung at its end under its weight: rho g L^2/(2E), and for St Venant-Kirchhoff
/// with nu = 0.
double hanging_bar(double length, double density, double g, double young);
double hanging_bar_kirchhoff(double length, double density, double g, double young);

/// Relaxation on a chain of n equal masses between walls: spectral radius of Jacobi cos(pi/(n+1)).
double chain_jacobi_radius(int n);
/// Iterations for one more digit at a spectral radius: -1/log10(radius).
double iterations_per_decade(double radius);

}  // namespace pbd::reference
