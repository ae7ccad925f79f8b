#include "known_answers.h"

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "closed_form.h"
#include "linear_fem.h"

namespace pbd::reference {
namespace {

constexpr double pi = std::numbers::pi, g = 9.81;
using Rows = std::vector<KnownAnswer>;

double radians(double degrees) {
  return degrees * pi / 180;
}

std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

/// Ratio |z_n| and mean phase of the recurrence z_{n+1} = next(z_n, z_{n-1}) after n steps, from z_0 = 1 and
/// z_1.
std::complex<double> recurrence(
    const std::function<std::complex<double>(std::complex<double>, std::complex<double>)>& next,
    std::complex<double> first, int steps) {
  std::complex<double> before = 1, now = first;
  for (int n = 1; n < steps; ++n) {
    const auto after = next(now, before);
    before = now;
    now = after;
  }
  return now;
}

/// Amplitude left after t = 1 for w = 2 pi, by stepping z' = i w z.
double stepped_implicit_euler(double h) {
  const std::complex<double> i(0, 1);
  const auto step = [&](std::complex<double> z, std::complex<double>) {
    return z / (1.0 - i * 2.0 * pi * h);
  };
  return std::abs(recurrence(step, step(1, 0), static_cast<int>(std::lround(1 / h))));
}
double stepped_bdf2(double h) {
  const std::complex<double> i(0, 1);
  const Discrete exact = bdf2_oscillator(2 * pi * h);
  const auto step = [&](std::complex<double> z, std::complex<double> old) {
    return (4.0 * z - old) / (3.0 - 4.0 * i * pi * h);
  };
  return std::abs(
      recurrence(step, std::polar(exact.growth, exact.phase), static_cast<int>(std::lround(1 / h))));
}

void oscillator(Rows& rows) {
  struct Case {
    double h;
    const char *euler, *euler_frequency, *newmark, *bdf2, *bdf2_frequency, *symplectic;
  };
  for (const Case& c :
       {Case{0.1, "0.189437059", "0.892830768", "0.968921916", "0.821788215", "0.907391070", "1.01722594"},
        Case{0.01, "0.821187780", "0.998687161", "0.999671208", "0.999614244", "0.998691004", "1.00016457"},
        Case{0.001, "0.980454716", "0.999986841", "0.999996710", "0.999999610", "0.999986841",
             "1.00000164"}}) {
    const double wh = 2 * pi * c.h;
    const std::string at = " of x'' = -(2 pi)^2 x, h = " + number(c.h) + " s";
    const Discrete euler = implicit_euler_oscillator(wh), bdf2 = bdf2_oscillator(wh);
    rows.push_back({"oscillator", "implicit Euler: amplitude after 1 s" + at, "1",
                    std::pow(euler.growth, 1 / c.h), c.euler, stepped_implicit_euler(c.h)});
    rows.push_back({"oscillator", "implicit Euler: frequency ratio" + at, "1", euler.phase / wh,
                    c.euler_frequency, std::arg(1.0 / std::complex<double>(1, -wh)) / wh});
    // Newmark's (Cayley's) map z -> (1 + i wh/2)/(1 - i wh/2) z; symplectic Euler: trace 2 - (wh)^2 = 2
    // cos(phase).
    rows.push_back({"oscillator", "Newmark (1/4, 1/2): frequency ratio" + at, "1",
                    newmark_oscillator(wh).phase / wh, c.newmark,
                    std::arg(std::complex<double>(1, wh / 2) / std::complex<double>(1, -wh / 2)) / wh});
    rows.push_back({"oscillator", "BDF2: amplitude after 1 s" + at, "1", std::pow(bdf2.growth, 1 / c.h),
                    c.bdf2, stepped_bdf2(c.h)});
    rows.push_back({"oscillator", "BDF2: frequency ratio" + at, "1", bdf2.phase / wh, c.bdf2_frequency, {}});
    rows.push_back({"oscillator", "symplectic Euler: frequency ratio" + at, "1",
                    symplectic_euler_oscillator(wh).phase / wh, c.symplectic,
                    std::acos(1 - wh * wh / 2) / wh});
  }
}

/// Zero of a damped spring's rate after one period, relative to the amplitude before: by ODE.
double damped_ratio_by_ode(double stiffness, double damping, double period) {
  const auto slope = [&](double, const std::vector<double>& y) {
    return std::vector<double>{y[1], -stiffness * y[0] - damping * y[1]};
  };
  return solve_ode(slope, {1, 0}, period)[0];
}

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

void chains(Rows& rows) {
  for (const auto& [mode, stated] : {std::pair{1, "0.599388241"}, {2, "1.37584612"}, {3, "2.15688940"}})
    rows.push_back({"hanging_chain", "hanging chain of 1 m: mode " + number(mode), "Hz",
                    hanging_chain_frequency(mode, 1, g), stated, std::nullopt});
  struct Case {
    double length;
    const char *parameter, *sag, *tension;
  };
  for (const Case& c : {Case{1.2, "0.469541523", "0.292343798", "0.761885321"},
                        Case{1.5, "0.308236470", "0.502633262", "0.810869731"},
                        Case{2.0, "0.229640215", "0.796388356", "1.02602857"}}) {
    const Catenary found = catenary(1, c.length);
    const std::string name = "catenary, span 1 m, length " + number(c.length) + " m: ";
    const double a = found.parameter;
    const double length = integrate([a](double x) { return std::cosh(x / a); }, -0.5, 0.5);
    rows.push_back({"catenary", name + "parameter", "m", a, c.parameter, a * length / c.length});
    rows.push_back({"catenary", name + "sag", "m", found.sag, c.sag,
                    integrate([a](double x) { return std::sinh(x / a); }, 0, 0.5)});
    rows.push_back({"catenary", name + "end tension over weight per length", "m", found.end_tension,
                    c.tension, std::hypot(a, c.length / 2)});
  }
  struct Discrete {
    int links;
    const char *sag, *share;
  };
  for (const Discrete& c :
       {Discrete{10, "0.505945932", "0.205105101"}, Discrete{20, "0.503446634", "0.205393949"},
        Discrete{40, "0.502835773", "0.205466695"}, Discrete{80, "0.502683839", "0.205484907"}}) {
    const DiscreteCatenary found = discrete_catenary(1, 1.5, c.links);
    const std::string name = "catenary of " + number(c.links) + " links, span 1 m, length 1.5 m: ";
    rows.push_back({"discrete_catenary", name + "sag", "m", found.sag, c.sag, {}});
    rows.push_back({"discrete_catenary",
                    name + "horizontal tension over weight",
                    "1",
                    found.horizontal_share,
                    c.share,
                    {}});
  }
}

/// Frequency near a guess where the transfer matrix of Timoshenko's beam has a mode.
double timoshenko_by_transfer(const Beam& beam, double guess) {
  return find_root([&](double f) { return timoshenko_determinant(beam, f); }, 0.99 * guess, 1.01 * guess);
}

void solids(Rows& rows) {
  const Beam beam{1, 0.1, 0.1, 1e7, 0.3, 1000};
  const auto euler = BeamTheory::euler_bernoulli, timoshenko = BeamTheory::timoshenko;
  rows.push_back({"cantilever",
                  "cantilever 1 x .1 x .1 m, 1e7 Pa, nu .3, tip force 1 N: Euler-Bernoulli",
                  "m",
                  tip_deflection(beam, 1, euler),
                  "0.004",
                  {}});
  rows.push_back(
      {"cantilever", "the same: Timoshenko", "m", tip_deflection(beam, 1, timoshenko), "0.00403060", {}});
  rows.push_back({"cantilever",
                  "under its weight: Euler-Bernoulli",
                  "m",
                  weight_deflection(beam, g, euler),
                  "0.14715",
                  {}});
  rows.push_back({"cantilever",
                  "under its weight: Timoshenko",
                  "m",
                  weight_deflection(beam, g, timoshenko),
                  "0.14865093",
                  {}});
  for (const auto& [mode, stated] : {std::pair{1, "1.615400679"}, {2, "10.12354325"}, {3, "28.34621423"}})
    rows.push_back({"beam_modes", "its mode " + number(mode) + ": Euler-Bernoulli", "Hz",
                    cantilever_frequency(beam, mode), stated, std::nullopt});
  for (const auto& [mode, stated] : {std::pair{1, "1.602875337"}, {2, "9.612479584"}}) {
    const double value = timoshenko_cantilever_frequency(beam, mode);
    rows.push_back({"beam_modes", "its mode " + number(mode) + ": Timoshenko", "Hz", value, stated,
                    timoshenko_by_transfer(beam, value)});
  }
  for (const auto& [mode, stated] : {std::pair{1, "10.27919896"}, {2, "28.33500776"}})
    rows.push_back({"beam_modes", "the beam free at both ends, mode " + number(mode), "Hz",
                    free_beam_frequency(beam, mode), stated, std::nullopt});

  for (const auto& [stretch, stated] :
       {std::pair{0.5, "-187500"}, {0.8, "-144000"}, {1.2, "264000"}, {1.5, "937500"}})
    rows.push_back({"kirchhoff_bar",
                    "St Venant-Kirchhoff bar, 1e6 Pa, stretch " + number(stretch) + ": nominal stress", "Pa",
                    kirchhoff_uniaxial_stress(1e6, stretch), stated, std::nullopt});
  rows.push_back({"kirchhoff_bar",
                  "nu .3, stretch 0.5: lateral stretch",
                  "1",
                  kirchhoff_lateral_stretch(0.3, 0.5),
                  "1.10679718",
                  {}});
  for (const auto& [shear, p12, p22] : {std::tuple{0.1, "39134.6154", "6730.76923"},
                                        {0.5, "276442.308", "168269.231"},
                                        {1.0, "1057692.31", "673076.923"}}) {
    const ShearStress stress = kirchhoff_shear(1e6, 0.3, shear);
    rows.push_back(
        {"kirchhoff_shear", "simple shear " + number(shear) + ": P12", "Pa", stress.p12, p12, std::nullopt});
    rows.push_back(
        {"kirchhoff_shear", "simple shear " + number(shear) + ": P22", "Pa", stress.p22, p22, std::nullopt});
  }
  rows.push_back({"hanging_bar",
                  "bar of 1 m, 1000 kg/m^3, 1e5 Pa, hung: linear",
                  "m",
                  hanging_bar(1, 1e3, g, 1e5),
                  "0.04905",
                  {}});
  for (const auto& [young, stated] :
       {std::pair{1e5, "0.044994096"}, {5e4, "0.083934939"}, {2e4, "0.179541984"}}) {
    const auto stretch = [young = young](double x) {
      return find_root([&](double l) { return kirchhoff_uniaxial_stress(young, l) - 1e3 * g * (1 - x); }, 0.9,
                       3) -
             1;
    };
    rows.push_back({"hanging_bar", "the same, St Venant-Kirchhoff, nu 0, " + number(young) + " Pa", "m",
                    hanging_bar_kirchhoff(1, 1e3, g, young), stated, integrate(stretch, 0, 1)});
  }
  rows.push_back({"manufactured_cube",
                  "manufactured cube: energy",
                  "J",
                  manufactured_energy({1e6, 0.3}),
                  "39146.26746",
                  {}});
}

void rates(Rows& rows) {
  struct Case {
    int n;
    const char *kappa, *jacobi, *gauss_seidel, *sor, *gradients;
  };
  for (const Case& c : {Case{10, "48.374", "55.685", "27.842", "3.976", "7.952"},
                        Case{20, "178.064", "205.002", "102.501", "7.667", "15.334"},
                        Case{50, "1053.479", "1212.862", "606.431", "18.678", "37.356"},
                        Case{100, "4133.643", "4759.032", "2379.516", "37.007", "74.015"},
                        Case{1000, "406095.0", "467534.2", "233767.1", "366.83", "733.67"}}) {
    const double jacobi = chain_jacobi_radius(c.n), kappa = (1 + jacobi) / (1 - jacobi);
    const double sor = 2 / (1 + std::sqrt(1 - jacobi * jacobi)) - 1;
    const double gradients = (std::sqrt(kappa) - 1) / (std::sqrt(kappa) + 1);
    const std::string name = "chain of " + number(c.n) + " equal masses: ";
    const std::string decade = "iterations per decade";
    rows.push_back({"chain_rates", name + "condition number", "1", kappa, c.kappa,
                    std::pow(1 / std::tan(pi / (2 * (c.n + 1))), 2)});
    rows.push_back(
        {"chain_rates", name + decade + ", Jacobi", "1", iterations_per_decade(jacobi), c.jacobi, {}});
    rows.push_back({"chain_rates",
                    name + decade + ", Gauss-Seidel",
                    "1",
                    iterations_per_decade(jacobi * jacobi),
                    c.gauss_seidel,
                    {}});
    rows.push_back({"chain_rates", name + decade + ", best SOR", "1", iterations_per_decade(sor), c.sor, {}});
    rows.push_back({"chain_rates",
                    name + decade + ", conjugate gradients",
                    "1",
                    iterations_per_decade(gradients),
                    c.gradients,
                    {}});
  }
}

}  // namespace

const std::vector<KnownAnswer>& known_answers() {
  static const Rows table = [] {
    Rows rows;
    oscillator(rows);
    particles(rows);
    chains(rows);
    solids(rows);
    rates(rows);
    return rows;
  }();
  return table;
}

double half_digit(const KnownAnswer& row) {
  const std::size_t exponent_at = row.stated.find('e');
  const std::string mantissa = row.stated.substr(0, exponent_at);
  const double exponent =
      exponent_at == std::string::npos ? 0 : std::stod(row.stated.substr(exponent_at + 1));
  const std::size_t point = mantissa.find('.');
  const double decimals = point == std::string::npos ? 0 : static_cast<double>(mantissa.size() - point - 1);
  return 0.5 * std::pow(10, exponent - decimals);
}

}  // namespace pbd::reference
