#include "collision/cylinder_cylinder.h"

#include <array>
#include <optional>

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
    const NearestAngles angles = nearest_angles(a, end, b, writer.reach.margin);
    const auto side = [&](const Vec3& y) { return (y - a.cap(end)).dot(b.axis) > 0; };
    for (int k = 0; k < angles.count; ++k) {
      const Vec3 y = a.on_rim(end, angles.angle[k]);
      const bool taken = k > 0 && side(y) == side(a.on_rim(end, angles.angle[0]));
      write_point(y, 0, Feature::rim, nearest_of_rim(end, side(y) != taken), b, writer);
    }
  }
}

/// A direction along which they may be apart.
struct Way {
  double apart = -infinity;  // m; negative: they overlap by as much
  Vec3 normal = Vec3::Zero();
};

/// The best of b's normals at the points of a's rims that are nearest to it, or deepest in it, and of those
/// across both rims there; `towards` a first shape from a second, whichever a is.
void look_along_rims(const PlacedCylinder& a, const PlacedCylinder& b, const Vec3& towards, Way& best) {
  const auto look = [&](const Vec3& across) {
    if (!(across.norm() > rounding)) return;
    const Vec3 normal = (across.dot(towards) < 0 ? -1 : 1) * across.normalized();
    const double here = normal.dot(towards) - a.support(normal) - b.support(normal);
    if (here > best.apart) best = {here, normal};
  };
  for (const int end : {-1, 1})
    for (const double angle : nearest_angles(a, end, b, infinity)) {
      const Vec3 y = a.on_rim(end, angle);
      look(b.place(y).normal);
      look(a.axis.cross(y - a.cap(end)).normalized().cross(b.rim_tangent(y)));
    }
}

/// What is between them along the unit vector, m; negative: they overlap.
double apart_along(const PlacedCylinder& a, const PlacedCylinder& b, const Vec3& normal) {
  return normal.dot(a.centre - b.centre) - a.support(normal) - b.support(normal);
}

/// To the direction next to it along which they are farthest apart: Newton's method on the sphere, where the
/// slope is what lies between their farthest points, and rims bend it by radius over sine of the angle to
/// the axis.
void climb(const PlacedCylinder& a, const PlacedCylinder& b, Way& way) {
  constexpr int most_steps = 10, most_halvings = 5;
  for (int k = 0; k < most_steps; ++k) {
    const Vec3 n = way.normal;
    Vec3 between = a.centre - b.centre;
    const Eigen::Matrix3d along_n = n * n.transpose();
    Eigen::Matrix3d bend = a.radius * along_n + way.apart * (Eigen::Matrix3d::Identity() - along_n);
    for (const PlacedCylinder* own : {&a, &b}) {
      const Vec3 aside = n - n.dot(own->axis) * own->axis;
      const double sine = aside.norm();
      if (!(sine > rounding)) return;
      const Vec3 along = own->axis.cross(aside / sine);
      between -= (n.dot(own->axis) < 0 ? -1 : 1) * own->half * own->axis + own->radius * aside / sine;
      bend += own->radius / sine * along * along.transpose();
    }
    const Vec3 move = bend.inverse() * (between - between.dot(n) * n);
    double share = 1;
    for (int i = 0; i < most_halvings && way.normal == n; ++i, share /= 2) {
      const Vec3 next = (n + share * move).normalized();
      if (const double here = apart_along(a, b, next); here > way.apart) way = {here, next};
    }
    if (way.normal == n || !(share * move.norm() > rounding)) return;
  }
}

/// What they overlap by along a normal that is no feature's own, at the deepest points of both.
ContactPoint across_rims(const PlacedCylinder& a, const PlacedCylinder& b, const Vec3& normal) {
  return on_plane_by_rim(a, a.axis.dot(normal) > 0 ? -1 : 1, b.farthest(normal), normal, 0);
}

/// a's rim at `end`, its point nearest to b's axis, against b's side.
ContactPoint on_side_by_rim(const PlacedCylinder& a, int end, const PlacedCylinder& b) {
  ContactPoint contact = on_line(a.cap(end), 0, b.centre, b.axis, b.radius);
  contact.direction_a = a.axis;
  contact.rim_a = a.radius;
  return contact;
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
  Vec3 normal;
  double beside = -infinity;
  const auto look = [&](const Vec3& across, double least) {
    if (!(across.norm() > least)) return;
    const Vec3 unit = (across.dot(apart) < 0 ? -1 : 1) * across.normalized();
    const double here = unit.dot(apart) - a.support(unit) - b.support(unit);
    if (here > beside + tiny) beside = here, normal = unit;
  };
  if (sine >= parallel) look(cross, 0);
  const double along_both = beside;
  look(axes.apart, tiny);
  look(apart - apart.dot(b.axis) * b.axis, tiny);
  if (beside == -infinity) look(b.across, 0);
  double most = std::max({over_a, over_b, beside});
  if (most >= writer.reach.margin) return;
  Way rims;
  if (most <= 0) {
    look_along_rims(a, b, apart, rims);
    look_along_rims(b, a, apart, rims);
    climb(a, b, rims);
  }
  const bool by_rims = rims.apart > most + tiny;
  if (by_rims) most = rims.apart;

  const Vec3 y_a = from_a + axes.s * a.axis;
  const ContactPoint edges =
      on_edges(y_a, a.axis, a.radius, from_b + axes.t * b.axis, b.axis, b.radius, normal);
  const ContactPoint line = on_line(y_a, a.radius, b.centre, b.axis, b.radius);
  const auto sides_key = writer.key(Feature::axis, 0, Feature::axis, 0);
  const double along_line = axes.apart.norm() - a.radius - b.radius;
  const bool shallow = beside > -std::min(a.radius, b.radius);  // each axis beside the other cylinder
  if (!crossed && shallow && beside == most && write_common_length(a, b, tiny, writer)) {
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
  if (most > 0 || least <= most + tiny || (least > 0 && !crossing)) return;
  if (most == beside && beside == along_both) return writer.write(edges, sides_key, most);
  if (most == beside || by_rims)
    return writer.rewrite(across_rims(a, b, by_rims ? rims.normal : normal), sides_key, most);
  if (most == over_b) {
    const int end = apart.dot(b.axis) < 0 ? -1 : 1;
    return write_deepest_rim(a, b.cap(end), end * b.axis, Feature::cap, end + 1, writer);
  }
  const int end = apart.dot(a.axis) > 0 ? -1 : 1;
  write_deepest_rim(b, a.cap(end), end * a.axis, Feature::cap, end + 1, writer.exchanged());
}

}  // namespace pbd
