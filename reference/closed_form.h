// Problems with a formula. SI units; g is a positive acceleration (m/s^2).
//
// Elliptic functions and Bessel zeros from GSL. Trap: gsl_sf_ellint takes the modulus k, gsl_sf_elljac the
// parameter m = k^2.
#pragma once

namespace pbd::reference {

/// Pendulum released at rest at `amplitude` (rad): T = 4 sqrt(l/g) K(sin(amplitude/2)), s.
double pendulum_period(double length, double g, double amplitude);
struct Angle {
  double angle;  // rad
  double rate;   // rad/s
};
/// Its motion: sin(angle/2) = k sn(K - t sqrt(g/l)), k = sin(amplitude/2).
Angle pendulum_motion(double length, double g, double amplitude, double time);
/// Circling at `angle` (rad) from the vertical: T = 2 pi sqrt(l cos(angle)/g), s.
double conical_pendulum_period(double length, double g, double angle);
/// Bead on the cycloid of a rolling circle: T = 4 pi sqrt(r/g) for every amplitude, s.
double tautochrone_period(double radius, double g);

/// Two bobs (kg) on massless links (m), the upper ones first.
struct DoublePendulum {
  double upper_mass, lower_mass, upper_length, lower_length;
};
/// Its slow (1) or fast (2) small mode: root of m1 l1 l2 w^4 - (m1 + m2) (l1 + l2) g w^2 + (m1 + m2) g^2 = 0,
/// Hz.
double double_pendulum_frequency(const DoublePendulum& pendulum, double g, int mode);

/// A uniform chain held at one end, the other released beside it: time until the chain hangs straight, energy
/// conserved. y'^2 = g y (2L - y)/(L - y) gives B(3/4, 1/2)/2 sqrt(L/g), s.
double folded_chain_time(double length, double g);
/// How much farther than g t^2/2 implicit Euler falls: g h t/2, m.
double implicit_euler_fall_lag(double g, double h, double time);

struct PlanarState {
  double x, y, vx, vy;  // m, m/s
};
/// Orbit about the origin with gravitational parameter mu (m^3/s^2), semi-major axis a (m) and eccentricity e
/// < 1, at the pericentre (a (1 - e), 0) at time 0 and anticlockwise: E - e sin E = sqrt(mu/a^3) t.
PlanarState kepler_orbit(double mu, double a, double e, double time);

/// m x'' = -k x - c x', underdamped.
struct DampedSpring {
  double ratio;      // zeta = c/(2 sqrt(k m))
  double frequency;  // sqrt(k/m (1 - zeta^2)), rad/s
  double decrement;  // of the amplitude per period, 2 pi zeta/sqrt(1 - zeta^2)
};
DampedSpring damped_spring(double stiffness, double mass, double damping);

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
/// A constraint c = x of compliance A with c + tau c' + A gamma = 0, c' = (x1 - x0)/h, ratio = w tau/2 < 1: w
/// = 1/sqrt(A m). Growth 1/sqrt(1 + 2 ratio wh + (wh)^2).
Discrete implicit_euler_damped_oscillator(double wh, double ratio);
/// Logarithmic decrement per turn of the phase.
double logarithmic_decrement(const Discrete& oscillator);

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
  double shear_stiffness() const;  // kappa G A with kappa = 10 (1 + nu)/(12 + 11 nu) (cowper1966shear), N
};
enum class BeamTheory { euler_bernoulli, timoshenko };
/// Tip deflection of a cantilever (m) under a tip force (N), and under its weight.
double tip_deflection(const Beam& beam, double force, BeamTheory theory);
double weight_deflection(const Beam& beam, double g, BeamTheory theory);
/// Frequency (Hz) of mode n = 1, 2, ...; free-free modes without the rigid ones, Euler-Bernoulli.
double cantilever_frequency(const Beam& beam, int mode);
double free_beam_frequency(const Beam& beam, int mode);
/// Timoshenko's: root of the equation of (huang1961effect) for the clamped-free beam.
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
