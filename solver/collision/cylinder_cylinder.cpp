#include "collision/cylinder_cylinder.h"

#include <array>
#include <optional>

#include "collision/cylinder_features.h"
#include "collision/tolerances.h"

namespace pbd {
namespace {

/// a's rim at `end` at the angle where it is nearest to b, against b's nearest part that it is beside there,
/// gaps at least `floor` (m).
void write_rim_point(const PlacedCylinder& a, int end, double angle, int number, const PlacedCylinder& b,
                     double floor, const ContactWriter& writer) {
  const double tiny = rounding * (a.size() + b.size());
  const Vec3 y = a.on_rim(end, angle);
  const PlacedCylinder::Place at = b.place(y);
  if (at.distance < floor) return;
  if (at.part == PlacedCylinder::Part::cap) return write_point(y, 0, Feature::rim, number, b, writer);
  const auto write = [&](const ContactPoint& contact, FeatureName of_b) {
    const Touching found = touching(contact, {}, {});
    const bool beside = of_b.of == Feature::rim ? b.is_beside_rim(of_b.i - 1, found.point_b, found.normal)
                                                : std::abs(b.axis.dot(found.point_b - b.centre)) <= b.half;
    if (!beside || found.gap < floor || !a.is_beside_rim(end, found.point_a, -found.normal)) return false;
    // Rims on each other all along say nothing that caps and sides do not.
    if (of_b.of == Feature::rim && found.gap < tiny &&
        a.rim_tangent(found.point_a).cross(b.rim_tangent(found.point_b)).norm() < parallel_to_rim)
      return false;
    writer.write(contact, writer.key(Feature::rim, number, of_b.of, of_b.i), found.gap);
    return true;
  };
  if (at.part == PlacedCylinder::Part::side &&
      write(rim_on_line(a, end, y, b.centre, b.axis, b.radius), {Feature::axis, 0}))
    return;
  const int end_b = b.end_at(y);
  write(rim_on_rim(a, end, y, b, end_b), {Feature::rim, end_b + 1});
}

/// a's rims and the points of its caps against b's caps and sides.
void rims_on_cylinder(const PlacedCylinder& a, const PlacedCylinder& b, double floor,
                      const ContactWriter& writer) {
  const double slack = rounding * (a.size() + b.size());
  const auto over = [&](const Vec3& x) { return (x - b.centre).cross(b.axis).norm() <= b.radius + slack; };
  for (const int end : {-1, 1})
    write_rims(a, b.cap(end), end * b.axis, 0, Feature::cap, end + 1, floor, writer, over, over);
  for (const int end : {-1, 1}) {
    const NearestAngles angles = nearest_angles(a, end, b, writer.reach.margin);
    const bool side = (a.on_rim(end, angles.angle[0]) - a.cap(end)).dot(b.axis) > 0;
    for (int k = 0; k < angles.count; ++k)
      write_rim_point(a, end, angles.angle[k], nearest_of_rim(end, side == (k == 0)), b, floor, writer);
  }
}

/// A direction along which they may be apart.
struct Way {
  double apart = -infinity;  // m; negative: they overlap by as much
  Vec3 normal = Vec3::Zero();
};

/// What is between them along the unit vector, m; negative: they overlap.
double apart_along(const PlacedCylinder& a, const PlacedCylinder& b, const Vec3& normal) {
  return normal.dot(a.centre - b.centre) - a.support(normal) - b.support(normal);
}

/// Takes the direction, turned from b to a, if they are farther apart along it, and it is longer than
/// `least`.
void consider(const PlacedCylinder& a, const PlacedCylinder& b, const Vec3& across, double least, Way& best) {
  if (!(across.norm() > least)) return;
  const Vec3 normal = (across.dot(a.centre - b.centre) < 0 ? -1 : 1) * across.normalized();
  const double here = apart_along(a, b, normal);
  if (here > best.apart + rounding * (a.size() + b.size())) best = {here, normal};
}

/// Looks at the points of `own`'s rims that are nearest to the other, or deepest in it: along the other's
/// normal there, and across both rims. `own` is a or b.
void look_along_rims(const PlacedCylinder& own, const PlacedCylinder& other, const PlacedCylinder& a,
                     const PlacedCylinder& b, Way& best) {
  for (const int end : {-1, 1})
    for (const double angle : nearest_angles(own, end, other, infinity)) {
      const Vec3 y = own.on_rim(end, angle);
      consider(a, b, other.place(y).normal, rounding, best);
      consider(a, b, own.rim_tangent(y).cross(other.rim_tangent(y)), rounding, best);
    }
}

/// To a local maximum of what is between them, uphill from the direction: Newton's method on the sphere,
/// where the slope is what lies between their farthest points, and rims bend it by radius over sine of the
/// angle to the axis. The sphere bends it the other way where they overlap; its part is taken with the sign
/// that leads uphill.
void climb(const PlacedCylinder& a, const PlacedCylinder& b, Way& way) {
  constexpr int most_steps = 30, most_halvings = 5;
  for (int k = 0; k < most_steps; ++k) {
    const Vec3 n = way.normal;
    Vec3 between = a.centre - b.centre;
    const Eigen::Matrix3d along_n = n * n.transpose();
    Eigen::Matrix3d bend = a.radius * along_n + std::abs(way.apart) * (Eigen::Matrix3d::Identity() - along_n);
    for (const PlacedCylinder* own : {&a, &b}) {
      const Vec3 aside = n - n.dot(own->axis) * own->axis;
      const double sine = aside.norm();
      if (!(sine > rounding)) return;
      const Vec3 along = own->axis.cross(aside / sine);
      between -= (n.dot(own->axis) < 0 ? -1 : 1) * own->half * own->axis + own->radius * aside / sine;
      bend += own->radius / sine * along * along.transpose();
    }
    const Vec3 move = bend.inverse() * (between - between.dot(n) * n);
    Way next;
    double share = 2;
    for (int i = 0; i < most_halvings && !(next.apart > way.apart); ++i) {
      share /= 2;
      next.normal = (n + share * move).normalized();
      next.apart = apart_along(a, b, next.normal);
    }
    if (!(next.apart > way.apart)) return;
    way = next;
    if (!(share * move.norm() > rounding)) return;
  }
}

/// The rims that are deepest along the normal, along which they are `apart` (m); or one of them and a plane
/// where they are not, as next to a side.
void write_across_rims(const PlacedCylinder& a, const PlacedCylinder& b, const Vec3& normal, double apart,
                       std::uint64_t key, const ContactWriter& writer) {
  const int end_a = a.axis.dot(normal) > 0 ? -1 : 1, end_b = b.axis.dot(normal) > 0 ? 1 : -1;
  const ContactPoint rims = rim_on_rim(a, end_a, a.farthest(-normal), b, end_b);
  const double gap = touching(rims, {}, {}).gap;
  const bool deepest = std::abs(gap - apart) <= rounding * (a.size() + b.size());
  writer.rewrite(deepest ? rims : on_plane_by_rim(a, end_a, b.farthest(normal), normal, 0), key, apart);
}

/// a's rim at `end`, its point nearest to b's axis, against b's side.
ContactPoint on_side_by_rim(const PlacedCylinder& a, int end, const PlacedCylinder& b) {
  const Vec3 apart = a.cap(end) - b.centre, across = apart - apart.dot(b.axis) * b.axis;
  return rim_on_line(a, end, a.cap(end) + a.radius * (across.dot(a.axis) * a.axis - across).normalized(),
                     b.centre, b.axis, b.radius);
}

/// Of sides along each other the ends of their common length, each a rim over the other's side; false, and
/// nothing is written, if they have none.
bool write_common_length(const PlacedCylinder& a, const PlacedCylinder& b, double slack,
                         const ContactWriter& writer) {
  struct End {
    ContactPoint contact;
    ContactWriter writer;
    std::uint64_t key;
  };
  std::array<std::optional<End>, 2> ends;
  const auto look = [&](const PlacedCylinder& one, int end, const PlacedCylinder& other,
                        const ContactWriter& own, std::optional<End>& found) {
    if (found) return;
    const ContactPoint contact = on_side_by_rim(one, end, other);
    const double along = other.axis.dot(touching(contact, {}, {}).point_a - other.centre);
    if (std::abs(along) <= other.half + slack)
      found.emplace(End{contact, own, own.key(Feature::rim, rim_point(end, rim_points), Feature::axis, 0)});
  };
  const int same = a.axis.dot(b.axis) > 0 ? 1 : -1;
  for (const int end : {0, 1}) {
    const int sign = 2 * end - 1;
    look(a, sign * same, b, writer, ends[end]);
    look(b, sign, a, writer.exchanged(), ends[end]);
    if (!ends[end]) return false;
  }
  for (const auto& end : ends) end->writer.write(end->contact, end->key, touching(end->contact, {}, {}).gap);
  return true;
}

}  // namespace

void cylinder_cylinder(const Cylinder& first, const Cylinder& second, const ContactWriter& writer) {
  const PlacedCylinder a(first, writer.frame_a), b(second, writer.frame_b);
  const double tiny = rounding * (a.size() + b.size());
  const Vec3 apart = a.centre - b.centre, cross = a.axis.cross(b.axis);
  const Vec3 from_a = a.cap(-1), from_b = b.cap(-1);
  const Nearest axes = nearest(Segment{from_a, a.axis, 2 * a.half}, Segment{from_b, b.axis, 2 * b.half});
  const bool inside = axes.s > 0 && axes.s < 2 * a.half && axes.t > 0 && axes.t < 2 * b.half;
  constexpr double parallel = 1e-5;  // sine: the product of the axes is known to 1e-11 of itself
  const double sine = cross.norm();
  const bool crossed = sine >= crossing_sine;

  // Directions along which they may be apart: the caps', and across their sides.
  const double over_b = std::abs(apart.dot(b.axis)) - a.support(b.axis) - b.half;
  const double over_a = std::abs(apart.dot(a.axis)) - b.support(a.axis) - a.half;
  Way beside;
  if (sine >= parallel) consider(a, b, cross, 0, beside);
  const double along_both = beside.apart;
  consider(a, b, axes.apart, tiny, beside);
  consider(a, b, apart - apart.dot(b.axis) * b.axis, tiny, beside);
  if (beside.apart == -infinity) consider(a, b, b.across, 0, beside);
  double most = std::max({over_a, over_b, beside.apart});
  if (most >= writer.reach.margin) return;
  Way rims;
  if (most <= 0) {
    look_along_rims(a, b, a, b, rims);
    look_along_rims(b, a, a, b, rims);
    climb(a, b, rims);
  }
  const bool by_rims = rims.apart > most + tiny;
  if (by_rims) most = rims.apart;

  const Vec3 y_a = from_a + axes.s * a.axis;
  const ContactPoint edges =
      on_edges(y_a, a.axis, a.radius, from_b + axes.t * b.axis, b.axis, b.radius, beside.normal);
  const ContactPoint line = on_line(y_a, a.radius, b.centre, b.axis, b.radius);
  const auto sides_key = writer.key(Feature::axis, 0, Feature::axis, 0);
  const double along_line = axes.apart.norm() - a.radius - b.radius;
  const bool shallow = beside.apart > -std::min(a.radius, b.radius);  // each axis beside the other cylinder
  if (!crossed && shallow && beside.apart == most && write_common_length(a, b, tiny, writer)) {
    if (inside && along_line < writer.least() - tiny) writer.write(line, sides_key, along_line);
    return;
  }
  rims_on_cylinder(a, b, most - tiny, writer);
  rims_on_cylinder(b, a, most - tiny, writer.exchanged());
  if (inside && crossed && along_both >= most - tiny) writer.write(edges, sides_key, along_both);
  if (inside && !crossed && along_line > 0) writer.write(line, sides_key, along_line);
  const double least = writer.least();
  // Without a rim in the other, they overlap where their sides cross or one goes through the other.
  const auto goes_through = [&](const PlacedCylinder& own, const PlacedCylinder& other) {
    const Segment axis{own.cap(-1), own.axis, 2 * own.half};
    return other.place(axis.at(nearest_arc(axis, other))).distance <= tiny;
  };
  const bool crossing = (inside && along_line < 0) || goes_through(a, b) || goes_through(b, a);
  if (most > 0 || least <= most + tiny || (least > 0 && least < infinity && !crossing)) return;
  if (most == along_both) return writer.write(edges, sides_key, most);
  if (most == beside.apart || by_rims)
    return write_across_rims(a, b, by_rims ? rims.normal : beside.normal, most, sides_key, writer);
  if (most == over_b) {
    const int end = apart.dot(b.axis) < 0 ? -1 : 1;
    return write_deepest_rim(a, b.cap(end), end * b.axis, Feature::cap, end + 1, writer);
  }
  const int end = apart.dot(a.axis) > 0 ? -1 : 1;
  write_deepest_rim(b, a.cap(end), end * a.axis, Feature::cap, end + 1, writer.exchanged());
}

}  // namespace pbd
