// A cylinder placed in the world, and where points are relative to it.
#pragma once

#include <Eigen/Geometry>

#include "contact/segments.h"
#include "contact/writer.h"

namespace pbd {

struct Round {
  enum class Part { cap, side, rim };

  /// Of a point: its signed distance (m), the nearest part and point, and the outward normal there.
  struct Place {
    double distance;
    Part part;
    Vec3 nearest, normal;
    int end;  // 1 or -1: which cap or rim
  };

  Vec3 centre, axis;    // axis: unit
  double radius, half;  // m

  Round(const Cylinder& cylinder, const Frame& at)
      : centre(at.origin), axis(at.rotation.col(2)), radius(cylinder.radius), half(cylinder.length / 2) {}

  Vec3 cap(int end) const { return centre + end * half * axis; }
  double size() const { return 2 * (radius + half); }
  /// Of the farthest point along the unit vector n, measured from the centre (m).
  double support(const Vec3& n) const {
    return half * std::abs(n.dot(axis)) + radius * (n - n.dot(axis) * axis).norm();
  }
  Vec3 on_rim(int end, double angle) const {
    const Vec3 first = axis.unitOrthogonal();
    return cap(end) + radius * (std::cos(angle) * first + std::sin(angle) * axis.cross(first));
  }

  Place place(const Vec3& x) const {
    const double z = axis.dot(x - centre);
    const Vec3 across = x - centre - z * axis;
    const double from_axis = across.norm(), above = std::abs(z) - half, outside = from_axis - radius;
    const int end = z < 0 ? -1 : 1;
    const Vec3 radial = from_axis > 0 ? Vec3(across / from_axis) : axis.unitOrthogonal();
    if (above > 0 && outside > 0) {
      const Vec3 nearest = cap(end) + radius * radial;
      const double distance = std::hypot(above, outside);
      return {distance, Part::rim, nearest, (outside * radial + above * end * axis) / distance, end};
    }
    if (above > outside) return {above, Part::cap, x - above * end * axis, end * axis, end};
    return {outside, Part::side, x - outside * radial, radial, end};
  }
};

/// The arc of an edge's point nearest to the cylinder (m): the distance is convex, its slope is bisected.
double nearest_arc(const Segment& edge, const Round& b);

/// Of an edge e beside the cylinder, within 30 degrees of its axis, the points over the caps' planes, if
/// `minimum` of the direction from the axis.
template <class Minimum>
void write_where_it_leaves(const Segment& edge, double radius, int e, const Round& b, const Roles& roles,
                           Minimum&& minimum) {
  const double cosine = edge.along.dot(b.axis), from = (edge.from - b.centre).dot(b.axis);
  constexpr double steep = 0.75;
  if (cosine * cosine <= steep) return;
  for (const int end : {-1, 1}) {
    const double s = (end * b.half - from) / cosine;
    if (s <= 0 || s >= edge.length) continue;
    const Vec3 y = edge.at(s), apart = y - b.cap(end);
    const double outside = apart.norm() - b.radius;
    if (outside >= 0 && minimum(apart))
      roles.write(on_line(y, radius, b.centre, b.axis, b.radius),
                  roles.key(Feature::edge, e, Feature::rim, end + 11), outside - radius);
  }
}

/// Writes a's point y (rounded by `radius`, feature i of its kind) against the cylinder's nearest part.
void write_point(const Vec3& y, double radius, Feature feature, int i, const Round& b, const Roles& roles);

/// Cylinder a's rim that is deepest along the plane's normal, against that plane.
void write_deepest_rim(const Round& a, const Vec3& on_plane, const Vec3& normal, Feature feature, int j,
                       const Roles& roles);

/// Cylinder a's rim at `end` and, where that disc faces the plane, eight of its points against b's plane,
/// where `above` says that a point is over b's face, gaps at least `floor` (m).
template <class Above>
void write_rims(const Round& a, const Vec3& on_plane, const Vec3& normal, double radius_b, Feature feature,
                int j, double floor, const Roles& roles, Above&& above) {
  constexpr int points = 8;
  constexpr double facing = 0.7;  // cosine
  for (const int end : {-1, 1}) {
    ContactPoint contact = on_face(a.cap(end), 0, on_plane, normal, radius_b);
    contact.direction_a = a.axis;
    contact.rim_a = a.radius;
    const Touching rim = touching(contact, {}, {});
    const auto name = [&](int k) { return (points + 1) * (end + 1) + k; };
    if (rim.gap >= floor && above(rim.point_a))
      roles.write(contact, roles.key(Feature::rim, name(points), feature, j), rim.gap);
    if (-end * a.axis.dot(normal) < facing) continue;
    for (int k = 0; k < points; ++k) {
      const Vec3 point = a.on_rim(end, 2 * std::acos(-1.0) * k / points);
      const double gap = normal.dot(point - on_plane) - radius_b;
      if (gap >= floor && above(point))
        roles.write(on_face(point, 0, on_plane, normal, radius_b),
                    roles.key(Feature::rim, name(k), feature, j), gap);
    }
  }
}

}  // namespace pbd
