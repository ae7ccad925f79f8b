// Bars and beams of tetrahedra: what they are on their mesh, and what of beam theory that leaves.
#include <cmath>

#include <fmt/format.h>

#include "closed_form.h"
#include "ledger/families.h"
#include "ledger/solids.h"
#include "linear_fem.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

// ---- bars of no lateral strain, 1 x 0.1 x 0.1 m, 1000 kg/m^3, along x, held at x = 0

constexpr double density = 1000;

TetMesh bar_mesh(int cells) {
  return kuhn_grid({cells, 1, 1}, Vec3(1, 0.1, 0.1));
}

Scene bar(int cells, double young, Strain strain) {
  Scene scene;
  add_solid(scene, bar_mesh(cells), density, {young, 0}, strain);
  clamp_smallest_x(scene);
  return scene;
}

bool at_end(const Vec3& x) {
  return x.x() > 1 - 1e-9;
}

/// Mean displacement of the end face along x, by the shares of its area.
double end_displacement(const State& state, int cells) {
  const TetMesh mesh = bar_mesh(cells);
  const Points share = reference::face_loads(mesh, at_end, Vec3(1 / 0.01, 0, 0));
  return share.cwiseProduct(state.x - mesh.x).sum();
}

void hanging_rows(Ledger& rows) {
  constexpr int cells = 16;
  const auto hung = [](const Method& method, int count, double young, Strain strain) {
    Scene scene = bar(count, young, strain);
    scene.effects.emplace_back(Gravity{Vec3(gravity, 0, 0)});
    return end_displacement(equilibrium(scene, method, static_step), count);
  };
  rows.push_back(
      {.id = "bar.hanging_linear",
       .statement = "a hung bar of linear elements lengthens as the continuum",
       .quantity = "mean displacement of the end",
       .unit = "m",
       .formula = "rho g L^2/(2 E)",
       .source = "hughes2000finite",
       .scene = "bar of 1 m, 1000 kg/m^3, 1e5 Pa, nu = 0, 16 x 1 x 1 bricks, linear",
       .method = direct_method(),
       .bound = {.relative = 1e-9, .derivation = "linear elements are exact at nodes in 1D; tolerance"},
       .expected = [] { return reference::hanging_bar(1, density, gravity, 1e5); },
       .run = [hung](const Method& method) { return hung(method, cells, 1e5, Strain::linear); }});
  for (const double young : {1e5, 5e4, 2e4})
    rows.push_back(
        {.id = fmt::format("bar.hanging_kirchhoff_{:g}", young),
         .statement = "and one of St Venant-Kirchhoff's material less than that",
         .quantity = "mean displacement of the end",
         .unit = "m",
         .formula = "integral of l - 1, E l (l^2 - 1)/2 = rho g (L - x)",
         .source = "bathe2014finite",
         .scene =
             fmt::format("bar of 1 m, 1000 kg/m^3, {:g} Pa, nu = 0, 16 and 32 x 1 x 1 bricks, green", young),
         .method = direct_method(),
         .bound = {.relative = 1.0 / (cells * cells * cells),
                   .derivation = "order 2 in the mesh, 16 and 32 bricks extrapolated: 1/16^3"},
         .expected = [young] { return reference::hanging_bar_kirchhoff(1, density, gravity, young); },
         .run =
             [=](const Method& method) {
               return extrapolated(
                   [&](double width) {
                     return hung(method, static_cast<int>(std::lround(1 / width)), young, Strain::green);
                   },
                   1.0 / cells, 2);
             }});
}

/// Centrifugal forces m w^2 r along x at the places of a state.
ExternalForce centrifugal(const Scene& scene, const State& state, double rate) {
  Points force = Points::Zero(3, scene.nodes());
  for (int node = 0; node < scene.nodes(); ++node) {
    const double mass = scene.mass[static_cast<std::size_t>(node)];
    if (std::isfinite(mass)) force(0, node) = mass * rate * rate * state.x(0, node);
  }
  return nodal_force(force);
}

void spinning_rows(Ledger& rows) {
  constexpr int cells = 16;
  constexpr double rate = 5, young = 1e6;
  const LedgerRow row{.quantity = "mean displacement of the end",
                      .unit = "m",
                      .source = "hughes2000finite",
                      .scene = "bar of 1 m, 1000 kg/m^3, 1e6 Pa, nu = 0, 16 x 1 x 1 bricks, 5 rad/s, linear",
                      .method = direct_method()};
  LedgerRow at_rest = row, displaced = row;
  at_rest.id = "bar.spinning";
  at_rest.statement = "a bar that spins about its end lengthens under the load at rest places";
  at_rest.formula = "rho w^2 L^3/(3 E) (1 + 1/(2 n^2))";
  at_rest.bound = {.relative = 1e-9, .derivation = "exact with lumped loads on n bricks; tolerance"};
  at_rest.expected = [] { return density * rate * rate / (3 * young) * (1 + 0.5 / (cells * cells)); };
  at_rest.run = [](const Method& method) {
    Scene scene = bar(cells, young, Strain::linear);
    scene.effects.emplace_back(centrifugal(scene, scene.initial, rate));
    return end_displacement(equilibrium(scene, method, static_step), cells);
  };
  displaced.id = "bar.spinning_displaced";
  displaced.statement = "and farther under that at the displaced ones";
  displaced.formula = "tan(k L)/k - L, k^2 = rho w^2/E";
  displaced.bound = {.relative = 1.0 / (cells * cells), .derivation = "order 2 in the mesh: 1/16^2"};
  displaced.expected = [] {
    const double k = std::sqrt(density / young) * rate;
    return std::tan(k) / k - 1;
  };
  displaced.run = [](const Method& method) {
    Scene scene = bar(cells, young, Strain::linear);
    scene.effects.emplace_back(centrifugal(scene, scene.initial, rate));
    Motion motion(scene, method);
    constexpr int rounds = 8;  // each takes (k L)^2 = 1/40 of what is left
    for (int k = 0; k < rounds; ++k) {
      motion.workspace.change(1, centrifugal(scene, motion.state, rate));
      motion.advance(static_step, 2);
    }
    return end_displacement(motion.state, cells);
  };
  rows.push_back(std::move(at_rest));
  rows.push_back(std::move(displaced));
}

}  // namespace

void bars(Ledger& rows) {
  hanging_rows(rows);
  spinning_rows(rows);
}

}  // namespace pbdcheck::ledger
