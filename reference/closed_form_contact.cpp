#include "closed_form_contact.h"

#include <cmath>
#include <numbers>

namespace pbd::reference {

double friction_swing_loss(double stiffness, double mass, double mu, double g) {
  return 2 * mu * mass * g / stiffness;
}

double friction_swing_rest(double stiffness, double mass, double mu, double g, double amplitude) {
  const double loss = friction_swing_loss(stiffness, mass, mu, g);
  double x = amplitude;
  while (std::abs(x) > loss / 2) x = -std::copysign(std::abs(x) - loss, x);
  return x;
}

Landing spring_landing(double stiffness, double mass, double g, double height) {
  const double sag = mass * g / stiffness, w = std::sqrt(stiffness / mass), speed = std::sqrt(2 * g * height);
  return {sag + std::sqrt(sag * sag + 2 * sag * height),
          2 / w * (std::numbers::pi / 2 + std::atan(g / (w * speed)))};
}

SlipToRoll slip_to_roll(double share, double speed, double mu, double g) {
  const double end = speed / (1 + share);
  return {(speed - end) / (mu * g), end, (speed * speed - end * end) / (2 * mu * g)};
}

double spin_down_disc(double share, double spin, double radius, double mu, double g) {
  return share * spin * radius / (2.0 / 3 * mu * g);
}

double spin_down_rim(double share, double spin, double radius, double mu, double g) {
  return share * spin * radius / (mu * g);
}

double brick_overhang(int n, double length) {
  double sum = 0;
  for (int k = 1; k <= n; ++k) sum += length / (2 * k);
  return sum;
}

double ladder_friction(double angle) {
  return 1 / (2 * std::tan(angle));
}

double painleve_friction(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (1 + 3 * c * c) / (3 * s * c);
}

double newton_impact_gain(double m, double inertia, double x, double z, double u, double w, double e) {
  const double along = 1 / m + z * z / inertia, across = 1 / m + x * x / inertia, both = -x * z / inertia;
  const double determinant = along * across - both * both, du = -u, dw = -(1 + e) * w;
  const double p_along = (across * du - both * dw) / determinant,
               p_across = (along * dw - both * du) / determinant;
  return (p_along * u + p_across * (1 - e) * w) / 2;
}

double capstan_ratio(double mu, double angle) {
  return std::exp(mu * angle);
}

double capstan_ratio_of_links(double mu, double angle, int links) {
  const double t = std::tan(angle / links / 2);
  return std::pow((1 + mu * t) / (1 - mu * t), links);
}

double rolling_disc_rate(double radius, double angle, double g) {
  return std::sqrt(4 * g / (radius * std::sin(angle)));
}

}  // namespace pbd::reference
