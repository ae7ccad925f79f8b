#include "polyhedron.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "error.h"

namespace pbd {
namespace {

using Index = std::size_t;

/// Of each edge, the triangle that passes it upwards and the one that passes it downwards.
std::map<std::array<int, 2>, std::array<int, 2>> neighbours(const TriangleMesh& surface) {
  std::map<std::array<int, 2>, std::array<int, 2>> found;
  for (Index t = 0; t < surface.triangles.size(); ++t)
    for (Index a = 0; a < 3; ++a) {
      const int from = surface.triangles[t][a], to = surface.triangles[t][(a + 1) % 3];
      found[{std::min(from, to), std::max(from, to)}][from < to ? 0 : 1] = static_cast<int>(t);
    }
  return found;
}

/// Twice the vector area of a triangle.
Vec3 twice_area(const TriangleMesh& surface, Index triangle) {
  const auto& t = surface.triangles[triangle];
  const Vec3 origin = surface.x.col(t[0]);
  return (surface.x.col(t[1]) - origin).cross(surface.x.col(t[2]) - origin);
}

Polyhedron faces_of(const TriangleMesh& surface, const std::vector<int>& face_of) {
  Polyhedron solid;
  solid.x = surface.x;
  if (face_of.empty()) return solid;
  const auto count = static_cast<Index>(*std::max_element(face_of.begin(), face_of.end()) + 1);
  solid.faces.assign(count, {Vec3::Zero(), 0, 0, 0});
  for (Index t = 0; t < face_of.size(); ++t) solid.faces[face_of[t]].normal += twice_area(surface, t);
  // The sides of each face by the corner they start from, with their edge.
  std::vector<std::map<int, std::array<int, 2>>> sides(count);
  for (const auto& [node, triangle] : neighbours(surface)) {
    const std::array<int, 2> face{face_of[triangle[0]], face_of[triangle[1]]};
    if (face[0] == face[1]) continue;
    const int edge = static_cast<int>(solid.edges.size());
    solid.edges.push_back({node, face});
    sides[face[0]][node[0]] = {node[1], edge};
    sides[face[1]][node[1]] = {node[0], edge};
  }
  for (Index f = 0; f < count; ++f) {
    auto& face = solid.faces[f];
    if (face.normal.squaredNorm() > 0) face.normal.normalize();
    face.first = solid.corners.size();
    for (int at = sides[f].begin()->first; face.count < sides[f].size(); ++face.count) {
      solid.corners.push_back(at);
      face.offset += face.normal.dot(surface.x.col(at)) / static_cast<double>(sides[f].size());
      solid.sides.push_back(sides[f][at][1]);
      at = sides[f][at][0];
    }
  }
  return solid;
}

}  // namespace

void require_closed(const TriangleMesh& surface) {
  std::map<std::array<int, 2>, int> balance;
  for (const auto& triangle : surface.triangles)
    for (std::size_t a = 0; a < 3; ++a) {
      const int from = triangle[a], to = triangle[(a + 1) % 3];
      balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : 1000;
    }
  for (const auto& [edge, passed] : balance)
    if (passed != 1001)
      throw SetupError("surface",
                       "edge " + std::to_string(edge[0]) + "-" + std::to_string(edge[1]) + " of " +
                           std::to_string(passed % 1000 + passed / 1000) + " triangles",
                       "a closed surface: two triangles an edge, passing it in opposite directions");
}

Polyhedron triangle_faces(const TriangleMesh& surface) {
  require_closed(surface);
  std::vector<int> face_of(surface.triangles.size());
  std::iota(face_of.begin(), face_of.end(), 0);
  return faces_of(surface, face_of);
}

Polyhedron plane_faces(const TriangleMesh& surface) {
  require_closed(surface);
  constexpr double flat = 1e-9;
  const double size = (surface.x.rowwise().maxCoeff() - surface.x.rowwise().minCoeff()).norm();
  const auto around = neighbours(surface);
  std::vector<int> face_of(surface.triangles.size(), -1);
  int count = 0;
  // Largest triangles first: their normals are the best known.
  std::vector<Index> order(face_of.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) {
    return twice_area(surface, i).squaredNorm() > twice_area(surface, j).squaredNorm();
  });
  for (const Index seed : order) {
    if (face_of[seed] >= 0) continue;
    const Vec3 normal = twice_area(surface, seed).normalized();
    const double offset = normal.dot(surface.x.col(surface.triangles[seed][0]));
    const auto in_plane = [&](Index t) {
      for (const int node : surface.triangles[t])
        if (!(std::abs(normal.dot(surface.x.col(node)) - offset) <= flat * size)) return false;
      return normal.dot(twice_area(surface, t)) >= 0;
    };
    std::vector<Index> reached{seed};
    face_of[seed] = count;
    while (!reached.empty()) {
      const auto& t = surface.triangles[reached.back()];
      reached.pop_back();
      for (Index a = 0; a < 3; ++a) {
        const int from = t[a], to = t[(a + 1) % 3];
        const auto& two = around.at({std::min(from, to), std::max(from, to)});
        const int next = two[from < to ? 1 : 0];
        if (face_of[next] >= 0 || !in_plane(next)) continue;
        face_of[next] = count;
        reached.push_back(next);
      }
    }
    ++count;
  }
  return faces_of(surface, face_of);
}

TriangleMesh box_surface(const Vec3& size) {
  TriangleMesh mesh{Points(3, 8),
                    {{0, 2, 1},
                     {1, 2, 3},
                     {4, 5, 6},
                     {5, 7, 6},
                     {0, 1, 4},
                     {1, 5, 4},
                     {2, 6, 3},
                     {3, 6, 7},
                     {0, 4, 2},
                     {2, 4, 6},
                     {1, 3, 5},
                     {3, 7, 5}}};
  for (int corner = 0; corner < 8; ++corner)
    mesh.x.col(corner) = size.cwiseProduct(Vec3(corner & 1, corner >> 1 & 1, corner >> 2)) - size / 2;
  return mesh;
}

}  // namespace pbd
