// What each joint of rigid bodies is: its constraint value, stated once for numbers and for jets.
//
// A body enters by its frame, position x and unit quaternion q; R u = u + 2 w (v x u) + 2 v x (v x u) with
// q = (w, v); y = x + R p. Indices a, b as in scene.h:
//
//   point          y_b - y_a (3 rows, m); an attachment is one whose b is a node
//   axis           t . R_b u_b for the two normals t of a's axis (2 rows)
//   perpendicular  R_a u_a . R_b u_b (1 row)
//   rotation       2 vec(r* q_a* q_b), scalar part >= 0 (3 rows)
//   line           t . (y_b - y_a) for the two normals t of a's axis (2 rows, m)
//   distance       |y_b - y_a| - rest (1 row, m)
//   angle          atan2(u . (e x f), e . f) - rest in (-pi, pi], e and f the references (1 row, rad)
//   slide          R_a u_a . (y_b - y_a) - rest (1 row, m)
#pragma once

#include <numbers>

#include "constraint_values.h"
#include "rigid_model.h"

namespace pbd::reference {

template <class T>
struct Quaternion {
  T w{1.0};
  Triple<T> v{};
};

template <class T>
Quaternion<T> product(const Quaternion<T>& a, const Quaternion<T>& b) {
  const Triple<T> across = cross(a.v, b.v);
  Quaternion<T> result{a.w * b.w - dot(a.v, b.v), {}};
  for (std::size_t i = 0; i < 3; ++i) result.v[i] = a.w * b.v[i] + b.w * a.v[i] + across[i];
  return result;
}

template <class T>
Quaternion<T> conjugate(const Quaternion<T>& q) {
  return {q.w, {q.v[0] * -1.0, q.v[1] * -1.0, q.v[2] * -1.0}};
}

template <class T>
Quaternion<T> constant(const Eigen::Quaterniond& q) {
  return {T(q.w()), {T(q.x()), T(q.y()), T(q.z())}};
}

/// A body's position and orientation as numbers of type T.
template <class T>
struct JointFrame {
  Triple<T> x;
  Quaternion<T> q;

  Triple<T> turned(const Vec3& own) const {
    const Triple<T> u{T(own.x()), T(own.y()), T(own.z())};
    const Triple<T> once = cross(q.v, u), twice = cross(q.v, once);
    Triple<T> result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = u[i] + 2.0 * (q.w * once[i] + twice[i]);
    return result;
  }
  Triple<T> point(const Vec3& own) const {
    Triple<T> y = turned(own);
    for (std::size_t i = 0; i < 3; ++i) y[i] = x[i] + y[i];
    return y;
  }
};

inline double value_of(double number) {
  return number;
}
template <int D, int Order>
double value_of(const Jet<D, Order>& jet) {
  return jet.value;
}

/// c of a joint at `time` (s), the first `rows` entries.
template <class T>
std::array<T, 3> joint_value(const Joint& joint, const JointFrame<T>& a, const JointFrame<T>& b,
                             double time) {
  using std::atan2;
  const auto gap = [&] { return minus(b.point(joint.point[1]), a.point(joint.point[0])); };
  const T rest(joint.rest + joint.rate * time);
  switch (joint.kind) {
    case JointKind::point:
      return gap();
    case JointKind::axis: {
      const Triple<T> u = b.turned(joint.axis[1]);
      return {dot(a.turned(joint.normal[0]), u), dot(a.turned(joint.normal[1]), u), T(0)};
    }
    case JointKind::perpendicular:
      return {dot(a.turned(joint.axis[0]), b.turned(joint.axis[1])), T(0), T(0)};
    case JointKind::rotation: {
      const Quaternion<T> error =
          product(conjugate(constant<T>(joint.rotation)), product(conjugate(a.q), b.q));
      const double twice = value_of(error.w) < 0 ? -2 : 2;
      return {twice * error.v[0], twice * error.v[1], twice * error.v[2]};
    }
    case JointKind::line:
      return {dot(a.turned(joint.normal[0]), gap()), dot(a.turned(joint.normal[1]), gap()), T(0)};
    case JointKind::distance:
      return {length(gap()) - rest, T(0), T(0)};
    case JointKind::angle: {
      const Triple<T> e = a.turned(joint.reference[0]), f = b.turned(joint.reference[1]);
      const T angle = atan2(dot(a.turned(joint.axis[0]), cross(e, f)), dot(e, f)) - rest;
      const double turns = std::ceil(value_of(angle) / (2 * std::numbers::pi) - 0.5);
      return {angle - T(2 * std::numbers::pi * turns), T(0), T(0)};
    }
    case JointKind::slide:
      return {dot(a.turned(joint.axis[0]), gap()) - rest, T(0), T(0)};
  }
  return {};
}

}  // namespace pbd::reference
