// A rigid mass at the end of a bar of tetrahedra that does not thin, so that the bar moves as one of its
// bricks' elements along a line.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "closed_form_solids.h"
#include "ledger/families.h"
#include "ledger/solids.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

// 1 x 0.1 x 0.1 m along x, held at x = 0: 10 kg, waves of 10 m/s.
constexpr double loaded_area = 0.01, loaded_density = 1000, loaded_young = 1e5, loaded_bar_mass = 10,
                 loaded_wave_speed = 10;

/// The mass, body 0, does not turn: the mesh is not symmetric, and bends the bar where its end may.
Scene loaded_bar(int cells, double ratio) {
  Scene scene;
  const Vec3 middle(1, 0.05, 0.05);
  add_body(scene, middle, loaded_bar_mass / ratio, Vec3::Constant(infinity));
  const TetMesh mesh = kuhn_grid({cells, 1, 1}, Vec3(1, 0.1, 0.1));
  const int first = add_solid(scene, mesh, loaded_density, {loaded_young, 0}, Strain::linear);
  clamp_smallest_x(scene);
  Attachment held;
  for (int node = first; node < scene.nodes(); ++node) {
    const Vec3 x = scene.initial.x.col(node);
    if (x.x() < 1 - 1e-9) continue;
    held.body.push_back(0);
    held.node.push_back(node);
    held.point.emplace_back(x - middle);
    held.compliance.push_back(0);
  }
  scene.effects.emplace_back(std::move(held));
  return scene;
}

double mass_displacement(const State& state) {
  return state.x(0, 0) - 1;
}

constexpr double loaded_h = 0.1;  // s
constexpr int settling = 16;

double loaded_frequency(const Method& method, int cells, double ratio) {
  Scene scene = loaded_bar(cells, ratio);
  for (int node = 0; node < scene.nodes(); ++node) scene.initial.x(0, node) *= 1.5;
  return slowest_frequency(scene, method, loaded_h, settling, mass_displacement);
}

void loaded_rest_row(Ledger& rows) {
  constexpr int cells = 4;
  rows.push_back(
      {.id = "mass_on_bar.hung",
       .statement = "a bar lengthens under its weight and that of the mass at its end",
       .quantity = "displacement of the mass",
       .unit = "m",
       .formula = "g L (M + m/2)/(E A)",
       .source = "hughes2000finite",
       .scene = "50 kg on a bar of 1 m, 10 kg, 1e5 Pa, nu = 0, 4 x 1 x 1 bricks, linear",
       .method = direct_method(),
       .bound = {.relative = 1e-9, .derivation = "linear elements are exact at nodes in 1D; tolerance"},
       .expected = [] { return gravity * (50 + loaded_bar_mass / 2) / (loaded_young * loaded_area); },
       .run =
           [](const Method& method) {
             Scene scene = loaded_bar(cells, 0.2);
             scene.effects.emplace_back(Gravity{Vec3(gravity, 0, 0)});
             constexpr double rest_h = 0.3;  // s: 1e-12 of g h^2, what a step may miss, counts as rest
             return mass_displacement(equilibrium(scene, method, rest_h));
           }});
}

void loaded_mode_rows(Ledger& rows) {
  constexpr int cells = 4;
  for (const double ratio : {0.2, 1.0, 10.0}) {
    const reference::LoadedBar bar{1, loaded_wave_speed, ratio};
    const LedgerRow row{
        .quantity = "lowest frequency along the bar", .unit = "Hz", .method = direct_method()};
    LedgerRow mesh = row, theory = row;
    mesh.id = fmt::format("mass_on_bar.mesh_{:g}", ratio);
    mesh.statement = "a mass at the end of a bar swings as the bar's elements say";
    mesh.formula = "n c sin(x/(2 n))/(pi L), tan(x) tan(x/(2 n)) = m/(2 n M)";
    mesh.scene =
        fmt::format("bar {:g} times as heavy as the mass, 4 x 1 x 1 bricks, nu = 0, h = 0.1 s", ratio);
    // Where the bar is ten times as heavy, a step leaves 1/1.7 of the slowest mode and 1/4.2 of the next one.
    mesh.bound = {.relative = std::pow(2.4, -settling),
                  .derivation = "implicit Euler's phase undone; other modes fall 2.4 times as fast a step"};
    mesh.expected = [bar] { return reference::loaded_bar_frequency_of_elements(bar, cells); };
    mesh.run = [ratio](const Method& method) { return loaded_frequency(method, cells, ratio); };
    theory.id = fmt::format("mass_on_bar.mode_{:g}", ratio);
    theory.statement = "and finer meshes approach the continuum's frequency";
    theory.formula = "c x/(2 pi L), x tan(x) = m/M";
    theory.scene =
        fmt::format("bar {:g} times as heavy as the mass, 4 and 8 x 1 x 1 bricks, nu = 0, h = 0.1 s", ratio);
    const double x = 2 * std::numbers::pi * reference::loaded_bar_frequency(bar) / loaded_wave_speed;
    theory.bound = {.relative = std::pow(x / (2 * cells), 4),
                    .derivation = "order 2 in x/(2 n), 4 and 8 bricks extrapolated: its fourth power"};
    theory.expected = [bar] { return reference::loaded_bar_frequency(bar); };
    theory.run = [ratio](const Method& method) {
      return extrapolated(
          [&](double width) {
            return loaded_frequency(method, static_cast<int>(std::lround(1 / width)), ratio);
          },
          1.0 / cells, 2);
    };
    rows.push_back(std::move(mesh));
    rows.push_back(std::move(theory));
  }
}

/// Of a mass that is struck along the bar at rest, over its speed then, as the wave is at the other end.
double speed_left(const Method& method, int cells, double ratio) {
  Scene scene = loaded_bar(cells, ratio);
  for (int node = 0; node < scene.nodes(); ++node)
    if (scene.initial.x(0, node) > 1 - 1e-9) scene.initial.v(0, node) = 1;
  // A wave passes a brick in a step.
  return state_after(scene, method, 1 / (cells * loaded_wave_speed), cells).v(0, 0);
}

void struck_rows(Ledger& rows) {
  constexpr int cells = 16;
  Method method = direct_method("newmark");
  method.alpha = 0.5;
  for (const double ratio : {0.2, 1.0}) {
    const reference::LoadedBar bar{1, loaded_wave_speed, ratio};
    rows.push_back(
        {.id = fmt::format("mass_on_bar.struck_{:g}", ratio),
         .statement = "a mass that is struck along a bar hands its momentum on by a wave",
         .quantity = "speed over that at first, as the wave is at the other end",
         .unit = "1",
         .formula = "exp(-m c t/(M L))",
         .scene = fmt::format("bar {:g} times as heavy as the mass, 16 and 32 x 1 x 1 bricks, nu = 0", ratio),
         .method = method,
         .bound = {.relative = std::pow(ratio / cells, 2),
                   .derivation = "order 1 in a brick's mass over M, 16 and 32 extrapolated: its square"},
         .expected = [bar] { return reference::struck_mass_speed(bar, bar.length / bar.wave_speed); },
         .run =
             [ratio](const Method& by) {
               return extrapolated(
                   [&](double width) {
                     return speed_left(by, static_cast<int>(std::lround(1 / width)), ratio);
                   },
                   1.0 / cells, 1);
             }});
  }
}

}  // namespace

void loaded_bars(Ledger& rows) {
  loaded_rest_row(rows);
  loaded_mode_rows(rows);
  struck_rows(rows);
}

}  // namespace pbdcheck::ledger
