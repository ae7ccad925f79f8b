#include "collision/mesh_place.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "collision/tolerances.h"

namespace pbd {
namespace {

AxisBox cube_about(const Vec3& x, double reach) {
  return {x.array() - reach, x.array() + reach};
}

/// Barycentric coordinates of the point of a triangle nearest to x (ericson2005collision, 5.1.5).
Vec3 barycentric(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax), d3 = ab.dot(bx), d4 = ac.dot(bx), d5 = ab.dot(cx),
               d6 = ac.dot(cx);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double of_a = d3 * d6 - d5 * d4, along = d4 - d3, back = d5 - d6;
  if (of_a <= 0 && along >= 0 && back >= 0) return {0, 1 - along / (along + back), along / (along + back)};
  return Vec3(of_a, of_b, of_c) / (of_a + of_b + of_c);
}

}  // namespace

Vec3 direction(const ClosedMesh& mesh, const MeshPlace& place, const Vec3& x) {
  const bool apart = std::abs(place.distance) > rounding * mesh.size;
  return apart ? Vec3((x - place.nearest) / place.distance) : place.normal.normalized();
}

MeshPlace nearest_of_triangle(const ClosedMesh& mesh, int triangle, const Vec3& x) {
  const auto& face = mesh.solid.faces[triangle];
  std::array<int, 3> node{};
  std::array<Vec3, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    node[k] = mesh.solid.corners[face.first + k];
    corner[k] = mesh.surface.x.col(node[k]);
  }
  const Vec3 weight = barycentric(corner[0], corner[1], corner[2], x);
  MeshPlace place{MeshPlace::Feature::face, triangle, Vec3::Zero(), face.normal, 0};
  int zeros = 0, zero = 0, one = 0;
  for (int k = 0; k < 3; ++k) {
    place.nearest += weight[k] * corner[k];
    if (weight[k] == 0) {
      ++zeros;
      zero = k;
    } else {
      one = k;
    }
  }
  if (zeros == 2) {
    place.feature = MeshPlace::Feature::node;
    place.i = node[one];
    place.normal = mesh.node_normals.col(place.i);
  } else if (zeros == 1) {
    place.feature = MeshPlace::Feature::edge;
    place.i = mesh.solid.sides[face.first + (zero + 1) % 3];
    const auto& two = mesh.solid.edges[place.i].face;
    place.normal = mesh.solid.faces[two[0]].normal + mesh.solid.faces[two[1]].normal;
  }
  const Vec3 apart = x - place.nearest;
  place.distance = std::copysign(apart.norm(), apart.dot(place.normal));
  return place;
}

bool nearest_of_mesh(const ClosedMesh& mesh, const Vec3& x, double limit, MeshPlace& place) {
  constexpr double begin = 1.0 / 16;  // of the limit: most queries end far below it
  const double most = mesh.box.contains(x) ? mesh.size : limit;
  bool found = false;
  for (double reach = begin * limit;; reach = std::min(2 * reach + rounding * most, most)) {
    AxisBox cube = cube_about(x, reach);
    mesh.tree.find(cube, [&](int triangle) {
      const MeshPlace at = nearest_of_triangle(mesh, triangle, x);
      if (std::abs(at.distance) > reach || (found && std::abs(at.distance) >= std::abs(place.distance)))
        return;
      place = at;
      found = true;
      cube = cube_about(x, (1 + rounding) * std::abs(at.distance));
    });
    if (found || reach >= most) return found && place.distance <= limit;
  }
}

void minima_of_mesh(const ClosedMesh& mesh, const Vec3& x, double limit, MeshMinima& minima) {
  std::vector<MeshPlace>&found = minima.found, &near = minima.near;
  std::vector<int>& seen = minima.seen;
  const std::size_t edges = mesh.solid.edges.size();
  found.clear();
  near.clear();
  seen.resize(std::max(seen.size(), edges + mesh.node_normals.cols()));
  const auto seen_of = [&](const MeshPlace& at) -> int& {
    return seen[(at.feature == MeshPlace::Feature::edge ? 0 : edges) + static_cast<std::size_t>(at.i)];
  };
  mesh.tree.find(cube_about(x, limit), [&](int triangle) {
    const MeshPlace at = nearest_of_triangle(mesh, triangle, x);
    if (at.distance > limit || !(at.distance > 0)) return;
    if (at.feature == MeshPlace::Feature::face)
      found.push_back(at);
    else if (seen_of(at)++ == 0)
      near.push_back(at);
  });
  // An edge or a node: where all triangles about it have it as their nearest point.
  for (const MeshPlace& at : near) {
    // It has as many triangles as edges.
    const std::size_t about = at.feature == MeshPlace::Feature::node ? mesh.neighbours(at.i).size() : 2;
    if (static_cast<std::size_t>(std::exchange(seen_of(at), 0)) == about) found.push_back(at);
  }
}

}  // namespace pbd
