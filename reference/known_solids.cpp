#include <cmath>

#include "closed_form.h"
#include "closed_form_solids.h"
#include "dense.h"
#include "known_answers_rows.h"
#include "linear_fem.h"
#include "numerics.h"

namespace pbd::reference::known {
namespace {

/// Frequency near a guess where the transfer matrix of Timoshenko's beam has a mode.
double timoshenko_by_transfer(const Beam& beam, double guess) {
  return find_root([&](double f) { return timoshenko_determinant(beam, f); }, 0.99 * guess, 1.01 * guess);
}

void beams(Rows& rows) {
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
}

void kirchhoff(Rows& rows) {
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
}

void neo_hookean(Rows& rows) {
  for (const auto& [stretch, stress, lateral] : {std::tuple{0.5, "-935352.057", "1.2107674"},
                                                 {0.8, "-240005.382", "1.0673384"},
                                                 {1.2, "174929.147", "0.9456326"},
                                                 {1.5, "378280.176", "0.8801746"},
                                                 {2.0, "646744.660", "0.7980775"}}) {
    const BarState bar = neo_hookean_bar(1e6, 0.3, stretch);
    const std::string of = "neo-Hookean bar, 1e6 Pa, nu .3, stretch " + number(stretch) + ": ";
    rows.push_back({"neo_hookean_bar", of + "nominal stress", "Pa", bar.stress, stress, std::nullopt});
    rows.push_back({"neo_hookean_bar", of + "lateral stretch", "1", bar.lateral, lateral, std::nullopt});
  }
}

void hanging_bars(Rows& rows) {
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
}

/// The bar of n elements by its matrices: stiffness n E A/L, c = L = 1, the bar's mass 1.
double loaded_bar_by_matrices(double ratio, int n) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), mass = stiffness;
  for (int i = 0; i < n; ++i) {
    stiffness(i, i) = i == n - 1 ? n : 2 * n;
    if (i > 0) stiffness(i, i - 1) = stiffness(i - 1, i) = -n;
    mass(i, i) = i == n - 1 ? 1 / ratio + 0.5 / n : 1.0 / n;
  }
  return std::sqrt(generalised_eigenvalues(stiffness, mass)(0)) / (2 * pi);
}

void loaded_bars(Rows& rows) {
  struct Case {
    double ratio;
    const char *root, *one, *eight;  // x, frequencies of so many elements
  };
  for (const auto& [ratio, root, one, eight] :
       {Case{0.2, "0.4328", "0.067863896", "0.068872477"}, Case{1, "0.8603", "0.12994947", "0.13681228"},
        Case{10, "1.4289", "0.20546815", "0.22705569"}}) {
    // With a wave speed of 2 pi the frequency is the root.
    const LoadedBar bar{1, 2 * pi, ratio};
    const auto beyond = [ratio = ratio](double x) { return x * std::tan(x) - ratio; };
    rows.push_back({"loaded_bar", "bar " + number(ratio) + " times as heavy as the mass at its end: x", "1",
                    loaded_bar_frequency(bar), root, find_root(beyond, 0.1, 1.5)});
    for (const auto& [n, stated] : {std::pair{1, one}, {8, eight}})
      rows.push_back({"loaded_bar", "the same of " + number(n) + " elements, c = L = 1: frequency", "Hz",
                      loaded_bar_frequency_of_elements({1, 1, ratio}, n), stated,
                      loaded_bar_by_matrices(ratio, n)});
  }
  const auto slope = [](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) { out = -y; };
  rows.push_back({"loaded_bar",
                  "mass as heavy as the bar, struck: share of its speed as the wave is at the other end", "1",
                  struck_mass_speed({1, 1, 1}, 1), "0.367879441",
                  solve_ode(slope, Eigen::VectorXd::Ones(1), {1}).states.back()(0)});
}

/// The elastica's tip by shooting from the clamp, theta'' = -load cos(theta).
TipPlace elastica_by_ode(double load) {
  const auto slope = [load](double, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    out << y(1), -load * std::cos(y(0)), std::sin(y(0)), std::cos(y(0));
  };
  const auto end = [&](double bent) {
    return solve_ode(slope, Eigen::Vector4d(0, bent, 0, 0), {1}).states.back();
  };
  const Eigen::VectorXd tip =
      end(find_root([&](double bent) { return end(bent)(1); }, 0.5 * load / (1 + load), load));
  return {tip(2), 1 - tip(3), tip(0)};
}

void large_deflections(Rows& rows) {
  struct Case {
    double load;
    const char *drop, *shortening;
  };
  for (const Case& c : {Case{0.25, "0.08274592", "0.00411782"}, Case{0.5, "0.16214358", "0.01591896"},
                        Case{1, "0.30172077", "0.05643324"}, Case{2, "0.49345748", "0.16064172"},
                        Case{5, "0.71379152", "0.38762836"}, Case{10, "0.81060902", "0.55499560"}}) {
    const TipPlace tip = elastica(c.load), shot = elastica_by_ode(c.load);
    const std::string of = "elastica under P L^2/(E I) = " + number(c.load) + ": ";
    rows.push_back({"elastica", of + "drop", "1", tip.drop, c.drop, shot.drop});
    rows.push_back({"elastica", of + "shortening", "1", tip.shortening, c.shortening, shot.shortening});
  }
  rows.push_back(
      {"elastica", "its angle under 1", "rad", elastica(1).angle, "0.46135195", elastica_by_ode(1).angle});
  const double stiffness = 1e7 * std::pow(0.1, 4) / 12;  // N m^2
  rows.push_back({"buckling", "column of 1 x .1 x .1 m, 1e7 Pa, clamped and free: Euler's load", "N",
                  euler_load(false) * stiffness, "205.616758", std::nullopt});
  rows.push_back(
      {"buckling", "the same, pinned", "N", euler_load(true) * stiffness, "822.467033", std::nullopt});
  rows.push_back({"buckling", "clamped column under its weight: rho A g L^3/(E I)", "1", greenhill_load(),
                  "7.83734744", std::nullopt});
  for (const auto& [depth, stated] : {std::pair{1e-3, "14.6520147"}, {5e-3, "163.814504"}})
    rows.push_back({"hertz", "sphere of .1 m, 1e6 Pa, nu .3, pressed " + number(depth) + " m: force", "N",
                    hertz_force(1e6, 0.3, 0.1, depth), stated, std::nullopt});
  // Hertz's pressure 3 F/(2 pi a^2) sqrt(1 - r^2/a^2), a^2 = R d, sinks its middle by d as point loads do.
  const double pressed = 1e-3, a = std::sqrt(0.1 * pressed), force = hertz_force(1e6, 0.3, 0.1, pressed);
  const auto sunk = [&](double r) {
    return 3 * force / (a * a) * std::sqrt(1 - r * r / (a * a)) * r *
           point_load_displacement(1e6, 0.3, 1, 0, r).inwards;
  };
  rows.push_back({"hertz", "the same, 0.001 m: depth of the middle under its pressure", "m", pressed, "0.001",
                  integrate(sunk, 0, a)});
  for (const auto& [r, stated] : {std::pair{1.0, "8.0e-4"}, {2.0, "3.0e-4"}})
    rows.push_back({"thick_sphere",
                    "sphere of 1 to 2 m, 1e6 Pa, nu .3, 1e3 Pa within: displacement at " + number(r) + " m",
                    "m", thick_sphere_displacement({1e6, 0.3, 1, 2}, 1e3, r), stated, std::nullopt});
  rows.push_back({"torsion", "bar of .1 x .1 m, 1 m, 1e7 Pa, nu .3 under .1 N m: angle", "rad",
                  square_bar_twist(1, 0.1, 1e7 / 2.6, 0.1), "0.001849520", std::nullopt});
}

}  // namespace

void solids(Rows& rows) {
  beams(rows);
  large_deflections(rows);
  kirchhoff(rows);
  neo_hookean(rows);
  hanging_bars(rows);
  loaded_bars(rows);
  rows.push_back({"manufactured_cube",
                  "manufactured cube: energy",
                  "J",
                  manufactured_energy({1e6, 0.3}),
                  "39146.26746",
                  {}});
}

}  // namespace pbd::reference::known
