// A cylinder placed in the world (or in a mesh's frame), and where points are relative to it.
#pragma once

#include <array>

#include "collision/segments.h"
#include "shapes.h"

namespace pbd {

struct PlacedCylinder {
  enum class Part { cap, side, rim };

  /// Of a point: its signed distance (m), the nearest part and point, and the outward normal there.
  struct Place {
    double distance;
    Part part;
    Vec3 nearest, normal;
    int end;  // 1 or -1: which cap or rim
  };

  Vec3 centre, axis, across;  // axis and across: unit; `across` turns with the cylinder
  double radius, half;        // m

  PlacedCylinder(const Cylinder& cylinder, const Frame& at)
      : centre(at.origin),
        axis(at.rotation.col(2)),
        across(at.rotation.col(0)),
        radius(cylinder.radius),
        half(cylinder.length / 2) {}

  double size() const { return 2 * (radius + half); }  // m, at least the diameter
  Vec3 cap(int end) const { return centre + end * half * axis; }
  Vec3 on_rim(int end, double angle) const;
  /// Along the rims where they are nearest to x; unit, zero on the axis.
  Vec3 rim_tangent(const Vec3& x) const { return axis.cross(x - centre).normalized(); }
  /// The rim on x's side of the middle: 1 or -1.
  int end_at(const Vec3& x) const { return axis.dot(x - centre) < 0 ? -1 : 1; }
  /// Of the rim at `end`, the point nearest to x; the cap's middle if x is on the axis.
  Vec3 rim_at(int end, const Vec3& x) const { return cap(end) + radius * rim_tangent(x).cross(axis); }
  Place place(const Vec3& x) const;
  /// True if the outward normal of a point of the rim at `end` is between those of side and cap, or leans out
  /// of them by no more than 0.2 rad: a turn in one step may bring it there.
  bool is_beside_rim(int end, const Vec3& on_rim, const Vec3& outward) const;
  /// The farthest point along the unit vector n.
  Vec3 farthest(const Vec3& n) const;
  /// How far that is from the centre along n, m.
  double support(const Vec3& n) const;
};

/// The arc of an edge's point nearest to the cylinder or deepest in it (m): the signed distance is convex,
/// its slope is bisected.
double nearest_arc(const Segment& edge, const PlacedCylinder& b);

/// Angles of points of a rim that are nearer to (or deeper in) the other than those beside them.
struct NearestAngles {
  std::array<double, 2> angle{};
  int count = 0;
  const double* begin() const { return angle.data(); }
  const double* end() const { return angle.data() + count; }
};

/// Of a's rim at `end`, within reach (m) of b: two where b lies across the cap. The two least of the minima
/// about 16 samples; a third one, and one between samples of which neither is lower than the next, is lost.
NearestAngles nearest_angles(const PlacedCylinder& a, int end, const PlacedCylinder& b, double reach);

}  // namespace pbd
