// Deformable surfaces in each other, by brute force over their nodes, edges and triangles. They keep
// `thickness` apart: a node that is nearer to a triangle that it is over, or to an edge where no triangle of
// both is nearer, and two edges that are nearer where they cross, are as deep as that lacks. An edge that
// goes through a triangle is as deep as it has to move to be out of it, and the thickness more. Features with
// a common node are no pair.
//
// Limit: what is nearer may be a crease, of which no depth is told.
#pragma once

#include <span>
#include <string>

#include "geometry.h"

namespace pbd::reference {

struct SurfaceOverlap {
  enum class Kind : std::uint8_t { node_triangle, edges, node_edge, through };

  Kind kind = Kind::node_triangle;
  std::array<int, 5> node{};  // of the first feature, then of the other: 4, 4, 3 or 5 of them
  /// Of a node and an edge that the surface joins by another edge: its own crease brings them near.
  bool crease = false;
  double depth = 0;  // m

  std::string name() const;
};

/// All pairs that are deeper than `floor` (m).
std::vector<SurfaceOverlap> surface_overlaps(std::span<const std::array<int, 3>> triangles, const Points& x,
                                             double thickness, double floor);

/// m, of the same features at x, by their distance wherever they are to each other.
double depth_of(const SurfaceOverlap& overlap, const Points& x, double thickness);

}  // namespace pbd::reference
