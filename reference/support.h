// How far convex shapes are from each other, or how deep in each other, by their support functions alone.
//
//   s(u)   = max over x in the shape of u . x (m), u a unit vector; infinite where the shape has no end
//   sep(n) = min over a of n . x - max over b of n . x = -s_a(-n) - s_b(n)
//
// Shapes are at least sep(n) apart and, where that is negative, at most -sep(n) deep in each other, for each
// unit vector n: each n is a proof. The point of a - b that is nearest to the origin (gilbert1988fast) tells
// how far shapes are apart, and along which n; of shapes in each other once a is shifted out of b along some
// n, after which the shift along the n found is the shorter one, unless both are the same.
//
// Limits: of a closed mesh s is that of its hull, which is right beside a half space alone. `least_parting`
// is sure of the ways that it was given and of those beside where these lead.
#pragma once

#include <array>
#include <vector>

#include "geometry.h"
#include "shapes.h"

namespace pbd::reference {

/// A shape where it stands.
struct PlacedShape {
  const Shape* shape;
  Frame frame;
};

/// s(u) and a point that attains it, in the world. Not of a half space.
Vec3 farthest_point(const PlacedShape& placed, const Vec3& direction);

/// sep(n), m.
double separation(const PlacedShape& a, const PlacedShape& b, const Vec3& n);

/// The largest sep(n) over unit vectors, m; -infinity without any.
double separation(const PlacedShape& a, const PlacedShape& b, const std::vector<Vec3>& ways);

/// A unit vector n and its sep(n), m.
struct Parting {
  double apart = -infinity;
  Vec3 along = Vec3::Zero();
};

/// The largest sep(n) that is found from the ways: of shapes in each other each way is followed to one than
/// which none beside it parts them sooner.
Parting least_parting(const PlacedShape& a, const PlacedShape& b, const std::vector<Vec3>& ways);

/// Two bounds of how far convex sets a and b are from each other (m): both 0 where they meet. `proved` is
/// what they are apart along the unit vector `along`, from b to a; there is none where nothing is proved.
struct DistanceBounds {
  double proved, found;  // at least, at most
  Vec3 along = Vec3::Zero();
};

/// m, at least, of a point from a shape.
double distance(const PlacedShape& a, const Vec3& point);

/// Of a shape with an end and a triangle.
DistanceBounds distance(const PlacedShape& a, const std::array<Vec3, 3>& triangle);

/// Of the hulls of two sets of points, a column each, at least one.
DistanceBounds distance(const Points& a, const Points& b);

/// No point is farther from the frame's origin than `outer` (infinite for a half space); `round` is the
/// radius of what is round of the shape, half the least side of a box, and of other polyhedra half the
/// diagonal of theirs, which no width exceeds. m
struct Size {
  double outer, round;
};
Size size_of(const Shape& shape);

bool is_half_space(const Shape& shape);

/// False of a closed mesh and of no shape.
bool is_convex(const Shape& shape);

}  // namespace pbd::reference
