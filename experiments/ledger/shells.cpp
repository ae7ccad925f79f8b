// Thick spheres under pressure within: Lame's solution.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "closed_form_solids.h"
#include "ledger/families.h"
#include "ledger/solids.h"

namespace pbdcheck::ledger {
namespace {

using namespace pbd;

constexpr double inner = 1, outer = 2, pressure = 1e3;  // m, Pa
constexpr Material wall{1e6, 0.3};

/// Unit sphere: the surface of a cube of `cells`^3 cells, its squares cut in two, pushed outwards.
TriangleMesh sphere_surface(int cells) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> nodes;
  const auto node = [&](const std::array<int, 3>& at) {
    const auto [found, added] = nodes.try_emplace(at, static_cast<int>(nodes.size()));
    if (added) {
      mesh.x.conservativeResize(3, found->second + 1);
      mesh.x.col(found->second) = (2 * Vec3(at[0], at[1], at[2]) - Vec3::Constant(cells)).normalized();
    }
    return found->second;
  };
  for (const std::size_t axis : {0, 1, 2})
    for (const int side : {0, cells})
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          const auto corner = [&](int right, int up) {
            std::array<int, 3> at{};
            at[axis] = side, at[(axis + 1) % 3] = i + right, at[(axis + 2) % 3] = j + up;
            return node(at);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          for (const auto& each : {std::array{a, b, c}, {a, c, d}})
            mesh.triangles.push_back(side > 0 ? each : std::array{each[0], each[2], each[1]});
        }
  return mesh;
}

/// Layers of prisms between the spheres, each cut into three tetrahedra by the order of its surface nodes, so
/// that neighbours agree. Node of surface node i and layer j: i + j nodes of the surface.
TetMesh shell(const TriangleMesh& surface, int layers) {
  const auto count = static_cast<int>(surface.x.cols());
  TetMesh mesh;
  mesh.x.resize(3, count * (layers + 1));
  for (int j = 0; j <= layers; ++j)
    mesh.x.middleCols(j * count, count) = (inner + (outer - inner) * j / layers) * surface.x;
  for (auto corners : surface.triangles) {
    std::sort(corners.begin(), corners.end());
    const auto& [a, b, c] = corners;
    for (int j = 0; j < layers; ++j) {
      const int low = j * count, high = low + count;
      for (std::array<int, 4> tet : {std::array{a + low, b + low, c + low, c + high},
                                     {a + low, b + low, b + high, c + high},
                                     {a + low, a + high, b + high, c + high}}) {
        Eigen::Matrix<double, 3, 4> rest;
        for (int k = 0; k < 4; ++k) rest.col(k) = mesh.x.col(tet[static_cast<std::size_t>(k)]);
        if (tet_volume(rest) < 0) std::swap(tet[0], tet[1]);
        mesh.tets.push_back(tet);
      }
    }
  }
  return mesh;
}

/// Mean displacement outwards of the inner or outer surface.
double widening(const Method& method, int cells, bool within) {
  const TriangleMesh surface = sphere_surface(cells);
  const int layers = cells, count = static_cast<int>(surface.x.cols());
  const TetMesh mesh = shell(surface, layers);
  Scene scene;
  add_solid(scene, mesh, 1000, wall, Strain::linear);
  Points push = Points::Zero(3, scene.nodes());
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 area = Vec3(mesh.x.col(b) - mesh.x.col(a)).cross(Vec3(mesh.x.col(c) - mesh.x.col(a))) / 2;
    for (const int node : {a, b, c}) push.col(node) += pressure / 3 * area;
  }
  scene.effects.emplace_back(nodal_force(push));
  const State rest = equilibrium(scene, method, 10);
  const int first = within ? 0 : layers * count;
  const double radius = within ? inner : outer;
  return (rest.x.middleCols(first, count) - mesh.x.middleCols(first, count))
             .cwiseProduct(mesh.x.middleCols(first, count) / radius)
             .sum() /
         count;
}

}  // namespace

void shells(Ledger& rows) {
  constexpr int cells = 3;
  for (const bool within : {true, false})
    rows.push_back(
        {.id = fmt::format("shell.{}", within ? "inner" : "outer"),
         .statement = "ever finer tetrahedra approach a thick sphere under pressure",
         .quantity = within ? "displacement of the inner surface" : "displacement of the outer surface",
         .unit = "m",
         .formula = "p a^3 r/(E (b^3 - a^3)) (1 - 2 nu + (1 + nu) b^3/(2 r^3))",
         .source = "bathe2014finite",
         .scene = "sphere of 1 to 2 m, 1e3 Pa within, 1e6 Pa, nu = 0.3, 3 and 6 layers, linear",
         .method = direct_method(),
         .bound = {.relative = std::pow(cells, -3),
                   .derivation = "order 2 in the mesh, 3 and 6 layers extrapolated: 1/3^3"},
         .expected =
             [within] {
               return reference::thick_sphere_displacement({wall.young, wall.poisson, inner, outer}, pressure,
                                                           within ? inner : outer);
             },
         .run =
             [within](const Method& method) {
               return extrapolated(
                   [&](double layer) {
                     return widening(method, static_cast<int>(std::lround(1 / layer)), within);
                   },
                   1.0 / cells, 2);
             }});
}

}  // namespace pbdcheck::ledger
