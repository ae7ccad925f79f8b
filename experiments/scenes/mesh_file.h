// Mesh files as text: tetrahedra from Gmsh .msh and TetGen .node/.ele, triangles from Gmsh .msh, OBJ and OFF.
//
//   .msh   Gmsh MSH 2.2 and 4.1, ASCII: $Nodes and $Elements; of the dimension asked for only tetrahedra of 4
//          nodes (type 4) or triangles of 3 nodes (type 2), all else of that dimension is refused; elements
//          of other dimensions and other sections are skipped.
//   .node  TetGen points, with the tetrahedra in the .ele beside it (either name may be given); 0- or 1-based
//          numbers, `#` comments, attributes and boundary markers skipped, second-order nodes refused.
//   .obj   `v` and `f` lines; weights, colours, texture and normal indices ("1/2/3"), groups, materials,
//          points and lines skipped; faces must be triangles.
//   .off   header OFF, counts, vertices, faces with three nodes, their colours skipped.
//
// Node numbers need not be consecutive (nodes no element uses are dropped, so that every node has a mass);
// the order of the nodes in the file is kept, and so is the order of the nodes in an element: an inverted
// tetrahedron is not mended here. Coordinates are taken as metres. Refused with a SetupError that names file
// and line: what is no number, a node or an element twice, words or entries more or fewer than announced.
#pragma once

#include <filesystem>

#include "mesh.h"

namespace pbdcheck {

pbd::TetMesh read_tet_mesh(const std::filesystem::path& file);
pbd::TriangleMesh read_triangle_mesh(const std::filesystem::path& file);

/// All nodes of a triangle mesh's file, of which no triangle need be made.
pbd::Points read_mesh_nodes(const std::filesystem::path& file);

}  // namespace pbdcheck
