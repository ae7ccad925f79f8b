#include "touching_features.h"

#include <cmath>

namespace pbd::reference {
namespace {

using Places = std::array<Vec3, 3>;

/// Weights of a line's ends at the point nearest to `x`.
void weigh_line(const Places& line, const Vec3& x, std::array<double, 3>& weight) {
  const Vec3 along = line[1] - line[0];
  const double t = along.dot(x - line[0]) / along.squaredNorm();
  weight = {1 - t, t, 0};
}

/// Of a plane's three corners below or above `x`.
void weigh_plane(const Places& plane, const Vec3& x, std::array<double, 3>& weight) {
  const Vec3 u = plane[1] - plane[0], v = plane[2] - plane[0], n = u.cross(v), d = x - plane[0];
  const double area = n.squaredNorm(), s = d.cross(v).dot(n) / area, t = u.cross(d).dot(n) / area;
  weight = {1 - s - t, s, t};
}

/// Of two lines that are not parallel.
void weigh_lines(const Places& a, const Places& b, std::array<std::array<double, 3>, 2>& weight) {
  const Vec3 u = a[1] - a[0], v = b[1] - b[0], d = b[0] - a[0], n = u.cross(v);
  const double s = d.cross(v).dot(n) / n.squaredNorm(), t = d.cross(u).dot(n) / n.squaredNorm();
  weight[0] = {1 - s, s, 0}, weight[1] = {1 - t, t, 0};
}

Places places_of(const ContactFeature& feature, const Placement& at) {
  Places x;
  for (int k = 0; k < feature.count; ++k)
    x[static_cast<std::size_t>(k)] = placed(feature.corner[static_cast<std::size_t>(k)], at);
  return x;
}

/// Moves a rim's middle to its point that is farthest along `way`.
void reach_out(const ContactFeature& feature, const Vec3& way, const Placement& at, Vec3& middle) {
  const Vec3 axis = at.orientation[static_cast<std::size_t>(feature.corner[0].body)] * feature.axis;
  const Vec3 across = way - axis.dot(way) * axis;
  if (const double length = across.norm(); length > 0) middle += feature.rim / length * across;
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

}  // namespace

Vec3 placed(const Corner& corner, const Placement& at) {
  const Vec3 x = at.x.col(corner.node);
  return corner.body < 0 ? x : Vec3(x + at.orientation[static_cast<std::size_t>(corner.body)] * corner.place);
}

Nearest nearest(const FeaturePair& pair, const Placement& at) {
  Places a = places_of(pair.a, at), b = places_of(pair.b, at);
  Nearest found;
  found.weight[0] = found.weight[1] = {1, 0, 0};
  if (pair.b.rim > 0) reach_out(pair.b, a[0] - b[0], at, b[0]);
  if (pair.b.count == 3) {
    found.normal = pair.side * (b[1] - b[0]).cross(b[2] - b[0]).normalized();
    if (pair.a.rim > 0) reach_out(pair.a, -found.normal, at, a[0]);
    weigh_plane(b, a[0], found.weight[1]);
  } else if (pair.a.count == 2) {
    weigh_lines(a, b, found.weight);
    found.normal = pair.side * (a[1] - a[0]).cross(b[1] - b[0]).normalized();
  } else if (pair.b.count == 2) {
    weigh_line(b, a[0], found.weight[1]);
  }
  const Vec3 at_a = weighted(a, found.weight[0], pair.a.count),
             at_b = weighted(b, found.weight[1], pair.b.count);
  const bool by_distance = pair.b.count == 1 || (pair.b.count == 2 && pair.a.count == 1);
  if (by_distance) found.normal = (at_a - at_b).normalized();
  found.gap = found.normal.dot(at_a - at_b) - pair.a.radius - pair.b.radius;
  if (pair.a.deformable || pair.b.deformable)
    found.place = pair.a.deformable ? at_a : at_b;
  else if (pair.b.count == 3)
    found.place = at_a - pair.a.radius * found.normal;
  else
    found.place = (at_a - pair.a.radius * found.normal + at_b + pair.b.radius * found.normal) / 2;
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
