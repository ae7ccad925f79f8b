#include "collision/cylinder_cylinder.h"

#include "collision/cylinder_features.h"
#include "collision/tolerances.h"

namespace pbd {
namespace {

/// a's rims and the points of its caps against b's caps and sides.
void rims_on_cylinder(const PlacedCylinder& a, const PlacedCylinder& b, double floor,
                      const ContactWriter& writer) {
  const double slack = rounding * (a.size() + b.size());
  for (const int end : {-1, 1})
    write_rims(a, b.cap(end), end * b.axis, 0, Feature::cap, end + 1, floor, writer,
               [&](const Vec3& x) { return (x - b.centre).cross(b.axis).norm() <= b.radius + slack; });
  for (const int end : {-1, 1}) {
    const Vec3 y = a.on_rim(end, nearest_angle(a, end, b));
    write_point(y, 0, Feature::rim, end + 1, b, writer);
  }
}

}  // namespace

void cylinder_cylinder(const Cylinder& first, const Cylinder& second, const ContactWriter& writer) {
  const PlacedCylinder a(first, writer.frame_a), b(second, writer.frame_b);
  const double tiny = rounding * (a.size() + b.size());
  const Vec3 apart = a.centre - b.centre, cross = a.axis.cross(b.axis);
  // The caps' planes and the plane along both axes.
  const double over_b = std::abs(apart.dot(b.axis)) - a.support(b.axis) - b.half;
  const double over_a = std::abs(apart.dot(a.axis)) - b.support(a.axis) - a.half;
  const Vec3 from_a = a.cap(-1), from_b = b.cap(-1);
  const Nearest axes = nearest(Segment{from_a, a.axis, 2 * a.half}, Segment{from_b, b.axis, 2 * b.half});
  const bool inside = axes.s > 0 && axes.s < 2 * a.half && axes.t > 0 && axes.t < 2 * b.half;
  constexpr double parallel = 1e-5;  // sine: the product of the axes is known to 1e-11 of itself
  const double sine = cross.norm();
  const bool crossed = sine >= crossing_sine;
  Vec3 normal = sine >= parallel ? cross : inside ? axes.apart : Vec3(apart - apart.dot(b.axis) * b.axis);
  normal = normal.norm() > 0 ? Vec3(normal / normal.norm()) : b.across;
  if (normal.dot(apart) < 0) normal = -normal;
  const double beside = normal.dot(apart) - a.support(normal) - b.support(normal);
  const double most = std::max({over_a, over_b, beside});
  if (most >= writer.reach.margin) return;
  rims_on_cylinder(a, b, most - tiny, writer);
  rims_on_cylinder(b, a, most - tiny, writer.exchanged());
  const Vec3 y_a = from_a + axes.s * a.axis;
  const ContactPoint edges =
      on_edges(y_a, a.axis, a.radius, from_b + axes.t * b.axis, b.axis, b.radius, normal);
  const ContactPoint line = on_line(y_a, a.radius, b.centre, b.axis, b.radius);
  const auto sides_key = writer.key(Feature::axis, 0, Feature::axis, 0);
  const double along_line = axes.apart.norm() - a.radius - b.radius;
  if (inside && crossed && beside >= most - tiny) writer.write(edges, sides_key, beside);
  if (inside && !crossed && along_line > 0) writer.write(line, sides_key, along_line);
  const double least = writer.least();
  // Without a rim in the other, they overlap where their sides cross or one goes through the other.
  const bool crossing = (inside && along_line < 0) || b.place(from_a + axes.s * a.axis).distance <= tiny ||
                        a.place(from_b + axes.t * b.axis).distance <= tiny;
  if (most > 0 || least <= most + tiny || (least > 0 && !crossing)) return;
  if (most == beside) return writer.write(sine >= parallel ? edges : line, sides_key, most);
  if (most == over_b) {
    const int end = apart.dot(b.axis) < 0 ? -1 : 1;
    return write_deepest_rim(a, b.cap(end), end * b.axis, Feature::cap, end + 1, writer);
  }
  const int end = apart.dot(a.axis) > 0 ? -1 : 1;
  write_deepest_rim(b, a.cap(end), end * a.axis, Feature::cap, end + 1, writer.exchanged());
}

}  // namespace pbd
