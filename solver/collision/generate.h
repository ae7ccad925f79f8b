// All points where two shapes touch or are about to.
//
//   sphere, capsule, box, hull   separating axes; the clipped polygon of the faces that look at each other,
//                                all its corners; else the nearest features
//   half space                   every node, end and rim of what is near it
//   cylinder                     rims on faces and caps, nodes and edges on caps and sides
//   closed mesh                  nodes over faces, edges that cross, minima of the distance
//
// The least gap of convex shapes is their signed distance, with this exception: where cylinders overlap at a
// rim and an edge or at two rims it is the depth along a face's normal, a cap's, across the axes, or the
// direction next to the rim's deepest point along which they overlap least, which may be larger than the
// least one. Meshes are exact outside each other; inside, gaps are those of nodes and
// crossing edges below the faces nearest to them, without any of these along the normal of a face that is
// cut: not the shortest translation that parts them.
//
// What is not exact as bodies move, to first order only: edges that are nearly parallel (a point on one
// against the other's line), and nodes against edges, rims or nodes without a radius (the plane between them,
// fixed to b: a distance of points has no sign by which to see that one passed the other). A cylinder that
// stands on a face has eight points on its rim beside the deepest one.
#pragma once

#include <vector>

#include "collision/contact_point.h"
#include "collision/scratch.h"
#include "shapes.h"

namespace pbd {

/// Appends the contact points of shapes a and b, placed in the world by their frames, that are within reach.
/// Features are given in the shapes' own frames; `swapped` where the contact's a is b's.
void generate(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b, const Reach& reach,
              CollisionScratch& scratch, std::vector<ContactPoint>& found);

/// The same of a triangle in the world, the shape asked for first, and a shape. A triangle without a radius
/// is an overlap at best where it touches.
void generate(const RoundedTriangle& a, const Shape& b, const Frame& at_b, const Reach& reach,
              CollisionScratch& scratch, std::vector<ContactPoint>& found);

/// True if a place in the world is in a shape, or no farther from it than `distance`, m. `found` is scratch.
bool is_at(const Shape& shape, const Frame& at, const Vec3& place, double distance, CollisionScratch& scratch,
           std::vector<ContactPoint>& found);

}  // namespace pbd
