// Meshes of tetrahedra and triangles, structured grids, and the effects built on them.
#pragma once

#include <vector>

#include "scene.h"

namespace pbd {

/// Linear tetrahedra: nodes x0..x3 with (x1-x0) x (x2-x0) . (x3-x0) > 0. Positions in m.
struct TetMesh {
  Points x;
  std::vector<std::array<int, 4>> tets;
};

/// Box of `size` (m) with a corner at `origin`, cut into cells[0] x cells[1] x cells[2] bricks of six
/// tetrahedra each around the diagonal (0,0,0)-(1,1,1) (kuhn1960combinatorial). Node (i,j,k) has index i +
/// (cells[0]+1) * (j + (cells[1]+1) * k).
TetMesh kuhn_grid(const std::array<int, 3>& cells, const Vec3& size, const Vec3& origin = Vec3::Zero());

/// Flat sheet in the plane z = origin.z with cells[0] x cells[1] rectangles of two triangles each. Node (i,j)
/// has index i + (cells[0]+1) * j.
TriangleMesh grid_sheet(const std::array<int, 2>& cells, const Eigen::Vector2d& size,
                        const Vec3& origin = Vec3::Zero());

/// Edges of the mesh, each once, smaller index first, sorted.
std::vector<std::array<int, 2>> edges(const TetMesh& mesh);
std::vector<std::array<int, 2>> edges(const TriangleMesh& mesh);

/// Rest volume (m^3) of a tetrahedron from its rest positions; positive for a properly oriented one.
double tet_volume(const Eigen::Matrix<double, 3, 4>& rest);

/// Rest area (m^2) of a triangle from its rest positions.
double triangle_area(const Eigen::Matrix3d& rest);

/// Signed dihedral angle (rad) of a hinge, as defined at `Bending`.
double dihedral_angle(const Eigen::Matrix<double, 3, 4>& x);

/// Adds the mesh's nodes with lumped masses (density kg/m^3: a quarter of each tetrahedron's mass a node) and
/// one `TetStrain`. Returns the index of the mesh's first node in the scene. Throws SetupError naming the
/// first tetrahedron that is degenerate or inverted.
int add_solid(Scene& scene, const TetMesh& mesh, double density, const Material& material, Strain strain);

/// Adds the mesh's nodes with lumped masses (a third of each triangle's mass a node, area_density kg/m^2) and
/// returns the index of the first one. Throws SetupError naming the first degenerate triangle.
int add_sheet_nodes(Scene& scene, const TriangleMesh& mesh, double area_density);

/// The effects a sheet can have; `first` is what `add_sheet_nodes` returned. Compliances as in scene.h.
TriangleStrain sheet_strain(const TriangleMesh& mesh, int first, const Material& material, double thickness);
Distance sheet_links(const TriangleMesh& mesh, int first, double compliance);

/// A hinge at every edge of two triangles. Throws SetupError naming the triangles of an edge that has more,
/// or that its two triangles pass in the same direction: their normals disagree.
Bending sheet_bending(const TriangleMesh& mesh, int first, double compliance);

}  // namespace pbd
