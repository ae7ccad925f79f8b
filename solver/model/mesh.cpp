#include "mesh.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "error.h"
#include "validate.h"

namespace pbd {
namespace {

using Edge = std::array<int, 2>;

template <std::size_t K>
std::vector<Edge> edges_of(const std::vector<std::array<int, K>>& elements) {
  std::vector<Edge> found;
  for (const auto& element : elements)
    for (std::size_t a = 0; a < K; ++a)
      for (std::size_t b = a + 1; b < K; ++b)
        found.push_back({std::min(element[a], element[b]), std::max(element[a], element[b])});
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

template <std::size_t K>
Eigen::Matrix<double, 3, K> columns(const Points& x, const std::array<int, K>& node) {
  Eigen::Matrix<double, 3, K> picked;
  for (std::size_t a = 0; a < K; ++a) picked.col(a) = x.col(node[a]);
  return picked;
}

template <std::size_t K>
std::array<int, K> shifted(std::array<int, K> node, int first) {
  for (int& index : node) index += first;
  return node;
}

int append_nodes(Scene& scene, const Points& x, const std::vector<double>& mass) {
  const int first = scene.nodes();
  const auto count = first + x.cols();
  scene.mass.insert(scene.mass.end(), mass.begin(), mass.end());
  scene.initial.x.conservativeResize(3, count);
  scene.initial.v.conservativeResize(3, count);
  scene.initial.x.rightCols(x.cols()) = x;
  scene.initial.v.rightCols(x.cols()).setZero();
  return first;
}

/// A triangle at an edge: its index, its third node, and whether it passes the edge from the smaller node up.
struct Wing {
  std::size_t triangle;
  int opposite;
  bool along;
};

void require_hinge(const Edge& edge, const std::vector<Wing>& wings) {
  if (wings.size() < 2 || (wings.size() == 2 && wings[0].along != wings[1].along)) return;
  std::string where = "triangles";
  for (const auto& wing : wings) where += " " + std::to_string(wing.triangle);
  const std::string at = " the edge of nodes " + std::to_string(edge[0]) + " and " + std::to_string(edge[1]);
  if (wings.size() > 2) throw SetupError(where, "all at" + at, "at most two triangles at an edge");
  throw SetupError(where, "the same direction along" + at,
                   "opposite ones: neighbours with their nodes in the same sense of rotation");
}

}  // namespace

TetMesh kuhn_grid(const std::array<int, 3>& cells, const Vec3& size, const Vec3& origin) {
  const auto index = [&](int i, int j, int k) { return i + (cells[0] + 1) * (j + (cells[1] + 1) * k); };
  TetMesh mesh;
  mesh.x.resize(3, (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1));
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i)
        mesh.x.col(index(i, j, k)) =
            origin +
            size.cwiseProduct(Vec3(double(i) / cells[0], double(j) / cells[1], double(k) / cells[2]));

  // The six monotone paths from corner (0,0,0) to (1,1,1); odd permutations swap two nodes to keep volumes
  // positive.
  static constexpr std::array<std::array<int, 3>, 6> axes{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        for (std::size_t path = 0; path < axes.size(); ++path) {
          std::array<int, 3> corner{i, j, k};
          std::array<int, 4> tet{index(i, j, k), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++corner[axes[path][step]];
            tet[step + 1] = index(corner[0], corner[1], corner[2]);
          }
          if (path >= 3) std::swap(tet[1], tet[2]);
          mesh.tets.push_back(tet);
        }
  return mesh;
}

TriangleMesh grid_sheet(const std::array<int, 2>& cells, const Eigen::Vector2d& size, const Vec3& origin) {
  const auto index = [&](int i, int j) { return i + (cells[0] + 1) * j; };
  TriangleMesh mesh;
  mesh.x.resize(3, (cells[0] + 1) * (cells[1] + 1));
  for (int j = 0; j <= cells[1]; ++j)
    for (int i = 0; i <= cells[0]; ++i)
      mesh.x.col(index(i, j)) = origin + Vec3(size.x() * i / cells[0], size.y() * j / cells[1], 0);
  for (int j = 0; j < cells[1]; ++j)
    for (int i = 0; i < cells[0]; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return mesh;
}

std::vector<Edge> edges(const TetMesh& mesh) {
  return edges_of(mesh.tets);
}
std::vector<Edge> edges(const TriangleMesh& mesh) {
  return edges_of(mesh.triangles);
}

double tet_volume(const Eigen::Matrix<double, 3, 4>& rest) {
  return (rest.rightCols<3>().colwise() - rest.col(0)).determinant() / 6;
}

double triangle_area(const Eigen::Matrix3d& rest) {
  return (rest.col(1) - rest.col(0)).cross(rest.col(2) - rest.col(0)).norm() / 2;
}

double dihedral_angle(const Eigen::Matrix<double, 3, 4>& x) {
  const Vec3 edge = x.col(1) - x.col(0);
  const Vec3 normal_a = edge.cross(x.col(2) - x.col(0));
  const Vec3 normal_b = (-edge).cross(x.col(3) - x.col(1));
  return std::atan2(normal_a.cross(normal_b).dot(edge.normalized()), normal_a.dot(normal_b));
}

int add_solid(Scene& scene, const TetMesh& mesh, double density, const Material& material, Strain strain) {
  TetStrain effect{.node = {}, .rest = {}, .material = material, .strain = strain};
  std::vector<double> mass(mesh.x.cols(), 0.0);
  const int first = scene.nodes();
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const auto rest = columns(mesh.x, mesh.tets[i]);
    require_proper(rest, "tetrahedron ", i);
    const double volume = tet_volume(rest);
    for (const int node : mesh.tets[i]) mass[node] += density * volume / 4;
    effect.node.push_back(shifted(mesh.tets[i], first));
    effect.rest.push_back(rest);
  }
  append_nodes(scene, mesh.x, mass);
  scene.effects.emplace_back(std::move(effect));
  return first;
}

int add_sheet_nodes(Scene& scene, const TriangleMesh& mesh, double area_density) {
  std::vector<double> mass(mesh.x.cols(), 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Matrix3d rest = columns(mesh.x, mesh.triangles[i]);
    require_proper(rest, "triangle ", i);
    const double area = triangle_area(rest);
    for (const int node : mesh.triangles[i]) mass[node] += area_density * area / 3;
  }
  return append_nodes(scene, mesh.x, mass);
}

TriangleStrain sheet_strain(const TriangleMesh& mesh, int first, const Material& material, double thickness) {
  TriangleStrain effect{.node = {}, .rest = {}, .material = material, .thickness = thickness};
  for (const auto& triangle : mesh.triangles) {
    effect.node.push_back(shifted(triangle, first));
    effect.rest.push_back(columns(mesh.x, triangle));
  }
  return effect;
}

Distance sheet_links(const TriangleMesh& mesh, int first, double compliance) {
  Distance effect;
  for (const auto& edge : edges(mesh)) {
    effect.node.push_back(shifted(edge, first));
    effect.rest_length.push_back((mesh.x.col(edge[0]) - mesh.x.col(edge[1])).norm());
    effect.compliance.push_back(compliance);
  }
  return effect;
}

Bending sheet_bending(const TriangleMesh& mesh, int first, double compliance) {
  std::map<Edge, std::vector<Wing>> wings_of;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& t = mesh.triangles[i];
      const int from = t[a], to = t[(a + 1) % 3];
      wings_of[{std::min(from, to), std::max(from, to)}].push_back({i, t[(a + 2) % 3], from < to});
    }
  Bending effect;
  for (const auto& [edge, wings] : wings_of) {
    require_hinge(edge, wings);
    if (wings.size() < 2) continue;
    const std::size_t along = wings[0].along ? 0 : 1;
    const std::array hinge{edge[0], edge[1], wings[along].opposite, wings[1 - along].opposite};
    effect.node.push_back(shifted(hinge, first));
    effect.rest_angle.push_back(dihedral_angle(columns(mesh.x, hinge)));
    effect.compliance.push_back(compliance);
  }
  return effect;
}

}  // namespace pbd
