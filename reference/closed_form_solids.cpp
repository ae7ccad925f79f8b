#include "closed_form_solids.h"

#include <gsl/gsl_sf_ellint.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <numbers>
#include <vector>

#include "dense.h"
#include "numerics.h"

namespace pbd::reference {
namespace {

using std::numbers::pi;

/// sqrt(load) of the elastica whose tip has this angle.
double root_of_load(double angle) {
  const double k = std::sqrt((1 + std::sin(angle)) / 2), phi = std::asin(1 / (k * std::numbers::sqrt2));
  return gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE) - gsl_sf_ellint_F(phi, k, GSL_PREC_DOUBLE);
}

/// Angles of the links, from the tip's to the clamp's, which is 0 at equilibrium.
std::vector<double> angles_from_tip(double load, int links, double tip) {
  const double bend = load / (static_cast<double>(links) * links);  // P l/k
  std::vector<double> angle{tip};
  double lever = 0;  // over a link
  for (int i = links - 1; i >= 0; --i) {
    lever += std::cos(angle.back());
    angle.push_back(angle.back() - bend * lever / (i == 0 ? 2 : 1));
  }
  return angle;
}

}  // namespace

double square_bar_twist(double length, double side, double shear_modulus, double torque) {
  double sum = 0;
  for (int n = 99; n >= 1; n -= 2) sum += std::tanh(n * pi / 2) / std::pow(n, 5);
  const double beta = (1 - 192 / std::pow(pi, 5) * sum) / 3;
  return torque * length / (beta * shear_modulus * std::pow(side, 4));
}

TipPlace elastica(double load) {
  const double root = std::sqrt(load);
  const double angle = find_root([&](double a) { return root_of_load(a) - root; }, 1e-9, pi / 2 - 1e-6);
  const double k = std::sqrt((1 + std::sin(angle)) / 2), phi = std::asin(1 / (k * std::numbers::sqrt2));
  const double e = gsl_sf_ellint_Ecomp(k, GSL_PREC_DOUBLE) - gsl_sf_ellint_E(phi, k, GSL_PREC_DOUBLE);
  return {1 - 2 * e / root, 1 - std::sqrt(2 * std::sin(angle)) / root, angle};
}

TipPlace elastica_of_links(double load, int links) {
  const double near = elastica(load).angle;  // the chain's differs by the square of a link
  const double tip = find_root([&](double a) { return angles_from_tip(load, links, a).back(); }, 0.9 * near,
                               std::min(1.1 * near, pi / 2));
  auto angle = angles_from_tip(load, links, tip);
  angle.pop_back();
  TipPlace place{0, 1, tip};
  for (const double each : angle) {
    place.drop += std::sin(each) / links;
    place.shortening -= std::cos(each) / links;
  }
  return place;
}

double euler_load(bool pinned) {
  return pinned ? pi * pi : pi * pi / 4;
}

double euler_load_of_links(bool pinned, int links) {
  return 4.0 * links * links * std::pow(std::sin(pi / ((pinned ? 2 : 4) * links)), 2);
}

double greenhill_load() {
  // J_(-1/3)(z) without its factor z^(-1/3): sum of (-z^2/4)^m/(m! Gamma(m + 2/3)).
  const auto bessel = [](double z) {
    double sum = 0, term = 1 / std::tgamma(2.0 / 3);
    for (int m = 1; m < 40; ++m) {
      sum += term;
      term *= -z * z / 4 / (m * (m - 1.0 / 3));
    }
    return sum;
  };
  return 2.25 * std::pow(find_root(bessel, 1, 2.5), 2);
}

double greenhill_load_of_links(int links) {
  const double n = links;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(links, links), weight = stiffness;
  for (int i = 0; i < links; ++i) {
    stiffness(i, i) = (i == 0 ? 3 : 2) * n;
    if (i == links - 1) stiffness(i, i) -= n;
    if (i > 0) stiffness(i, i - 1) = stiffness(i - 1, i) = -n;
    weight(i, i) = (n - i - 0.5) / (n * n);
  }
  return generalised_eigenvalues(stiffness, weight)(0);
}

BarState neo_hookean_bar(double young, double poisson, double stretch) {
  const double mu = young / (2 * (1 + poisson));
  const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const auto across = [&](double t) { return mu * (t * t - 1) + lambda * std::log(stretch * t * t); };
  const double t = find_root(across, 1e-3, 1e3);
  return {mu * (stretch - 1 / stretch) + lambda * std::log(stretch * t * t) / stretch, t};
}

double spring_lattice_poisson(const Points& springs, const Eigen::VectorXd& stiffness) {
  // Six strains (xx, yy, zz, 2 xy, 2 yz, 2 zx): a spring's elongation is l n^T eps n.
  Eigen::Matrix<double, 6, 6> moduli = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index i = 0; i < springs.cols(); ++i) {
    const double length = springs.col(i).norm();
    const Vec3 n = springs.col(i) / length;
    Eigen::Matrix<double, 6, 1> along;
    along << n.cwiseAbs2(), n.x() * n.y(), n.y() * n.z(), n.z() * n.x();
    moduli += stiffness[i] * length * length * along * along.transpose();
  }
  const Eigen::Matrix<double, 6, 1> strain = moduli.ldlt().solve(Eigen::Matrix<double, 6, 1>::Unit(0));
  return -strain[1] / strain[0];
}

double hertz_force(double young, double poisson, double radius, double depth) {
  return 4.0 / 3 * young / (1 - poisson * poisson) * std::sqrt(radius) * std::pow(depth, 1.5);
}

Sunk point_load_displacement(double young, double poisson, double force, double z, double r) {
  const double rho = std::hypot(z, r), cube = rho * rho * rho;
  const double share = force * (1 + poisson) / (2 * pi * young);  // F/(4 pi G)
  return {share * (z * z / cube + 2 * (1 - poisson) / rho),
          share * r * (z / cube - (1 - 2 * poisson) / (rho * (rho + z)))};
}

double thick_sphere_displacement(const ThickSphere& sphere, double pressure, double r) {
  const double a3 = std::pow(sphere.inner, 3), b3 = std::pow(sphere.outer, 3);
  return pressure * a3 * r / (sphere.young * (b3 - a3)) *
         (1 - 2 * sphere.poisson + (1 + sphere.poisson) * b3 / (2 * r * r * r));
}

double loaded_bar_frequency(const LoadedBar& bar) {
  // Below its pole at pi/2, times the cosine.
  const double x =
      find_root([&](double a) { return a * std::sin(a) - bar.ratio * std::cos(a); }, 1e-9, pi / 2);
  return bar.wave_speed * x / (2 * pi * bar.length);
}

double loaded_bar_frequency_of_elements(const LoadedBar& bar, int elements) {
  const double half = 0.5 / elements;
  const auto above = [&](double a) {
    return std::sin(a) * std::tan(a * half) - bar.ratio * half * std::cos(a);
  };
  const double x = find_root(above, 1e-9, pi / 2);
  return bar.wave_speed * std::sin(x * half) / (2 * pi * half * bar.length);
}

double struck_mass_speed(const LoadedBar& bar, double time) {
  return std::exp(-bar.ratio * bar.wave_speed * time / bar.length);
}

}  // namespace pbd::reference
