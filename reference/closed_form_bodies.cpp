#include "closed_form_bodies.h"

#include <gsl/gsl_mode.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace pbd::reference {
namespace {

/// K from 1 - m, which is exact where m is near one.
double complete_integral(double complement) {
  return gsl_sf_ellint_RF(0, complement, 1, GSL_PREC_DOUBLE);
}

/// A torque-free body with its axes in the order of the formulas.
struct Polhode {
  std::array<Eigen::Index, 3> axis{};
  double parity = 1;                     // of that order
  Vec3 amplitude = Vec3::Zero();         // a
  double rate = 0;                       // 1/s; 0: constant
  double parameter = 0, complement = 1;  // m, 1 - m
  double sense = 1;                      // sign of sn's coefficient: that of I3 - I2
  Vec3 spin = Vec3::Zero();              // in the order of the formulas

  Polhode(const Vec3& inertia, const Vec3& own) {
    if ((own.array() != 0).count() < 2) return;
    axis = {0, 1, 2};
    std::stable_sort(axis.begin(), axis.end(), [&](auto i, auto j) { return inertia[i] < inertia[j]; });
    // L^2 - 2 T I of the middle: its sign says which axis is circled.
    const double middle = inertia[axis[1]];
    const Vec3 beyond = inertia.array() * (inertia.array() - middle) * own.array().square();
    if (beyond.sum() < 0) std::swap(axis[0], axis[2]);
    parity = (axis[1] - axis[0] + 3) % 3 == 1 ? 1 : -1;
    const Vec3 moment(inertia[axis[0]], inertia[axis[1]], inertia[axis[2]]);
    spin = parity * Vec3(own[axis[0]], own[axis[1]], own[axis[2]]);
    // Sums of terms of one sign: |2 T I_k - L^2|.
    const auto excess = [&](int k) {
      return std::abs((moment.array() * (moment.array() - moment[k]) * spin.array().square()).sum());
    };
    const double outer = std::abs(moment[2] - moment[0]);
    if (outer == 0) return;
    const double from_middle = std::abs(moment[2] - moment[1]), to_other = std::abs(moment[1] - moment[0]);
    const double first = excess(0), third = excess(2);
    if (third == 0 || first == 0 || from_middle == 0) return;
    amplitude = Vec3(std::sqrt(third / (moment[0] * outer)), std::sqrt(third / (moment[1] * from_middle)),
                     std::sqrt(first / (moment[2] * outer)));
    rate = std::sqrt(from_middle * first / moment.prod());
    parameter = to_other * third / (from_middle * first);
    complement = outer * std::abs(beyond.sum()) / (from_middle * first);
    sense = moment[2] > moment[1] ? 1 : -1;
  }
};

}  // namespace

Vec3 free_body_spin(const Vec3& inertia, const Vec3& spin, double time) {
  const Polhode p(inertia, spin);
  if (p.rate == 0) return spin;
  const double side = p.spin[2] < 0 ? -1 : 1, across = p.sense * side;
  const double phase = std::atan2(across * p.spin[1] / p.amplitude[1], p.spin[0] / p.amplitude[0]);
  const double start = gsl_sf_ellint_F(phase, std::sqrt(p.parameter), GSL_PREC_DOUBLE);
  double sn = 0, cn = 0, dn = 0;
  gsl_sf_elljac_e(p.rate * time + start, p.parameter, &sn, &cn, &dn);
  const Vec3 own(p.amplitude[0] * cn, across * p.amplitude[1] * sn, side * p.amplitude[2] * dn);
  Vec3 result;
  for (int i = 0; i < 3; ++i) result[p.axis[i]] = p.parity * own[i];
  return result;
}

double free_body_period(const Vec3& inertia, const Vec3& spin) {
  const Polhode p(inertia, spin);
  return p.rate == 0 || p.complement == 0 ? infinity : 4 * complete_integral(p.complement) / p.rate;
}

double body_precession(double across, double along, const Vec3& spin) {
  return (along - across) / across * spin[2];
}
double space_precession(double across, double along, const Vec3& spin) {
  return std::hypot(across * std::hypot(spin[0], spin[1]), along * spin[2]) / across;
}

double sleeping_spin(const HeavyTop& top) {
  return 2 * std::sqrt(top.across * top.weight_moment) / top.along;
}

Precession steady_precession(const HeavyTop& top, double tilt, double spin) {
  const double a = top.across * std::cos(tilt), b = top.along * spin;
  const double discriminant = b * b - 4 * a * top.weight_moment;
  if (!(discriminant >= 0) || !(a > 0)) throw std::runtime_error("heavy top: no steady precession");
  const double larger = b + std::copysign(std::sqrt(discriminant), b);
  return {2 * top.weight_moment / larger, larger / (2 * a)};
}

double rod_pendulum_length(double length) {
  return 2 * length / 3;
}
double falling_rod_rate(double length, double g) {
  return std::sqrt(3 * g / length);
}

Direction circling_pendulum(double length, double g, double top, double time) {
  // Half the angle s: s'^2 = f^2 (1 - m sin^2 s), f half the rate at the lowest point, m = g/(l f^2).
  const double fastest = std::sqrt(top * top + 4 * g / length) / 2, m = g / (length * fastest * fastest);
  const double complement = std::pow(top / (2 * fastest), 2);
  double sn = 0, cn = 0, dn = 0;
  gsl_sf_elljac_e(complete_integral(complement) + fastest * time, m, &sn, &cn, &dn);
  return {2 * sn * cn, cn * cn - sn * sn, 2 * fastest * dn};
}

}  // namespace pbd::reference
