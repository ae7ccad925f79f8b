// How cylinders' features are written down: points on caps, sides and rims, rims on planes, lines and rims,
// and edges that leave a side. What asks whether a point is over a face is a template's argument: it is
// called for every point.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "collision/contact_writer.h"
#include "collision/placed_cylinder.h"
#include "collision/tolerances.h"

namespace pbd {

/// Points of a rim beside its deepest one, where a cylinder stands on a face.
inline constexpr int rim_points = 8;

/// The number in keys of point k of the rim at `end`; k = rim_points is the deepest one.
constexpr int rim_point(int end, int k) {
  return (rim_points + 1) * (end + 1) + k;
}

/// The number in keys of a rim's point next to another cylinder, one on each side of its middle. No number
/// of rim_point's is the same.
constexpr int nearest_of_rim(int end, bool side) {
  return rim_point(2, 0) + 2 * (end + 1) + (side ? 1 : 0);
}

/// Numbers in keys of a rim or cap that edges cross. None of them is end + 1, the number of a rim or cap
/// that is nearest to an edge. `sign` tells where an edge comes in and goes out.
constexpr int left_over(int end) {
  return end + 11;
}
constexpr int crossed_cap(int end, int sign) {
  return 10 + 2 * end + sign;
}

/// Writes a's point y (rounded by `radius`, feature i of its kind) against the cylinder's nearest part.
void write_point(const Vec3& y, double radius, Feature feature, int i, const PlacedCylinder& b,
                 const ContactWriter& writer);

/// Cylinder a's rim at `end` against a point, or next to a point `on_rim` against a line or b's rim.
ContactPoint rim_on_point(const PlacedCylinder& a, int end, const Vec3& point_b, double radius_b);
ContactPoint rim_on_line(const PlacedCylinder& a, int end, const Vec3& on_rim, const Vec3& on_line,
                         const Vec3& along, double radius_b);
ContactPoint rim_on_rim(const PlacedCylinder& a, int end, const Vec3& on_rim, const PlacedCylinder& b,
                        int end_b);

/// Writes an edge rounded by `radius` against b's rim at `end` where it is nearest to it next to the edge's
/// point y; false, and nothing is written, unless that is on the edge and beside the rim, its outward normal
/// `minimum`, and the gap at least `floor` (m).
template <class Minimum>
bool write_beside_rim(const Segment& edge, double radius, const Vec3& y, const PlacedCylinder& b, int end,
                      double floor, std::uint64_t key, const ContactWriter& writer, Minimum&& minimum) {
  const Touching found = touching(rim_on_line(b, end, b.rim_at(end, y), y, edge.along, radius), {}, {});
  const double arc = edge.along.dot(found.point_b - edge.from);
  if (!(found.gap >= floor && arc >= 0 && arc <= edge.length)) return false;
  // Next to y there may be no nearest place.
  const Vec3 apart = found.point_a - found.point_b;
  if (!((apart - found.gap * found.normal).norm() <= rounding * b.size())) return false;
  if (!b.is_beside_rim(end, found.point_a, -found.normal) || !minimum(Vec3(-found.normal))) return false;
  writer.exchanged().write(rim_on_line(b, end, found.point_a, y, edge.along, radius), key, found.gap);
  return true;
}

/// Cylinder a's rim at `end`, about its deepest point along the plane's normal, against that plane.
ContactPoint on_plane_by_rim(const PlacedCylinder& a, int end, const Vec3& on_plane, const Vec3& normal,
                             double radius_b);

/// Cylinder a's rim that is deepest along the plane's normal, against that plane.
void write_deepest_rim(const PlacedCylinder& a, const Vec3& on_plane, const Vec3& normal, Feature feature,
                       int j, const ContactWriter& writer);

/// Cylinder a's rim at `end` and, where that disc faces the plane, eight of its points against b's plane,
/// where `above` says that a point is over b's face, gaps at least `floor` (m). The deepest point of a disc
/// that leans by no more than it turns goes anywhere round the rim, which `around` must say of a point.
template <class Above, class Around>
void write_rims(const PlacedCylinder& a, const Vec3& on_plane, const Vec3& normal, double radius_b,
                Feature feature, int j, double floor, const ContactWriter& writer, Above&& above,
                Around&& around) {
  constexpr double facing = 0.7;  // cosine: discs at less than 45 degrees to the plane
  const auto on_rim = [&](int end, int k) { return a.on_rim(end, 2 * std::numbers::pi * k / rim_points); };
  const auto holds_all = [&](int end) {
    for (int k = 0; k < rim_points; ++k)
      if (!around(on_rim(end, k))) return false;
    return true;
  };
  const bool level = a.axis.cross(normal).norm() <= std::max(writer.reach.turn, rounding);
  for (const int end : {-1, 1}) {
    const ContactPoint contact = on_plane_by_rim(a, end, on_plane, normal, radius_b);
    const Touching rim = touching(contact, {}, {});
    if (rim.gap >= floor && above(rim.point_a) && (!level || holds_all(end)))
      writer.write(contact, writer.key(Feature::rim, rim_point(end, rim_points), feature, j), rim.gap);
    if (-end * a.axis.dot(normal) < facing) continue;
    for (int k = 0; k < rim_points; ++k) {
      const Vec3 point = on_rim(end, k);
      const double gap = normal.dot(point - on_plane) - radius_b;
      if (gap >= floor && above(point))
        writer.write(on_face(point, 0, on_plane, normal, radius_b),
                     writer.key(Feature::rim, rim_point(end, k), feature, j), gap);
    }
  }
}

/// Of an edge e beside the cylinder, within 30 degrees of its axis, the points over the caps' planes, if
/// `minimum` of the direction from the axis.
template <class Minimum>
void write_where_it_leaves(const Segment& edge, double radius, int e, const PlacedCylinder& b,
                           const ContactWriter& writer, Minimum&& minimum) {
  const double cosine = edge.along.dot(b.axis), from = (edge.from - b.centre).dot(b.axis);
  constexpr double steep = 0.75;  // cosine squared of 30 degrees
  if (cosine * cosine <= steep) return;
  for (const int end : {-1, 1}) {
    const double s = (end * b.half - from) / cosine;
    if (s <= 0 || s >= edge.length) continue;
    const Vec3 y = edge.at(s), apart = y - b.cap(end);
    if (apart.norm() < b.radius || !minimum(apart)) continue;
    write_beside_rim(edge, radius, y, b, end, -infinity,
                     writer.key(Feature::edge, e, Feature::rim, left_over(end)), writer, minimum);
  }
}

}  // namespace pbd
