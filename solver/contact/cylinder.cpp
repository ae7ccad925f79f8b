// Cylinders against half spaces and cylinders.
#include "contact/pairs.h"
#include "contact/round.h"
#include "contact/segments.h"

namespace pbd {
namespace {

constexpr double pi = 3.14159265358979323846;

/// The angle of a's rim that is nearest to (or deepest in) b: the best of 16, then golden sections.
double nearest_angle(const Round& a, int end, const Round& b) {
  constexpr int samples = 16, sections = 45;
  const auto distance = [&](double angle) { return b.place(a.on_rim(end, angle)).distance; };
  double best = 0, least = infinity;
  for (int k = 0; k < samples; ++k) {
    const double angle = 2 * pi * k / samples, here = distance(angle);
    if (here < least) {
      least = here;
      best = angle;
    }
  }
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = best - 2 * pi / samples, high = best + 2 * pi / samples;
  double x = high - golden * (high - low), y = low + golden * (high - low), at_x = distance(x),
         at_y = distance(y);
  for (int k = 0; k < sections; ++k) {
    if (at_x < at_y) {
      high = y;
      y = x;
      at_y = at_x;
      x = high - golden * (high - low);
      at_x = distance(x);
    } else {
      low = x;
      x = y;
      at_x = at_y;
      y = low + golden * (high - low);
      at_y = distance(y);
    }
  }
  return (low + high) / 2;
}

/// a's rims and the points of its caps against b's caps and sides.
void rims_on_cylinder(const Round& a, const Round& b, double floor, const Roles& roles) {
  const double slack = rounding * (a.size() + b.size());
  for (const int end : {-1, 1})
    write_rims(a, b.cap(end), end * b.axis, 0, Feature::cap, end + 1, floor, roles,
               [&](const Vec3& x) { return (x - b.centre).cross(b.axis).norm() <= b.radius + slack; });
  for (const int end : {-1, 1}) {
    const Vec3 y = a.on_rim(end, nearest_angle(a, end, b));
    write_point(y, 0, Feature::rim, end + 1, b, roles);
  }
}

double least_gap(const Roles& roles) {
  double gap = infinity;
  for (std::size_t i = roles.begin; i < roles.out.size(); ++i) {
    const bool same = roles.out[i].swapped == roles.swapped;
    gap = std::min(gap, touching(roles.out[i], same ? roles.a : roles.b, same ? roles.b : roles.a).gap);
  }
  return gap;
}

/// A plane against a's rim that is deepest along its normal.
void write_deepest_rim(const Round& a, const Vec3& on_plane, const Vec3& normal, Feature feature, int j,
                       const Roles& roles) {
  const int end = a.axis.dot(normal) > 0 ? -1 : 1;
  ContactPoint contact = on_face(a.cap(end), 0, on_plane, normal, 0);
  contact.direction_a = a.axis;
  contact.rim_a = a.radius;
  roles.write(contact, roles.key(Feature::rim, 9 * (end + 1) + 8, feature, j), touching(contact, {}, {}).gap);
}

}  // namespace

void write_point(const Vec3& y, double radius, Feature feature, int i, const Round& b, const Roles& roles) {
  const Round::Place at = b.place(y);
  const double gap = at.distance - radius;
  if (at.part == Round::Part::side)
    roles.write(on_line(y, radius, b.centre, b.axis, b.radius), roles.key(feature, i, Feature::axis, 0), gap);
  else if (at.part == Round::Part::cap)
    roles.write(on_face(y, radius, at.nearest, at.normal, 0), roles.key(feature, i, Feature::cap, at.end + 1),
                gap);
  else if (radius > 0)
    roles.write(features(ContactPoint::Kind::point, y, radius, at.nearest, 0),
                roles.key(feature, i, Feature::rim, at.end + 1), gap);
  else
    roles.write(on_face(y, 0, at.nearest, at.normal, 0), roles.key(feature, i, Feature::rim, at.end + 1),
                gap);
}

void cylinder_plane(const Cylinder& a, const Roles& roles) {
  write_rims(Round(a, roles.a), roles.b.origin, roles.b.rotation.col(2), 0, Feature::face, 0, -infinity,
             roles, [](const Vec3&) { return true; });
}

void cylinder_cylinder(const Cylinder& first, const Cylinder& second, const Roles& roles) {
  const Round a(first, roles.a), b(second, roles.b);
  const double tiny = rounding * (a.size() + b.size());
  const Vec3 apart = a.centre - b.centre, cross = a.axis.cross(b.axis);
  // The caps' planes and the plane along both axes.
  const double over_b = std::abs(apart.dot(b.axis)) - a.support(b.axis) - b.half;
  const double over_a = std::abs(apart.dot(a.axis)) - b.support(a.axis) - a.half;
  const Vec3 normal =
      cross.norm() > rounding ? Vec3(cross / cross.norm() * (cross.dot(apart) < 0 ? -1 : 1)) : Vec3::Zero();
  const double beside = cross.norm() > rounding ? normal.dot(apart) - a.radius - b.radius : -infinity;
  const double most = std::max({over_a, over_b, beside});
  if (most >= roles.margin) return;
  rims_on_cylinder(a, b, most - tiny, roles);
  rims_on_cylinder(b, a, most - tiny, roles.exchanged());
  const Vec3 from_a = a.cap(-1), from_b = b.cap(-1);
  const Nearest axes = nearest(Segment{from_a, a.axis, 2 * a.half}, Segment{from_b, b.axis, 2 * b.half});
  const ContactPoint sides = on_edges(from_a + axes.s * a.axis, a.axis, a.radius, from_b + axes.t * b.axis,
                                      b.axis, b.radius, normal.isZero() ? axes.apart : normal);
  const auto sides_key = roles.key(Feature::axis, 0, Feature::axis, 0);
  const bool inside = axes.s > 0 && axes.s < 2 * a.half && axes.t > 0 && axes.t < 2 * b.half;
  if (inside && cross.norm() >= crossing_sine && beside >= most - tiny)
    roles.write(sides, sides_key, beside);
  else if (inside && beside > 0)
    roles.write(on_line(from_a + axes.s * a.axis, a.radius, b.centre, b.axis, b.radius), sides_key, beside);
  if (most > 0 || least_gap(roles) <= most + tiny || least_gap(roles) > 0) return;
  if (most == beside) return roles.write(sides, sides_key, beside);
  if (most == over_b) {
    const int end = apart.dot(b.axis) < 0 ? -1 : 1;
    return write_deepest_rim(a, b.cap(end), end * b.axis, Feature::cap, end + 1, roles);
  }
  const int end = apart.dot(a.axis) > 0 ? -1 : 1;
  write_deepest_rim(b, a.cap(end), end * a.axis, Feature::cap, end + 1, roles.exchanged());
}

}  // namespace pbd
