#include <Eigen/Dense>
#include <cmath>

#include "closed_form.h"
#include "known_answers_rows.h"

namespace pbd::reference::known {
namespace {

double radians(double degrees) {
  return degrees * pi / 180;
}

/// Zero of a damped spring's rate after one period, relative to the amplitude before: by ODE.
double damped_ratio_by_ode(double stiffness, double damping, double period) {
  const auto slope = [&](double, const std::vector<double>& y) {
    return std::vector<double>{y[1], -stiffness * y[0] - damping * y[1]};
  };
  return solve_ode(slope, {1, 0}, period)[0];
}

}  // namespace

void particles(Rows& rows) {
  rows.push_back({"free_fall",
                  "free fall, h = 0.01 s, 1 s: lag of implicit Euler g h t/2",
                  "m",
                  g * 0.01 / 2,
                  "0.04905",
                  {}});
  const double wd = std::sqrt(100 - 0.25);
  rows.push_back({"damped_spring",
                  "damped spring k = 100 N/m, m = 1 kg, c = 1 Ns/m: frequency",
                  "rad/s",
                  wd,
                  "9.987492178",
                  {}});
  rows.push_back({"damped_spring", "its logarithmic decrement", "1", pi / wd, "0.314552702", {}});
  rows.push_back({"damped_spring", "its amplitude ratio per period", "1", std::exp(-pi / wd), "0.730115380",
                  damped_ratio_by_ode(100, 1, 2 * pi / wd)});
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
  const Eigen::VectorXd hung = chain.ldlt().solve(Eigen::VectorXd::Constant(20, g));
  const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(chain).eigenvalues()(0);
  rows.push_back({"spring_chain", "20 springs of 1e4 N/m with 1 kg each, hung: stretch", "m",
                  spring_chain_stretch(20, 1e4, 1, g), "0.206010", hung(19)});
  rows.push_back({"spring_chain", "their lowest frequency", "Hz", spring_chain_frequency(20, 1e4, 1),
                  "1.219213880", std::sqrt(lowest) / (2 * pi)});
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
  rows.push_back({"rod_pendulum",
                  "uniform rod of 1 m about its end from 90 deg: period",
                  "s",
                  pendulum_period(2.0 / 3, g, pi / 2),
                  "1.93333485",
                  {}});
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
  rows.push_back({"conical_pendulum",
                  "conical pendulum of 1 m at 30 deg: period",
                  "s",
                  2 * pi * std::sqrt(std::cos(pi / 6) / g),
                  "1.86685540",
                  {}});
  rows.push_back({"double_pendulum",
                  "small double pendulum, equal masses, 1 m: slow frequency",
                  "Hz",
                  std::sqrt((2 - std::sqrt(2)) * g) / (2 * pi),
                  "0.381526134",
                  {}});
  rows.push_back({"double_pendulum",
                  "its fast frequency",
                  "Hz",
                  std::sqrt((2 + std::sqrt(2)) * g) / (2 * pi),
                  "0.921085566",
                  {}});
  rows.push_back(
      {"cycloid", "bead on a cycloid of radius 1 m: period", "s", 4 * pi / std::sqrt(g), "4.01213336", {}});
}

}  // namespace pbd::reference::known
