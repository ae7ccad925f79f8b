#include "closed_form.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_mode.h>
#include <gsl/gsl_sf_bessel.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <gsl/gsl_sf_gamma.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/MatrixFunctions>

#include "numerics.h"

namespace pbd::reference {
namespace {

using std::numbers::pi;

/// Root n = 1, 2, ... of cosh(x) cos(x) = sign, near (n - 1/2) pi (clamped-free, sign -1) or (n + 1/2) pi
/// (free-free, 1). Divided by cosh, so that it stays of order one.
double beam_root(int mode, double sign) {
  const double near = (mode + sign * 0.5) * pi;
  return find_root([&](double x) { return std::cos(x) - sign / std::cosh(x); }, near - 0.45, near + 0.45);
}

double frequency_of(const Beam& b, double root) {
  return root * root / (b.length * b.length) *
         std::sqrt(b.young * b.second_moment() / (b.density * b.area())) / (2 * pi);
}

}  // namespace

double pendulum_period(double length, double g, double amplitude) {
  return 4 * std::sqrt(length / g) * gsl_sf_ellint_Kcomp(std::sin(amplitude / 2), GSL_PREC_DOUBLE);
}

Angle pendulum_motion(double length, double g, double amplitude, double time) {
  const double k = std::sin(amplitude / 2), w = std::sqrt(g / length);
  double sn = 0, cn = 0, dn = 0;
  gsl_sf_elljac_e(gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE) - w * time, k * k, &sn, &cn, &dn);
  return {2 * std::asin(k * sn), -2 * k * w * cn};
}

double conical_pendulum_period(double length, double g, double angle) {
  return 2 * pi * std::sqrt(length * std::cos(angle) / g);
}
double tautochrone_period(double radius, double g) {
  return 4 * pi * std::sqrt(radius / g);
}

double double_pendulum_frequency(const DoublePendulum& p, double g, int mode) {
  const double mass = p.upper_mass + p.lower_mass;
  const double a = p.upper_mass * p.upper_length * p.lower_length;
  const double b = mass * (p.upper_length + p.lower_length) * g, c = mass * g * g;
  const double larger = b + std::sqrt(b * b - 4 * a * c);
  return std::sqrt(mode == 1 ? 2 * c / larger : larger / (2 * a)) / (2 * pi);
}

double folded_chain_time(double length, double g) {
  return gsl_sf_beta(0.75, 0.5) / 2 * std::sqrt(length / g);
}
double implicit_euler_fall_lag(double g, double h, double time) {
  return g * h * time / 2;
}

PlanarState kepler_orbit(double mu, double a, double e, double time) {
  const double rate = std::sqrt(mu / (a * a * a)), anomaly = rate * time, flat = std::sqrt(1 - e * e);
  const double at =
      find_root([&](double s) { return s - e * std::sin(s) - anomaly; }, anomaly - 1, anomaly + 1);
  const double speed = rate * a / (1 - e * std::cos(at));
  return {a * (std::cos(at) - e), a * flat * std::sin(at), -speed * std::sin(at),
          speed * flat * std::cos(at)};
}

DampedSpring damped_spring(double stiffness, double mass, double damping) {
  const double ratio = damping / (2 * std::sqrt(stiffness * mass)), root = std::sqrt(1 - ratio * ratio);
  return {ratio, std::sqrt(stiffness / mass) * root, 2 * pi * ratio / root};
}

Discrete implicit_euler_oscillator(double wh) {
  return {1 / std::sqrt(1 + wh * wh), std::atan(wh)};
}
Discrete newmark_oscillator(double wh) {
  return {1, 2 * std::atan(wh / 2)};
}
Discrete bdf2_oscillator(double wh) {
  const std::complex<double> i(0, 1);
  const std::complex<double> z = (2.0 + std::sqrt(1.0 + 2.0 * i * wh)) / (3.0 - 2.0 * i * wh);
  return {std::abs(z), std::arg(z)};
}
Discrete symplectic_euler_oscillator(double wh) {
  return {1, 2 * std::asin(wh / 2)};
}
Discrete implicit_euler_damped_oscillator(double wh, double ratio) {
  return {1 / std::sqrt(1 + 2 * ratio * wh + wh * wh),
          std::atan2(wh * std::sqrt(1 - ratio * ratio), 1 + ratio * wh)};
}
double logarithmic_decrement(const Discrete& oscillator) {
  return -2 * pi * std::log(oscillator.growth) / oscillator.phase;
}

double spring_chain_stretch(int n, double stiffness, double mass, double g) {
  return mass * g * n * (n + 1) / (2 * stiffness);
}
double spring_chain_frequency(int n, double stiffness, double mass) {
  return std::sqrt(stiffness / mass) * std::sin(pi / (2 * (2 * n + 1))) / pi;
}

double hanging_chain_frequency(int mode, double length, double g) {
  return gsl_sf_bessel_zero_J0(static_cast<unsigned>(mode)) / 2 * std::sqrt(g / length) / (2 * pi);
}

Catenary catenary(double span, double length) {
  if (!(length > span)) throw std::runtime_error("catenary: the chain is not longer than its span");
  // With t = span/(2a): sinh(t)/t = length/span.
  const double t = find_root([&](double s) { return std::sinh(s) - s * length / span; }, 1e-6, 50);
  const double a = span / (2 * t);
  return {a, a * (std::cosh(t) - 1), a * std::cosh(t)};
}

DiscreteCatenary discrete_catenary(double span, double length, int links) {
  if (!(length > span)) throw std::runtime_error("catenary: the chain is not longer than its span");
  // Link i carries the weight between it and the middle: V_i = (i - (n+1)/2) W/n, i = 1..n.
  const auto extent = [&](double share) {
    double x = 0, sag = 0;
    for (int i = 1; i <= links; ++i) {
      const double v = (i - 0.5 * (links + 1)) / links, tension = std::hypot(v, share);
      x += length / links * share / tension;
      if (i <= links / 2) sag -= length / links * v / tension;
    }
    return std::pair{x, sag};
  };
  const double share = find_root([&](double s) { return extent(s).first - span; }, 1e-9, 1e6);
  return {extent(share).second, share};
}

double Beam::shear_stiffness() const {
  return 10 * (1 + poisson) / (12 + 11 * poisson) * young / (2 * (1 + poisson)) * area();
}

double tip_deflection(const Beam& b, double force, BeamTheory theory) {
  const double bending = force * std::pow(b.length, 3) / (3 * b.young * b.second_moment());
  return theory == BeamTheory::euler_bernoulli ? bending : bending + force * b.length / b.shear_stiffness();
}

double weight_deflection(const Beam& b, double g, BeamTheory theory) {
  const double weight = b.density * b.area() * g;
  const double bending = weight * std::pow(b.length, 4) / (8 * b.young * b.second_moment());
  return theory == BeamTheory::euler_bernoulli
             ? bending
             : bending + weight * b.length * b.length / (2 * b.shear_stiffness());
}

double cantilever_frequency(const Beam& beam, int mode) {
  return frequency_of(beam, beam_root(mode, -1));
}
double free_beam_frequency(const Beam& beam, int mode) {
  return frequency_of(beam, beam_root(mode, 1));
}

double timoshenko_cantilever_frequency(const Beam& beam, int mode) {
  const double inertia = beam.second_moment() / (beam.area() * beam.length * beam.length);
  const double shear =
      beam.young * beam.second_moment() / (beam.shear_stiffness() * beam.length * beam.length);
  const auto equation = [&](double b) {
    const double root = std::sqrt(std::pow(inertia - shear, 2) + 4 / (b * b));
    const double alpha = std::sqrt((root - inertia - shear) / 2),
                 beta = std::sqrt((root + inertia + shear) / 2);
    return 2 + (b * b * std::pow(inertia - shear, 2) + 2) * std::cosh(b * alpha) * std::cos(b * beta) -
           b * (inertia + shear) / std::sqrt(1 - b * b * inertia * shear) * std::sinh(b * alpha) *
               std::sin(b * beta);
  };
  // Below Euler-Bernoulli's b = root^2, by less than a third for the slender beams this is meant for.
  const double bound = std::pow(beam_root(mode, -1), 2);
  const double b = find_root(equation, 0.67 * bound, bound);
  return b / (beam.length * beam.length) *
         std::sqrt(beam.young * beam.second_moment() / (beam.density * beam.area())) / (2 * pi);
}

double timoshenko_determinant(const Beam& beam, double frequency) {
  // Unknowns w/L, phi, M L/(E I), Q L^2/(E I) over x/L, so that the exponential's entries are of like size.
  const double w2 = std::pow(2 * pi * frequency, 2), square = beam.length * beam.length;
  const double bending = beam.young * beam.second_moment();
  Eigen::Matrix4d a;
  a << 0, 1, 0, bending / (beam.shear_stiffness() * square),                  // w' = phi + Q/(kappa G A)
      0, 0, 1, 0,                                                             // phi' = M/(E I)
      0, -beam.density * w2 * square / beam.young, 0, -1,                     // M' = -Q - rho I w^2 phi
      -beam.density * beam.area() * w2 * square * square / bending, 0, 0, 0;  // Q' = -rho A w^2 w
  const Eigen::Matrix4d transfer = a.exp();
  return transfer.bottomRightCorner<2, 2>().determinant();
}

double kirchhoff_uniaxial_stress(double young, double stretch) {
  return young * stretch * (stretch * stretch - 1) / 2;
}
double kirchhoff_lateral_stretch(double poisson, double stretch) {
  return std::sqrt(1 - poisson * (stretch * stretch - 1));
}
ShearStress kirchhoff_shear(double young, double poisson, double s) {
  const double mu = young / (2 * (1 + poisson)),
               lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  return {mu * s + (lambda / 2 + mu) * s * s * s, (lambda / 2 + mu) * s * s};
}

double hanging_bar(double length, double density, double g, double young) {
  return density * g * length * length / (2 * young);
}
double hanging_bar_kirchhoff(double length, double density, double g, double young) {
  // Stretch l(P) with P = E l (l^2 - 1)/2 = rho g (L - X); u = integral of (l - 1) dX with dX = dP/(rho g).
  const double weight = density * g * length;
  const double top = find_root([&](double l) { return kirchhoff_uniaxial_stress(young, l) - weight; }, 1,
                               2 + 2 * weight / young);
  const auto primitive = [](double l) { return 3 * std::pow(l, 4) / 8 - l * l * l / 2 - l * l / 4 + l / 2; };
  return young / (density * g) * (primitive(top) - primitive(1));
}

double chain_jacobi_radius(int n) {
  return std::cos(pi / (n + 1));
}
double iterations_per_decade(double radius) {
  return -1 / std::log10(radius);
}

}  // namespace pbd::reference
