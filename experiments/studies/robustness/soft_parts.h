// Soft parts of hard cases of contact.
#pragma once

#include "boundary.h"
#include "scenes/contacts.h"

namespace pbdcheck {

/// A solid of 1000 kg/m^3 unless told, Poisson's ratio 0.3; returns its first node.
inline int add_soft(pbd::Scene& scene, const pbd::TetMesh& mesh, double young, double density = 1000) {
  return add_touching_solid(scene, mesh, density, {young, 0.3}, pbd::Strain::corotational);
}

/// A box's mesh about the vertical through `base`, the middle of its lower face.
inline pbd::TetMesh mat(const std::array<int, 3>& cells, const pbd::Vec3& size, const pbd::Vec3& base) {
  return pbd::kuhn_grid(cells, size, base - pbd::Vec3(size.x() / 2, size.y() / 2, 0));
}

/// Cloth of links (m/N) whose triangles touch; returns its first node.
inline int add_touching_cloth(pbd::Scene& scene, const pbd::TriangleMesh& mesh, double area_density,
                              double compliance) {
  const int first = add_sheet_nodes(scene, mesh, area_density);
  for (pbd::Effect& effect : scene.effects)
    if (auto* contact = std::get_if<pbd::Contact>(&effect))
      for (const auto& [a, b, c] : mesh.triangles)
        contact->triangle.push_back({first + a, first + b, first + c});
  scene.effects.emplace_back(sheet_links(mesh, first, compliance));
  return first;
}

/// A square of such cloth about the origin, held at its corners.
inline void add_held_cloth(pbd::Scene& scene, int cells, double side, double area_density,
                           double compliance) {
  const pbd::Vec3 corner(-side / 2, -side / 2, 0);
  const int first = add_touching_cloth(scene, pbd::grid_sheet({cells, cells}, {side, side}, corner),
                                       area_density, compliance);
  const int across = cells * (cells + 1);  // from the first edge's nodes to the last one's
  for (const int held : {0, cells, across, across + cells})
    scene.mass[static_cast<std::size_t>(first + held)] = pbd::infinity;
}

/// A ball of `radius` about `centre`: a cube's mesh, each of whose cubes about its centre becomes a sphere.
inline pbd::TetMesh soft_ball(int cells, double radius, const pbd::Vec3& centre) {
  pbd::TetMesh mesh = pbd::kuhn_grid({cells, cells, cells}, pbd::Vec3::Constant(2), -pbd::Vec3::Ones());
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) {
    const double length = mesh.x.col(i).norm(), side = mesh.x.col(i).cwiseAbs().maxCoeff();
    if (length > 0) mesh.x.col(i) *= side / length;
  }
  mesh.x = (radius * mesh.x).colwise() + centre;
  return mesh;
}

/// What surfaces are apart from what is not soft where they touch it, m.
inline constexpr double half_thickness = pbd::Contact{}.thickness / 2;

}  // namespace pbdcheck
