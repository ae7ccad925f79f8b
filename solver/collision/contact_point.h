// Where two shapes a and b may touch: a pair of features, given in the frames of their bodies, from which
// gap, normal and touching points follow wherever the bodies have moved to.
//
//   face   a's point against b's plane:       n = R_b direction_b,            gap = n . (y_a - y_b) - radii
//   point  a's point against b's point:       n = (y_a - y_b)/|y_a - y_b|,    gap = |y_a - y_b| - radii
//   line   a's point against b's line:        n = unit part of y_a - y_b across R_b direction_b, gap likewise
//   edges  a's line against b's line:         n = +-(e_a x e_b)/|e_a x e_b|,  gap = n . (y_a - y_b) - radii
//   rim    a's rim against b's line or rim:   n, gap as of edges, e being the tangents at y_a and y_b
//
// y are the features' points in the world, e the lines' directions, and `radii` the sum of what the features
// are rounded by. A rim is the edge of a disc about a's point, x_a + R_a point_a, of radius rim_a across
// direction_a: y_a = x_a + R_a point_a - rim_a t. Against a plane it is the deepest point, t the unit part of
// n across the axis; if it lies flat the point R_a across_a, which stays where it is. Against a point it is
// the nearest one; against a line or rim the one, next to R_a across_a, that is nearest to it or, where they
// are in each other, as far as any beside it; n leads into a's rim between cap and side, and out of b's.
// Where the tangents are parallel it is along y_a - y_b, but where a line is over the cap or beside the side
// it is that one's, as it is in the cylinder: the one that it is less deep below. Normals point from b to a:
// the impulse of a contact pushes a along n. The gap's derivative by the bodies' motion is n . (velocity of a
// - velocity of b) at the touching points.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "geometry.h"

namespace pbd {

struct ContactPoint {
  enum class Kind : std::uint8_t { face, point, line, edges, rim };

  Kind kind = Kind::face;
  bool swapped = false;              // a is the second shape asked for, b the first
  std::uint64_t key = 0;             // the features' names: the same contact has the same one in every step
  Eigen::Vector3d point_a, point_b;  // m
  Eigen::Vector3d direction_a = Eigen::Vector3d::Zero();  // unit: of a's line, or out of its rim's cap
  Eigen::Vector3d direction_b = Eigen::Vector3d::Zero();  // unit: b's outward normal, or likewise
  Eigen::Vector3d across_a = Eigen::Vector3d::Zero();     // unit: to a rim's point, see above
  double radius_a = 0, radius_b = 0;                      // m
  double rim_a = 0, rim_b = 0;                            // m; 0: no rim
  double side = 1;                                        // edges: the sign of e_a x e_b in n
};

struct Touching {
  double gap = 0;                    // m; negative where the shapes overlap
  Eigen::Vector3d normal;            // unit, from b to a
  Eigen::Vector3d point_a, point_b;  // m, in the world: what touches of a and of b
};

/// The contact with its features' carriers at frames a and b.
Touching touching(const ContactPoint& contact, const Frame& a, const Frame& b);

/// The same contact with features given in the frames that a and b place theirs in.
ContactPoint placed(const ContactPoint& contact, const Frame& a, const Frame& b);

}  // namespace pbd
