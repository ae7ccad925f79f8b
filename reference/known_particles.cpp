#include <cmath>

#include "closed_form.h"
#include "closed_form_bodies.h"
#include "dense.h"
#include "known_answers_rows.h"
#include "numerics.h"

namespace pbd::reference::known {
namespace {

double at_end(const Slope& slope, const Eigen::VectorXd& start, double end) {
  return solve_ode(slope, start, {end}).states.back()(0);
}

Slope pendulum_slope() {
  return [](double, const Eigen::VectorXd& y, Eigen::VectorXd& slope) { slope << y(1), -g * std::sin(y(0)); };
}

/// Position relative to the start after `time`, released at rest: by ODE.
double damped_spring_by_ode(double stiffness, double damping, double time) {
  const auto slope = [&](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    out << y(1), -stiffness * y(0) - damping * y(1);
  };
  return at_end(slope, Eigen::Vector2d(1, 0), time);
}

void damped_springs(Rows& rows) {
  const DampedSpring spring = damped_spring(100, 1, 1);
  const Eigen::VectorXcd poles = eigenvalues(Eigen::Matrix2d{{0, 1}, {-100, -1}});
  const double ratio = damped_spring_by_ode(100, 1, 2 * pi / spring.frequency);
  rows.push_back({"damped_spring", "damped spring k = 100 N/m, m = 1 kg, c = 1 Ns/m: damping ratio", "1",
                  spring.ratio, "0.05", -poles(0).real() / std::abs(poles(0))});
  rows.push_back({"damped_spring", "its frequency", "rad/s", spring.frequency, "9.987492178",
                  std::abs(poles(0).imag())});
  rows.push_back(
      {"damped_spring", "its logarithmic decrement", "1", spring.decrement, "0.314552702", -std::log(ratio)});
  rows.push_back({"damped_spring", "its amplitude ratio per period", "1", std::exp(-spring.decrement),
                  "0.730115380", ratio});
}

/// Angular velocity at which a spherical pendulum of 1 m keeps its height, by ODE in Cartesian coordinates
/// with the tension that keeps its length.
double conical_rate_by_ode(double angle) {
  const auto slope = [](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    const Eigen::Vector3d weight(0, 0, -g), x = y.head<3>(), v = y.tail<3>();
    out << v, weight - (x.dot(weight) + v.squaredNorm()) / x.squaredNorm() * x;
  };
  const auto rise = [&](double rate) {
    Eigen::VectorXd start(6);
    start << std::sin(angle), 0, -std::cos(angle), 0, rate * std::sin(angle), 0;
    return solve_ode(slope, start, {0.5}).states.back()(2) + std::cos(angle);
  };
  return find_root(rise, 3, 4);
}

/// Period on the cycloid (r (s + sin s), r (1 - cos s)), r = 1 m, released at s = 2: by ODE to the lowest
/// point.
double tautochrone_by_ode() {
  const auto slope = [](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    out << y(1), std::sin(y(0)) * (y(1) * y(1) - g) / (2 * (1 + std::cos(y(0))));
  };
  return 4 * find_root([&](double t) { return at_end(slope, Eigen::Vector2d(2, 0), t); }, 0.9, 1.1);
}

void pendulums(Rows& rows) {
  for (const auto& [degrees, stated] : {std::pair{5.0, "2.00702191"},
                                        {30.0, "2.04098989"},
                                        {60.0, "2.15287467"},
                                        {90.0, "2.36784195"},
                                        {120.0, "2.75408983"},
                                        {150.0, "3.53509819"},
                                        {170.0, "4.89352427"},
                                        {179.0, "7.82579684"}}) {
    const double k = std::sin(radians(degrees) / 2);
    const auto integrand = [k](double s) { return 1 / std::sqrt(1 - std::pow(k * std::sin(s), 2)); };
    rows.push_back({"pendulum", "pendulum of 1 m from " + number(degrees) + " deg: period", "s",
                    pendulum_period(1, g, radians(degrees)), stated,
                    4 / std::sqrt(g) * integrate(integrand, 0, pi / 2)});
  }
  // IFToMM's multibody benchmark A01 (mirrored).
  for (const auto& [time, x, z] : {std::tuple{1.0, "-0.98629175113", "-0.16501085313"},
                                   {2.0, "0.79356619534", "-0.60848393044"},
                                   {5.0, "0.94230543504", "-0.33475433841"},
                                   {9.99, "0.31643646991", "-0.94861370458"},
                                   {10.0, "0.27508746258", "-0.96141920510"}}) {
    const double angle = pendulum_motion(1, g, pi / 2, time).angle;
    const double integrated = at_end(pendulum_slope(), Eigen::Vector2d(pi / 2, 0), time);
    const std::string name = "pendulum of 1 m from 90 deg after " + number(time) + " s: ";
    rows.push_back({"pendulum", name + "x", "m", std::sin(angle), x, std::sin(integrated)});
    rows.push_back({"pendulum", name + "z", "m", -std::cos(angle), z, -std::cos(integrated)});
  }
  // Quarter: m l^2/3 angle'' = -m g l/2 sin(angle).
  const auto rod = [](double, const Eigen::VectorXd& y, Eigen::VectorXd& slope) {
    slope << y(1), -1.5 * g * std::sin(y(0));
  };
  const auto rod_angle = [&](double t) { return at_end(rod, Eigen::Vector2d(pi / 2, 0), t); };
  rows.push_back({"rod_pendulum", "uniform rod of 1 m about its end from 90 deg: period", "s",
                  pendulum_period(rod_pendulum_length(1), g, pi / 2), "1.93333485",
                  4 * find_root(rod_angle, 0.4, 0.6)});
  for (const auto& [rate, stated] : {std::pair{60.0, "0.0377995"}, {600.0, "0.7203721"}}) {
    const double steps = 10 * 2 * pi / std::sqrt(g) * rate;
    rows.push_back(
        {"small_pendulum",
         "small pendulum, ten periods of implicit Euler, h = 1/" + number(rate) + " s: energy left",
         "1",
         std::pow(implicit_euler_oscillator(std::sqrt(g) / rate).growth, 2 * steps),
         stated,
         {}});
  }
  rows.push_back({"conical_pendulum", "conical pendulum of 1 m at 30 deg: period", "s",
                  conical_pendulum_period(1, g, pi / 6), "1.86685540", 2 * pi / conical_rate_by_ode(pi / 6)});
  rows.push_back({"cycloid", "bead on a cycloid of radius 1 m: period", "s", tautochrone_period(1, g),
                  "4.01213336", tautochrone_by_ode()});
}

void double_pendulums(Rows& rows) {
  struct Case {
    const char* name;
    DoublePendulum pendulum;
    const char *slow, *fast;
  };
  for (const Case& c :
       {Case{"small double pendulum, equal masses, 1 m", {1, 1, 1, 1}, "0.381526134", "0.921085566"},
        Case{"small double pendulum, 1 and 2 kg, 1 and 0.5 m",
             {1, 2, 1, 0.5},
             "0.424471397972",
             "1.43395810896"}}) {
    const auto& [m1, m2, l1, l2] = c.pendulum;
    const Eigen::Matrix2d inertia{{(m1 + m2) * l1 * l1, m2 * l1 * l2}, {m2 * l1 * l2, m2 * l2 * l2}};
    const Eigen::Matrix2d stiffness = Eigen::Vector2d((m1 + m2) * g * l1, m2 * g * l2).asDiagonal();
    const Eigen::VectorXd modes = generalised_eigenvalues(stiffness, inertia);
    for (const int mode : {1, 2})
      rows.push_back({"double_pendulum",
                      std::string(c.name) + (mode == 1 ? ": slow" : ": fast") + " frequency", "Hz",
                      double_pendulum_frequency(c.pendulum, g, mode), mode == 1 ? c.slow : c.fast,
                      std::sqrt(modes(mode - 1)) / (2 * pi)});
  }
}

void falls(Rows& rows) {
  double speed = 0, fallen = 0;
  for (int step = 0; step < 100; ++step) speed += 0.01 * g, fallen += 0.01 * speed;
  rows.push_back({"free_fall", "free fall, h = 0.01 s, 1 s: lag of implicit Euler g h t/2", "m",
                  implicit_euler_fall_lag(g, 0.01, 1), "0.04905", fallen - g / 2});
  // y = L sin(s)^2 makes dy/y' smooth.
  const double time = integrate(
      [](double s) { return 2 * std::pow(std::cos(s), 2) / std::sqrt(2 - std::pow(std::sin(s), 2)); }, 0,
      pi / 2);
  rows.push_back({"folded_chain", "folded chain of 1 m, energy conserved: fall time", "s",
                  folded_chain_time(1, g), "0.382536737", time / std::sqrt(g)});
  rows.push_back({"folded_chain", "its ratio to free fall", "1", folded_chain_time(1, g) / std::sqrt(2 / g),
                  "0.847213085", time / std::sqrt(2.0)});
}

void orbits(Rows& rows) {
  const auto slope = [](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    out << y.tail<2>(), -y.head<2>() / std::pow(y.head<2>().norm(), 3);
  };
  const PlanarState start = kepler_orbit(1, 1, 0.6, 0);
  const std::string orbit = "Kepler orbit a = 1 m, mu = 1 m^3/s^2, e = 0.6: ";
  rows.push_back({"kepler", orbit + "speed at the pericentre", "m/s", start.vy, "2", std::nullopt});
  for (const auto& [time, x, y] :
       {std::tuple{1.0, "-0.628948177", "0.799664731"}, {3.0, "-1.596083003", "0.0707385107"}}) {
    const PlanarState at = kepler_orbit(1, 1, 0.6, time);
    const Eigen::VectorXd integrated = solve_ode(slope, Eigen::Vector4d(0.4, 0, 0, 2), {time}).states.back();
    const std::string when = " after " + number(time) + " s";
    rows.push_back({"kepler", joined({orbit, "x", when}), "m", at.x, x, integrated(0)});
    rows.push_back({"kepler", joined({orbit, "y", when}), "m", at.y, y, integrated(1)});
    rows.push_back({"kepler", joined({orbit, "energy", when}), "J/kg",
                    (at.vx * at.vx + at.vy * at.vy) / 2 - 1 / std::hypot(at.x, at.y), "-0.5", std::nullopt});
    rows.push_back({"kepler", joined({orbit, "angular momentum", when}), "m^2/s", at.x * at.vy - at.y * at.vx,
                    "0.8", std::nullopt});
  }
}

}  // namespace

void particles(Rows& rows) {
  falls(rows);
  damped_springs(rows);
  rows.push_back({"compliant_link",
                  "constraint of compliance 1e-4 m/N under 1 kg: stretch",
                  "m",
                  g * 1e-4,
                  "9.81e-4",
                  {}});

  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(20, 20);  // stiffness over mass of 20 springs in series
  for (int i = 0; i < 20; ++i) {
    chain(i, i) = i < 19 ? 2e4 : 1e4;
    if (i > 0) chain(i, i - 1) = chain(i - 1, i) = -1e4;
  }
  const Eigen::VectorXd hung = solve_definite(chain, Eigen::VectorXd(Eigen::VectorXd::Constant(20, g)));
  const double lowest = symmetric_eigen(chain).values(0);
  rows.push_back({"spring_chain", "20 springs of 1e4 N/m with 1 kg each, hung: stretch", "m",
                  spring_chain_stretch(20, 1e4, 1, g), "0.206010", hung(19)});
  rows.push_back({"spring_chain", "their lowest frequency", "Hz", spring_chain_frequency(20, 1e4, 1),
                  "1.219213880", std::sqrt(lowest) / (2 * pi)});
  pendulums(rows);
  double_pendulums(rows);
  orbits(rows);
}

}  // namespace pbd::reference::known
