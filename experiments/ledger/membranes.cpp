// Plane benchmarks by membranes of triangles: Cook's, NAFEMS's ellipse.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "ledger/families.h"
#include "ledger/solids.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

// ---- Cook's membrane, (0, 0) (48, 44) (48, 60) (0, 44), E = 1, nu = 1/3, a shear of 1 in all on its right

/// Rise of the middle of the loaded side under a load so small that all is linear, over the load.
double cook_rise(const Method& method, int n) {
  constexpr double load = 1e-6;
  TriangleMesh mesh = grid_sheet({n, n}, {1, 1});
  for (int node = 0; node < mesh.x.cols(); ++node) {
    const double s = mesh.x(0, node), t = mesh.x(1, node);
    mesh.x.col(node) = Vec3(48 * s, 44 * s + t * (44 - 28 * s), 0);
  }
  const auto node_at = [n](int i, int j) { return i + (n + 1) * j; };
  Scene scene;
  add_sheet_nodes(scene, mesh, 1);
  scene.effects.emplace_back(sheet_strain(mesh, 0, {1, 1.0 / 3}, 1));
  ExternalForce force;
  for (int j = 0; j <= n; ++j) {
    scene.mass[static_cast<std::size_t>(node_at(0, j))] = infinity;
    force.node.push_back(node_at(n, j));
    force.force.emplace_back(0, load / n * (j == 0 || j == n ? 0.5 : 1), 0);
  }
  scene.effects.emplace_back(std::move(force));
  const int middle = node_at(n, n / 2);
  return (equilibrium(scene, method, 1e5).x(1, middle) - mesh.x(1, middle)) / load;
}

void cook_row(Ledger& rows) {
  constexpr int n = 16;
  rows.push_back(
      {.id = "membrane.cook",
       .statement = "ever finer triangles approach Cook's membrane",
       .quantity = "rise of the middle of the loaded side over the load, times E",
       .unit = "1",
       .formula = "23.96, published for fine meshes of many elements",
       .scene = "Cook's membrane of 16 x 16 and 32 x 32 rectangles of two triangles, small load",
       .method = direct_method(),
       .bound = {.relative = 1.0 / (2 * n),
                 .derivation = "order 2 extrapolated; its obtuse corner leaves order 1 of the finer mesh"},
       .expected = [] { return 23.96; },
       .run =
           [](const Method& method) {
             return extrapolated(
                 [&](double width) { return cook_rise(method, static_cast<int>(std::lround(1 / width))); },
                 1.0 / n, 2);
           }});
}

// ---- NAFEMS LE1: an elliptic ring, half axes 2 and 1 m within, 3.25 and 2.75 m without, 210 GPa, nu = 0.3,
// pulled outwards by 10 MPa; all four quarters of it, in balance without supports

/// Stress (Pa) along the inner edge where it crosses the x axis, by the lengths of the edges there; the load
/// is a thousandth, so that all is linear, and the stress times a thousand.
double ring_stress(const Method& method, int across) {
  constexpr double young = 1e6, share = 1e-3 * young / 210e9, tension = share * 10e6;
  const int around = 16 * across;
  TriangleMesh mesh;
  mesh.x.resize(3, around * (across + 1));
  const auto node = [&](int i, int j) { return (i + around) % around + around * j; };
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around, out = static_cast<double>(j) / across;
      mesh.x.col(node(i, j)) =
          Vec3((2 + 1.25 * out) * std::cos(angle), (1 + 1.75 * out) * std::sin(angle), 0);
      if (j == across) continue;
      mesh.triangles.push_back({node(i, j), node(i, j + 1), node(i + 1, j)});
      mesh.triangles.push_back({node(i + 1, j), node(i, j + 1), node(i + 1, j + 1)});
    }
  Scene scene;
  add_sheet_nodes(scene, mesh, 1000);
  scene.effects.emplace_back(sheet_strain(mesh, 0, {young, 0.3}, 1));
  Points pull = Points::Zero(3, scene.nodes());
  for (int i = 0; i < around; ++i) {
    const int first = node(i, across), second = node(i + 1, across);
    const Vec3 normal = Vec3(mesh.x.col(second) - mesh.x.col(first)).cross(Vec3::UnitZ());
    for (const int end : {first, second}) pull.col(end) += tension / 2 * normal;
  }
  scene.effects.emplace_back(nodal_force(pull));
  const State rest = equilibrium(scene, method, 1);
  const auto length = [&](const Points& x) { return (x.col(node(1, 0)) - x.col(node(-1, 0))).norm(); };
  return young * (length(rest.x) / length(mesh.x) - 1) / share;
}

void ring_row(Ledger& rows) {
  constexpr int across = 8;
  rows.push_back(
      {.id = "membrane.nafems_le1",
       .statement = "ever finer triangles approach the peak stress of NAFEMS's elliptic membrane",
       .quantity = "stress along the inner edge at (2, 0)",
       .unit = "Pa",
       .formula = "92.7e6, NAFEMS LE1",
       .scene = "elliptic ring of 128 x 8 and 256 x 16 quadrangles of two triangles, small load",
       .method = direct_method(),
       .bound = {.relative = 1.0 / (across * across),
                 .derivation = "order 2 at the middle of two edges, 8 and 16 across extrapolated: 1/8^2"},
       .expected = [] { return 92.7e6; },
       .run =
           [](const Method& method) {
             return extrapolated(
                 [&](double width) { return ring_stress(method, static_cast<int>(std::lround(1 / width))); },
                 1.0 / across, 2);
           }});
}

}  // namespace

void membranes(Ledger& rows) {
  cook_row(rows);
  ring_row(rows);
}

}  // namespace pbdcheck::ledger
