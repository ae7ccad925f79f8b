// What can touch of a scene as a judge states it: points, segments, polyhedra and meshes, rounded by a
// radius, made of corners, edges and faces; and cylinders (cylinder_features.h).
#pragma once

#include <vector>

#include "scene.h"

namespace pbd::reference {

/// A point of a body, in its frame (m), or a node.
struct Corner {
  int body = -1, node = -1;  // -1: none; `node` of a body is its centre's
  Vec3 place = Vec3::Zero();
};

struct Surface {
  int side = 0;  // colliders, then nodes, as a claim counts them, then triangles: a surface's first one
  std::vector<Corner> corner;
  std::vector<std::array<int, 2>> edge;
  std::vector<std::vector<int>> face;                        // of corners, anticlockwise seen from outside
  std::vector<std::vector<int>> beside_corner, beside_edge;  // corners that share an edge or a face with it
  double radius = 0;                                         // m
  /// Of a cylinder, else 0, m: its corners are the middles of both caps and then `rim_corners` of each rim,
  /// its edge is the axis, its faces are the caps.
  double cylinder = 0;
  bool plane = false;       // a half space: three points of its only face, which goes on for ever; no corners
  bool deformable = false;  // of triangles, from both sides
};

inline constexpr double in_one_plane = 1e-9;  // rad, as of the planes of hulls
inline constexpr int rim_corners = 8;         // they are what a cylinder stands on

/// Colliders and nodes in the order of a claim, then the deformable surfaces, one of each material.
std::vector<Surface> surfaces_of(const Scene& scene, const Contact& contact);

/// Of a scene's deformable triangles.
Surface surface_of(const std::vector<std::array<int, 3>>& triangles, double radius, int side);

}  // namespace pbd::reference
