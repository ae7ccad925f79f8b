#include "mesh.h"
#include "studies/robustness/world_building.h"

namespace pbdcheck {

using namespace pbd;

void Building::add_nodes() {
  const Vec3 corner = Vec3(0, 0, 1.8) + random_.vector(0.1);
  const int first = scene_.nodes();
  std::vector<std::array<int, 3>> triangles;
  switch (random_.below(3)) {
    case 0:
      add_cloth(grid_sheet({3, 2}, {0.6, 0.4}, corner), triangles);
      break;
    case 1: {
      const Strain strain = random_.happens(0.5) ? Strain::corotational : Strain::green;
      const double young = random_.decades(4, 7), poisson = random_.uniform(0, 0.45);
      add_solid(scene_, kuhn_grid({2, 1, 1}, {0.4, 0.2, 0.2}, corner), random_.decades(2, 4),
                {young, poisson}, strain);
      if (random_.happens(0.3))
        std::get<TetStrain>(scene_.effects.back()).damping = Material{random_.decades(1, 4), 0.3};
      break;
    }
    default:
      add_rope(corner);
  }
  const Vec3 velocity = random_.vector(random_.decades(-1, 1));
  for (int node = first; node < scene_.nodes(); ++node) scene_.initial.v.col(node) = velocity;
  if (random_.happens(0.4)) hold(first);
  if (random_.happens(0.8)) touch(first, triangles);
}

void Building::add_cloth(const TriangleMesh& mesh, std::vector<std::array<int, 3>>& triangles) {
  const int first = add_sheet_nodes(scene_, mesh, random_.decades(-2, 1));
  if (random_.happens(0.5)) {
    add(sheet_links(mesh, first, compliance(-7, -3)));
  } else {
    add(sheet_strain(mesh, first, {random_.decades(4, 8), 0.3}, 1e-3));
  }
  if (random_.happens(0.5)) add(sheet_bending(mesh, first, random_.decades(-2, 3)));
  triangles = mesh.triangles;
  for (auto& triangle : triangles)
    for (int& node : triangle) node += first;
}

void Building::add_rope(const Vec3& from) {
  Distance links;
  const double mass = random_.decades(-2, 0), given = compliance(-7, -3), time = random_.decades(-4, -1);
  const bool slow = random_.happens(0.3);
  for (int i = 0; i < 6; ++i) {
    const int node = add_node(scene_, from + Vec3(0.1 * i, 0, 0), mass);
    if (i == 0) continue;
    links.node.push_back({node - 1, node});
    links.rest_length.push_back(0.1);
    links.compliance.push_back(given);
    if (slow) links.damping.push_back(time);
  }
  add(links);
}

/// The first node, where it is or by a body.
void Building::hold(int node) {
  const Vec3 x = scene_.initial.x.col(node);
  if (random_.happens(0.5)) return add(Anchor{{node}, {x}, {compliance(-7, -3)}, damping()});
  const int body = moving();
  add(Attachment{{body}, {node}, {own_point(body, x)}, {compliance(-7, -3)}, damping()});
}

void Building::touch(int first, const std::vector<std::array<int, 3>>& triangles) {
  const double radius = random_.happens(0.3) ? 0 : random_.uniform(0.01, 0.05);
  const int given = material();
  for (int node = first; node < scene_.nodes(); ++node) {
    contact_.node.push_back(node);
    contact_.radius.push_back(radius);
    contact_.node_material.push_back(given);
  }
  if (random_.happens(0.3)) contact_.triangle = triangles;
}

}  // namespace pbdcheck
