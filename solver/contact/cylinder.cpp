// Cylinders against half spaces and cylinders.
#include "contact/pairs.h"
#include "contact/round.h"

namespace pbd {
namespace {

constexpr double pi = 3.14159265358979323846;

/// The angle of a's rim that is nearest to (or deepest in) b: about the least of 16
/// samples, where the distance's slope changes its sign.
double nearest_angle(const Round& a, int end, const Round& b) {
  constexpr int samples = 16, halvings = 52;
  constexpr double part = 2 * pi / samples;
  const auto distance = [&](double angle) { return b.place(a.on_rim(end, angle)).distance; };
  std::array<double, samples> sampled{};
  for (int k = 0; k < samples; ++k) sampled[static_cast<std::size_t>(k)] = distance(k * part);
  double best = 0, least = infinity;
  for (int k = 0; k < samples; ++k) {
    const double here = sampled[static_cast<std::size_t>(k)];
    const double before = sampled[static_cast<std::size_t>((k + samples - 1) % samples)];
    const double after = sampled[static_cast<std::size_t>((k + 1) % samples)];
    const bool level = std::max(before, after) - here < rounding * a.radius;
    if (level && here < least) {
      least = here;
      best = k * part;
    }
    if (level || here > before || here > after || here - part * a.radius > least) continue;
    double low = (k - 1) * part, high = (k + 1) * part;
    for (int halving = 0; halving < halvings; ++halving) {
      const double middle = (low + high) / 2;
      const Vec3 y = a.on_rim(end, middle), along = a.axis.cross(y - a.cap(end));
      (b.place(y).normal.dot(along) < 0 ? low : high) = middle;
    }
    const double found = distance(low);
    if (found >= least) continue;
    least = found;
    best = low;
  }
  return best;
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

}  // namespace

double nearest_arc(const Segment& edge, const Round& b) {
  const auto slope = [&](double s) {
    const Round::Place at = b.place(edge.at(s));
    return at.distance > 0 ? edge.along.dot(at.normal) : 0.0;
  };
  double low = 0, high = edge.length;
  if (slope(low) >= 0) return low;
  if (slope(high) <= 0) return high;
  constexpr int halvings = 60;
  for (int k = 0; k < halvings; ++k) {
    const double middle = (low + high) / 2, here = slope(middle);
    if (here == 0) return middle;
    (here < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

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

void write_deepest_rim(const Round& a, const Vec3& on_plane, const Vec3& normal, Feature feature, int j,
                       const Roles& roles) {
  const int end = a.axis.dot(normal) > 0 ? -1 : 1;
  ContactPoint contact = on_face(a.cap(end), 0, on_plane, normal, 0);
  contact.direction_a = a.axis;
  contact.rim_a = a.radius;
  roles.write(contact, roles.key(Feature::rim, 9 * (end + 1) + 8, feature, j), touching(contact, {}, {}).gap);
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
  const Vec3 from_a = a.cap(-1), from_b = b.cap(-1);
  const Nearest axes = nearest(Segment{from_a, a.axis, 2 * a.half}, Segment{from_b, b.axis, 2 * b.half});
  const bool inside = axes.s > 0 && axes.s < 2 * a.half && axes.t > 0 && axes.t < 2 * b.half;
  constexpr double parallel = 1e-5;
  const double sine = cross.norm();
  const bool crossed = sine >= crossing_sine;
  Vec3 normal = sine >= parallel ? cross : inside ? axes.apart : Vec3(apart - apart.dot(b.axis) * b.axis);
  normal = normal.norm() > 0 ? Vec3(normal / normal.norm()) : b.axis.unitOrthogonal();
  if (normal.dot(apart) < 0) normal = -normal;
  const double beside = normal.dot(apart) - a.support(normal) - b.support(normal);
  const double most = std::max({over_a, over_b, beside});
  if (most >= roles.margin) return;
  rims_on_cylinder(a, b, most - tiny, roles);
  rims_on_cylinder(b, a, most - tiny, roles.exchanged());
  const Vec3 y_a = from_a + axes.s * a.axis;
  const ContactPoint edges =
      on_edges(y_a, a.axis, a.radius, from_b + axes.t * b.axis, b.axis, b.radius, normal);
  const ContactPoint line = on_line(y_a, a.radius, b.centre, b.axis, b.radius);
  const auto sides_key = roles.key(Feature::axis, 0, Feature::axis, 0);
  const double along_line = axes.apart.norm() - a.radius - b.radius;
  if (inside && crossed && beside >= most - tiny) roles.write(edges, sides_key, beside);
  if (inside && !crossed && along_line > 0) roles.write(line, sides_key, along_line);
  const double least = roles.least();
  // Without a rim in the other, they overlap where their sides cross or one goes through the other.
  const bool crossing = (inside && along_line < 0) || b.place(from_a + axes.s * a.axis).distance <= tiny ||
                        a.place(from_b + axes.t * b.axis).distance <= tiny;
  if (most > 0 || least <= most + tiny || (least > 0 && !crossing)) return;
  if (most == beside) return roles.write(sine >= parallel ? edges : line, sides_key, most);
  if (most == over_b) {
    const int end = apart.dot(b.axis) < 0 ? -1 : 1;
    return write_deepest_rim(a, b.cap(end), end * b.axis, Feature::cap, end + 1, roles);
  }
  const int end = apart.dot(a.axis) > 0 ? -1 : 1;
  write_deepest_rim(b, a.cap(end), end * a.axis, Feature::cap, end + 1, roles.exchanged());
}

}  // namespace pbd
