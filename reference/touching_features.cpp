#include "touching_features.h"

#include <cmath>

#include "rim_points.h"

namespace pbd::reference {
namespace {

/// Weights of a line's ends at the point nearest to `x`.
void weigh_line(const Places& line, const Vec3& x, std::array<double, 3>& weight) {
  const Vec3 along = line[1] - line[0];
  const double t = along.dot(x - line[0]) / along.squaredNorm();
  weight = {1 - t, t, 0};
}

Places places_of(const ContactFeature& feature, const Placement& at) {
  Places x;
  for (int k = 0; k < feature.count; ++k)
    x[static_cast<std::size_t>(k)] = placed(feature.corner[static_cast<std::size_t>(k)], at);
  return x;
}

Circle circle_of(const ContactFeature& feature, const Placement& at) {
  return {placed(feature.corner[0], at),
          at.orientation[static_cast<std::size_t>(feature.corner[0].body)] * feature.axis, feature.rim};
}

Vec3 weighted(const Places& x, const std::array<double, 3>& weight, int count) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) sum += weight[k] * x[k];
  return sum;
}

Vec3 velocity_of(const Corner& corner, const Placement& at, const State& state, const Vec3& place) {
  Vec3 v = state.v.col(corner.node);
  if (corner.body < 0) return v;
  const Vec3 w = at.orientation[static_cast<std::size_t>(corner.body)] * Vec3(state.spin.col(corner.body));
  return v + w.cross(place - at.x.col(corner.node));
}

/// Of a feature, where a force acts on it, m/s.
Vec3 velocity_of(const ContactFeature& feature, const std::array<double, 3>& weight, const Placement& at,
                 const State& state, const Vec3& place) {
  if (feature.of_body()) return velocity_of(feature.corner[0], at, state, place);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(feature.count); ++k)
    sum += weight[k] * velocity_of(feature.corner[k], at, state, place);
  return sum;
}

/// The normal across two directions.
void take_across(const Vec3& one, const Vec3& other, Nearest& found) {
  const Vec3 across = one.cross(other);
  found.normal = across.normalized();
  found.crossing = across.norm() / (one.norm() * other.norm());
}

/// Of a rim and a line or rim: the normal, and where they are nearest to each other.
void cross_rim(const FeaturePair& pair, const Placement& at, const Places& b, Nearest& found) {
  const Circle rim = circle_of(pair.a, at);
  const bool rims = pair.b.rim > 0;
  const Circle other = rims ? circle_of(pair.b, at) : Circle{};
  const auto nearest_of_other = [&](const Vec3& x) -> Vec3 {
    if (rims) return other.nearest(x);
    weigh_line(b, x, found.weight[1]);
    return weighted(b, found.weight[1], 2);
  };
  const Vec3 split = rims ? rim.axis.cross(other.middle - rim.middle) : Vec3(b[1] - b[0]);
  double farthest = -infinity;
  for (const Vec3& x : nearest_points(rim, nearest_of_other)) {
    const double along = pair.half * split.dot(x - rim.middle);
    if (along > farthest) farthest = along, found.on_a = x;
  }
  found.on_b = nearest_of_other(found.on_a);
  if (pair.a.radius + pair.b.radius > 0) {
    found.normal = (found.on_a - found.on_b).normalized();
    return;
  }
  const Vec3 outward = (found.on_a - rim.middle).normalized() + rim.axis;
  const Vec3 along = rims ? Vec3(other.axis.cross(found.on_b - other.middle)) : split;
  take_across(rim.axis.cross(outward), along, found);
  if (found.normal.dot(outward) > 0) found.normal = -found.normal;
}

}  // namespace

void weigh_plane(const Places& plane, const Vec3& x, std::array<double, 3>& weight) {
  const Vec3 u = plane[1] - plane[0], v = plane[2] - plane[0], n = u.cross(v), d = x - plane[0];
  const double area = n.squaredNorm(), s = d.cross(v).dot(n) / area, t = u.cross(d).dot(n) / area;
  weight = {1 - s - t, s, t};
}

void weigh_lines(const Places& a, const Places& b, std::array<std::array<double, 3>, 2>& weight) {
  const Vec3 u = a[1] - a[0], v = b[1] - b[0], d = b[0] - a[0], n = u.cross(v);
  const double s = d.cross(v).dot(n) / n.squaredNorm(), t = d.cross(u).dot(n) / n.squaredNorm();
  weight[0] = {1 - s, s, 0}, weight[1] = {1 - t, t, 0};
}

Vec3 placed(const Corner& corner, const Placement& at) {
  const Vec3 x = at.x.col(corner.node);
  return corner.body < 0 ? x : Vec3(x + at.orientation[static_cast<std::size_t>(corner.body)] * corner.place);
}

Nearest nearest(const FeaturePair& pair, const Placement& at) {
  const Places a = places_of(pair.a, at), b = places_of(pair.b, at);
  const double radii = pair.a.radius + pair.b.radius;
  Nearest found;
  found.weight[0] = found.weight[1] = {1, 0, 0};
  found.on_a = a[0], found.on_b = b[0];
  if (pair.a.rim > 0 && pair.b.count < 3) {
    cross_rim(pair, at, b, found);
  } else if (pair.b.rim > 0) {
    found.on_b = circle_of(pair.b, at).nearest(a[0]);
    found.normal = (found.on_a - found.on_b).normalized();
  } else if (pair.b.count == 3) {
    found.normal = pair.side * (b[1] - b[0]).cross(b[2] - b[0]).normalized();
    if (pair.a.rim > 0) found.on_a = circle_of(pair.a, at).nearest(a[0] - found.normal);
    weigh_plane(b, found.on_a, found.weight[1]);
    found.on_b = weighted(b, found.weight[1], 3);
  } else if (pair.a.count == 2) {
    weigh_lines(a, b, found.weight);
    found.on_a = weighted(a, found.weight[0], 2), found.on_b = weighted(b, found.weight[1], 2);
    take_across(pair.side * (a[1] - a[0]), b[1] - b[0], found);
  } else {
    if (pair.b.count == 2) weigh_line(b, a[0], found.weight[1]);
    found.on_b = weighted(b, found.weight[1], pair.b.count);
    found.normal = (found.on_a - found.on_b).normalized();
  }
  found.gap = found.normal.dot(found.on_a - found.on_b) - radii;
  if (pair.a.deformable || pair.b.deformable)
    found.place = pair.a.deformable ? found.on_a : found.on_b;
  else if (pair.b.count == 3)
    found.place = found.on_a - pair.a.radius * found.normal;
  else
    found.place = (found.on_a - pair.a.radius * found.normal + found.on_b + pair.b.radius * found.normal) / 2;
  return found;
}

Vec3 against(const FeaturePair& pair, const Nearest& found, const Placement& at, const State& state) {
  return velocity_of(pair.a, found.weight[0], at, state, found.place) -
         velocity_of(pair.b, found.weight[1], at, state, found.place);
}

Eigen::Matrix3d directions_of(const Vec3& normal, const Vec3& reference) {
  Eigen::Matrix3d directions;
  const Vec3 tangent = (reference - normal.dot(reference) * normal).normalized();
  directions << normal.transpose(), tangent.transpose(), normal.cross(tangent).transpose();
  return directions;
}

}  // namespace pbd::reference
