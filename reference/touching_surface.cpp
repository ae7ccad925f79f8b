#include "touching_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace pbd::reference {
namespace {

/// Takes out the edges where nothing sticks out. They lie along every plane through them, so that they would
/// stop what goes on beside them; corners have had them as their neighbours by now.
void drop_flat(Surface& surface, const std::vector<bool>& flat) {
  if (flat.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (flat[i]) continue;
    surface.edge[kept] = surface.edge[i];
    surface.beside_edge[kept++].swap(surface.beside_edge[i]);
  }
  surface.edge.resize(kept);
  surface.beside_edge.resize(kept);
}

/// The corners beside each corner and edge, by edges and the faces next to them.
void find_neighbours(Surface& surface) {
  surface.beside_corner.resize(surface.corner.size());
  surface.beside_edge.resize(surface.edge.size());
  std::map<std::array<int, 2>, std::size_t> number;
  for (std::size_t i = 0; i < surface.edge.size(); ++i) {
    const auto [from, to] = surface.edge[i];
    number[{std::min(from, to), std::max(from, to)}] = i;
    surface.beside_corner[static_cast<std::size_t>(from)].push_back(to);
    surface.beside_corner[static_cast<std::size_t>(to)].push_back(from);
  }
  for (const auto& face : surface.face)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int from = face[k], to = face[(k + 1) % face.size()];
      const auto found = number.find({std::min(from, to), std::max(from, to)});
      if (found == number.end()) continue;
      for (const int other : face)
        if (other != from && other != to) surface.beside_edge[found->second].push_back(other);
    }
}

struct SurfaceMaker {
  const Collider& collider;
  int node;
  Surface& surface;
  std::vector<bool> flat{};  // of each edge: between triangles in one plane, where nothing sticks out

  int add(const Vec3& place) {
    surface.corner.push_back({collider.body, node, collider.frame.place(place)});
    return static_cast<int>(surface.corner.size()) - 1;
  }
  void add(const Polyhedron& solid) {
    for (const auto& x : solid.x.colwise()) add(Vec3(x));
    for (const auto& edge : solid.edges) {
      surface.edge.push_back(edge.node);
      const Vec3 &one = solid.faces[static_cast<std::size_t>(edge.face[0])].normal,
                 &other = solid.faces[static_cast<std::size_t>(edge.face[1])].normal;
      flat.push_back((one - other).norm() < in_one_plane);
    }
    for (const auto& face : solid.faces)
      if (!face.normal.isZero(0))
        surface.face.emplace_back(
            solid.corners.begin() + static_cast<std::ptrdiff_t>(face.first),
            solid.corners.begin() + static_cast<std::ptrdiff_t>(face.first + face.count));
  }

  void operator()(std::monostate) {}
  void operator()(const Sphere& sphere) {
    add(Vec3::Zero());
    surface.radius = sphere.radius;
  }
  void operator()(const Capsule& capsule) {
    surface.edge.push_back(
        {add(-capsule.length / 2 * Vec3::UnitZ()), add(capsule.length / 2 * Vec3::UnitZ())});
    surface.radius = capsule.radius;
  }
  void operator()(const Box& box) { add(plane_faces(box_surface(box.size))); }
  void operator()(const ConvexHull& hull) { add(hull.solid); }
  void operator()(const ClosedMesh& mesh) { add(mesh.solid); }
  void operator()(const HalfSpace&) {
    surface.face.push_back({add(Vec3::Zero()), add(Vec3::UnitX()), add(Vec3::UnitY())});
    surface.plane = true;
  }
  void operator()(const Cylinder& shape) {
    surface.cylinder = shape.radius;
    const double half = shape.length / 2;
    surface.edge.push_back({add(-half * Vec3::UnitZ()), add(half * Vec3::UnitZ())});
    for (const double end : {-half, half}) {
      std::vector<int>& cap = surface.face.emplace_back();
      for (int k = 0; k < rim_corners; ++k) {
        const double angle = (end < 0 ? -2 : 2) * std::numbers::pi * k / rim_corners;
        cap.push_back(add({shape.radius * std::cos(angle), shape.radius * std::sin(angle), end}));
      }
    }
  }
};

}  // namespace

Surface surface_of(const std::vector<std::array<int, 3>>& triangles, double radius, int side) {
  Surface surface;
  surface.side = side;
  surface.radius = radius;
  surface.deformable = true;
  std::map<int, int> number;
  std::set<std::array<int, 2>> edges;
  for (const auto& triangle : triangles) {
    std::vector<int>& face = surface.face.emplace_back();
    for (const int node : triangle) {
      const auto [place, is_new] = number.try_emplace(node, static_cast<int>(surface.corner.size()));
      if (is_new) surface.corner.push_back({-1, node});
      face.push_back(place->second);
    }
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert({std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3])});
  }
  surface.edge.assign(edges.begin(), edges.end());
  find_neighbours(surface);
  return surface;
}

std::vector<Surface> surfaces_of(const Scene& scene, const Contact& contact) {
  std::vector<Surface> surfaces;
  const auto next = [&] { return static_cast<int>(surfaces.size()); };
  for (const Collider& collider : contact.collider) {
    Surface surface;
    surface.side = next();
    SurfaceMaker maker{collider, scene.bodies[static_cast<std::size_t>(collider.body)].node, surface};
    std::visit(maker, collider.shape);
    find_neighbours(surface);
    drop_flat(surface, maker.flat);
    surfaces.push_back(std::move(surface));
  }
  for (std::size_t i = 0; i < contact.node.size(); ++i) {
    Surface surface;
    surface.side = next();
    surface.radius = contact.radius[i];
    surface.corner.push_back({-1, contact.node[i]});
    find_neighbours(surface);
    surfaces.push_back(std::move(surface));
  }
  const std::size_t before = surfaces.size();
  for (int material = 0; material < contact.materials; ++material) {
    std::vector<std::array<int, 3>> own;
    int side = 0;
    for (std::size_t i = 0; i < contact.triangle.size(); ++i) {
      if (contact.material(before + i) != material) continue;
      if (own.empty()) side = static_cast<int>(before + i);
      own.push_back(contact.triangle[i]);
    }
    if (!own.empty()) surfaces.push_back(surface_of(own, contact.thickness / 2, side));
  }
  return surfaces;
}

}  // namespace pbd::reference
