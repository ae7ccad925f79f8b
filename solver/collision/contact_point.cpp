#include "collision/contact_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision/tolerances.h"

namespace pbd {
namespace {

using Eigen::Vector3d;

/// The unit vector along `v`, which is across `axis`, or any across it where v is no more than rounding.
Vector3d unit_across(const Vector3d& v, const Vector3d& axis) {
  const double length = v.norm();
  if (!(length > 0)) return axis.unitOrthogonal();
  Vector3d unit = v / length;
  unit -= axis.dot(unit) * axis;
  const double left = unit.norm();
  constexpr double most_of_it = 0.5;  // else v was along the axis but for rounding
  return left > most_of_it ? Vector3d(unit / left) : axis.unitOrthogonal();
}

Vector3d across(const Vector3d& v, const Vector3d& axis) {
  return v - axis.dot(v) * axis;
}

/// Touching points where the features themselves touch at y_a and y_b.
Touching rounded(const ContactPoint& contact, double distance, const Vector3d& normal, const Vector3d& y_a,
                 const Vector3d& y_b) {
  return {distance - contact.radius_a - contact.radius_b, normal, y_a - contact.radius_a * normal,
          y_b + contact.radius_b * normal};
}

Touching at_edges(const ContactPoint& contact, const Frame& a, const Frame& b) {
  const Vector3d y_a = a.place(contact.point_a), y_b = b.place(contact.point_b);
  const Vector3d e_a = a.rotation * contact.direction_a, e_b = b.rotation * contact.direction_b;
  const Vector3d cross = contact.side * e_a.cross(e_b);
  const Vector3d normal = unit_across(cross, e_a);
  // Nearest points y_a + s e_a, y_b + t e_b: their difference is along the normal.
  const double cosine = e_a.dot(e_b), sine_squared = cross.squaredNorm();
  const Vector3d apart = y_b - y_a;
  const double along_a = apart.dot(e_a), along_b = apart.dot(e_b);
  const double s = sine_squared > 0 ? (along_a - cosine * along_b) / sine_squared : 0.0;
  const double t = sine_squared > 0 ? (cosine * along_a - along_b) / sine_squared : 0.0;
  return rounded(contact, -normal.dot(apart), normal, y_a + s * e_a, y_b + t * e_b);
}

/// The deepest point along -n of a's rim about y, or y where there is none. A rim that leans by no more than
/// rounding is as deep all round: its point would jump in each iteration.
Vector3d on_rim(const ContactPoint& contact, const Frame& a, const Vector3d& y, const Vector3d& n) {
  if (!(contact.rim_a > 0)) return y;
  const Vector3d axis = a.rotation * contact.direction_a, lean = across(n, axis);
  constexpr double flat = 1e-13;  // rad
  const Vector3d down =
      lean.norm() > flat ? Vector3d(-unit_across(lean, axis)) : Vector3d(a.rotation * contact.across_a);
  return y + contact.rim_a * down;
}

/// The point of a's rim about y that is nearest to x.
Vector3d rim_at_point(const ContactPoint& contact, const Frame& a, const Vector3d& y, const Vector3d& x) {
  const Vector3d axis = a.rotation * contact.direction_a;
  return y + contact.rim_a * unit_across(across(x - y, axis), axis);
}

/// The point of b's line or rim that is nearest to another one, x: q, and how it follows x,
/// dq/dx = share * tangent tangent^T.
struct NearestOfOther {
  Vector3d point, tangent;
  Vector3d outward = Vector3d::Zero();  // of a rim, as that of a's
  double share = 1;

  NearestOfOther(const ContactPoint& contact, const Frame& b, const Vector3d& x) {
    const Vector3d y = b.place(contact.point_b), direction = b.rotation * contact.direction_b;
    if (!(contact.rim_b > 0)) {
      tangent = direction;
      point = y + direction.dot(x - y) * direction;
      return;
    }
    const Vector3d aside = across(x - y, direction), out = unit_across(aside, direction);
    tangent = direction.cross(out);
    outward = direction + out;
    point = y + contact.rim_b * out;
    share = contact.rim_b / std::max(aside.norm(), contact.rim_b);
  }
};

/// A point of a's rim and the other's nearest to it.
struct RimPair {
  Vector3d axis, out, tangent;  // unit, of a's rim
  Vector3d y;                   // m
  NearestOfOther other;

  RimPair(const ContactPoint& contact, const Frame& a, const Frame& b, double angle)
      : axis(a.rotation * contact.direction_a),
        out(turned(contact, a, angle)),
        tangent(axis.cross(out)),
        y(a.place(contact.point_a) + contact.rim_a * out),
        other(contact, b, y) {}

  Vector3d apart() const { return y - other.point; }

  bool parallel() const { return !(tangent.cross(other.tangent).norm() > parallel_to_rim); }

  /// From b to a: across both tangents, where these are parallel along what parts the points. What touches a
  /// rim does so between its cap and its side.
  Vector3d normal() const {
    const bool as_points = parallel() && apart().norm() > 0;
    const Vector3d along =
        as_points ? Vector3d(apart().normalized()) : unit_across(tangent.cross(other.tangent), tangent);
    return (axis + out - other.outward).dot(along) > 0 ? Vector3d(-along) : along;
  }

  /// How the slope of their distance changes as the point goes along the rim, m: by how they cross, and by
  /// its bend. Where they are in each other the point of no slope may be the farthest one; else it is the
  /// nearest, and the change is kept above 0.
  double bend(double rim, bool overlap) const {
    const double crossing = tangent.dot(other.tangent), met = rim * (1 - other.share * crossing * crossing);
    const double bend = met - apart().dot(out);
    return overlap && bend < 0 ? std::min(bend, -met / 2) : std::max(bend, met / 2);
  }

  static Vector3d turned(const ContactPoint& contact, const Frame& a, double angle) {
    return a.rotation * (std::cos(angle) * contact.across_a +
                         std::sin(angle) * contact.direction_a.cross(contact.across_a));
  }
};

/// a's rim against b's line or rim, at the pair of nearest points next to R_a across_a.
Touching at_rim(const ContactPoint& contact, const Frame& a, const Frame& b) {
  constexpr int most_rounds = 20, most_halvings = 8;
  constexpr double longest = 0.5, enough = 1e-15;  // rad
  double angle = 0;
  RimPair pair(contact, a, b, angle);
  for (int round = 0; round < most_rounds; ++round) {
    const double bend = pair.bend(contact.rim_a, pair.normal().dot(pair.apart()) < 0);
    if (bend == 0) break;
    double turn = std::clamp(-pair.apart().dot(pair.tangent) / bend, -longest, longest);
    if (!(std::abs(turn) > enough)) break;
    const double most = bend > 0 ? pair.apart().norm() + enough * contact.rim_a : infinity;
    RimPair next(contact, a, b, angle + turn);
    for (int halving = 0; halving < most_halvings && next.apart().norm() > most; ++halving) {
      turn /= 2;
      next = RimPair(contact, a, b, angle + turn);
    }
    if (next.apart().norm() > most) break;  // it is there but for rounding
    angle += turn;
    pair = next;
  }
  const double beside = -pair.out.dot(pair.apart()), beyond = -pair.axis.dot(pair.apart());
  if (!(contact.rim_b > 0) && pair.parallel() && !(beside >= 0 && beyond >= 0)) {
    const Vector3d normal = beside > beyond ? -pair.out : -pair.axis;
    const double gap = std::max(beside, beyond);
    return rounded(contact, gap, normal, pair.other.point + gap * normal, pair.other.point);
  }
  const Vector3d normal = pair.normal();
  return rounded(contact, normal.dot(pair.apart()), normal, pair.y, pair.other.point);
}

}  // namespace

Touching touching(const ContactPoint& contact, const Frame& a, const Frame& b) {
  if (contact.kind == ContactPoint::Kind::edges) return at_edges(contact, a, b);
  if (contact.kind == ContactPoint::Kind::rim) return at_rim(contact, a, b);
  Vector3d y_a = a.place(contact.point_a);
  const Vector3d y_b = b.place(contact.point_b), direction = b.rotation * contact.direction_b;
  if (contact.kind == ContactPoint::Kind::face) {
    y_a = on_rim(contact, a, y_a, direction);
    const double distance = direction.dot(y_a - y_b);
    return rounded(contact, distance, direction, y_a, y_a - distance * direction);
  }
  const bool line = contact.kind == ContactPoint::Kind::line;
  if (contact.rim_a > 0) y_a = rim_at_point(contact, a, y_a, y_b);
  const Vector3d apart = line ? across(y_a - y_b, direction) : Vector3d(y_a - y_b);
  const double distance = apart.norm();
  Vector3d normal = Vector3d::UnitX();
  if (line)
    normal = unit_across(apart, direction);
  else if (distance > 0)
    normal = apart / distance;
  return rounded(contact, distance, normal, y_a, y_a - distance * normal);
}

ContactPoint placed(const ContactPoint& contact, const Frame& a, const Frame& b) {
  ContactPoint moved = contact;
  moved.point_a = a.place(contact.point_a);
  moved.point_b = b.place(contact.point_b);
  moved.direction_a = a.rotation * contact.direction_a;
  moved.direction_b = b.rotation * contact.direction_b;
  moved.across_a = a.rotation * contact.across_a;
  return moved;
}

}  // namespace pbd
