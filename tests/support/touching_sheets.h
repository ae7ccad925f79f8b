// Deformable surfaces in the contact of a scene of bodies.
#pragma once

#include <stdexcept>

#include "mesh.h"
#include "scene.h"

namespace pbd::test {

inline constexpr double thickness = 4e-3;  // m, of surfaces

inline Contact& contact_in(Scene& scene) {
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect)) return *contact;
  throw std::logic_error("a scene without contact");
}

/// Adds a surface (kg/m^2) to a scene of bodies; of infinite mass, or with links of a compliance (m/N), which
/// are then the last effect. Returns its first node.
inline int add_surface(Scene& scene, const TriangleMesh& mesh, bool fixed, double density = 0.5,
                       double compliance = 1e-5) {
  const int first = add_sheet_nodes(scene, mesh, density);
  Contact& contact = contact_in(scene);
  contact.thickness = thickness;
  for (const auto& [a, b, c] : mesh.triangles) contact.triangle.push_back({first + a, first + b, first + c});
  if (!fixed) {
    scene.effects.emplace_back(sheet_links(mesh, first, compliance));
    return first;
  }
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) scene.mass[static_cast<std::size_t>(first + i)] = infinity;
  return first;
}

/// In the plane z = `height`, its middle above the origin; cells are as long as wide.
inline TriangleMesh sheet(int cells, double size, double height) {
  TriangleMesh mesh = grid_sheet({cells, cells}, {size, size});
  mesh.x.colwise() -= Vec3(size / 2, size / 2, -height);
  return mesh;
}

}  // namespace pbd::test
