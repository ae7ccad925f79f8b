#include "collision/contact_point.h"

#include <Eigen/Geometry>
#include <cmath>

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

/// The point of a's rim about y that is nearest to the line through `on_line`: where the derivative of its
/// distance by the angle vanishes, by Newton's method from the point towards the line, which is off by the
/// squared sine of the axes' angle at most: by rounding after three rounds where that is a hundredth
/// (crossing_sine).
Vector3d rim_at_line(const ContactPoint& contact, const Frame& a, const Vector3d& y, const Vector3d& on_line,
                     const Vector3d& along) {
  const Vector3d axis = a.rotation * contact.direction_a, apart = across(y - on_line, along);
  const Vector3d towards = -contact.rim_a * unit_across(across(apart, axis), axis),
                 aside = axis.cross(towards);
  const Vector3d u = across(towards, along), w = across(aside, along);
  constexpr int rounds = 3;
  double angle = 0;
  for (int k = 0; k < rounds; ++k) {
    const Vector3d radial = std::cos(angle) * u + std::sin(angle) * w,
                   tangential = std::cos(angle) * w - std::sin(angle) * u;
    const double bend = tangential.squaredNorm() - (apart + radial).dot(radial);
    if (bend > 0) angle -= (apart + radial).dot(tangential) / bend;
  }
  return y + std::cos(angle) * towards + std::sin(angle) * aside;
}

}  // namespace

Touching touching(const ContactPoint& contact, const Frame& a, const Frame& b) {
  if (contact.kind == ContactPoint::Kind::edges) return at_edges(contact, a, b);
  Vector3d y_a = a.place(contact.point_a);
  const Vector3d y_b = b.place(contact.point_b), direction = b.rotation * contact.direction_b;
  if (contact.kind == ContactPoint::Kind::face) {
    y_a = on_rim(contact, a, y_a, direction);
    const double distance = direction.dot(y_a - y_b);
    return rounded(contact, distance, direction, y_a, y_a - distance * direction);
  }
  const bool line = contact.kind == ContactPoint::Kind::line;
  if (line && contact.rim_a > 0) y_a = rim_at_line(contact, a, y_a, y_b, direction);
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
