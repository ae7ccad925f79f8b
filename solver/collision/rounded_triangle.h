// A triangle of a deformable surface as a flat polyhedron with two faces, and what a contact holds on to of
// it: features that follow its nodes.
//
//   point  sum_k w_k x_k of its nodes, as it lies where the contact is found
//   edge   the line through two nodes
//   plane  the one through all three, seen from a side
//
// The impulse of a contact acts on the unrounded triangle where that is touched, shared among the nodes by
// weights that sum to 1: those of the point, of the place along the edge, or the barycentric coordinates,
// beyond the triangle, too: what leaves it within a step goes on as on its plane or line.
#pragma once

#include "collision/contact_writer.h"
#include "polyhedron.h"

namespace pbd {

/// What is within `radius` (m) of a triangle; `solid` has its corners, edge k from corner k to the next, and
/// faces 0 and 1 that look along the normal and against it. A triangle without area has a normal across it.
struct RoundedTriangle {
  RoundedTriangle();

  /// Corners, m.
  void place(const std::array<Vec3, 3>& corner);

  Polyhedron solid;
  double radius = 0;
};

struct TriangleFeature {
  enum class Kind : std::uint8_t { point, edge, plane };

  Kind kind = Kind::plane;
  std::array<int, 3> node{};   // of the scene
  Vec3 weight = Vec3::Zero();  // of a point
  std::array<int, 2> ends{};   // of an edge, in `node`
  double side = 1;             // of a plane: its normal is that of the nodes' order, or the opposite
};

/// What `contact` holds on to of the triangle, whose nodes these are, as its side 0 (a) or 1 (b). The
/// triangle is the shape that was asked for first, in the world.
TriangleFeature feature_of(const ContactPoint& contact, int side, const RoundedTriangle& triangle,
                           const std::array<int, 3>& node);

/// Sets the side's point and direction to where the nodes are at x.
void follow(const TriangleFeature& feature, const Points& x, int side, ContactPoint& contact);

/// Of the three nodes for a place on the feature, m.
Vec3 weights_at(const TriangleFeature& feature, const Points& x, const Vec3& place);

}  // namespace pbd
