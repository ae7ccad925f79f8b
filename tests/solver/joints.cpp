// Joints of rigid bodies: their Jacobians and bounds against differences. One sample of each: a joint without
// one does not compile.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "effects/effects.h"

using namespace pbd;

namespace {

constexpr double joint_difference = 1e-6;
const Vec3 point_a(0.3, -0.2, 0.5), point_b(-0.1, 0.4, 0.2);
const Vec3 axis_a = Vec3(1, 2, -1).normalized(), axis_b = Vec3(0.9, 2.1, -0.8).normalized();

template <class E>
E joint_sample();

template <>
PointJoint joint_sample<PointJoint>() {
  return {.body = {{0, 1}}, .point = {{point_a, point_b}}, .compliance = {1e-3}};
}
template <>
AxisJoint joint_sample<AxisJoint>() {
  return {.body = {{0, 1}}, .axis = {{axis_a, axis_b}}, .compliance = {1e-3}};
}
template <>
PerpendicularJoint joint_sample<PerpendicularJoint>() {
  return {.body = {{0, 1}}, .axis = {{axis_a, axis_b}}, .compliance = {1e-3}};
}
template <>
RotationJoint joint_sample<RotationJoint>() {
  return {
      .body = {{0, 1}}, .rest = {Eigen::Quaterniond(0.9, 0.3, -0.2, 0.1).normalized()}, .compliance = {1e-3}};
}
template <>
LineJoint joint_sample<LineJoint>() {
  return {.body = {{0, 1}}, .point = {{point_a, point_b}}, .axis = {axis_a}, .compliance = {1e-3}};
}
template <>
BodyDistance joint_sample<BodyDistance>() {
  return {.body = {{0, 1}}, .point = {{point_a, point_b}}, .rest_length = {0.7}, .compliance = {1e-3}};
}
template <>
AngleJoint joint_sample<AngleJoint>() {
  return {.body = {{0, 1}},
          .axis = {axis_a},
          .reference = {{axis_a.unitOrthogonal(), axis_b.unitOrthogonal()}},
          .rest_angle = {0.2},
          .rate = {0.3},
          .compliance = {1e-3}};
}
template <>
SlideJoint joint_sample<SlideJoint>() {
  return {.body = {{0, 1}},
          .point = {{point_a, point_b}},
          .axis = {axis_a},
          .rest_position = {0.1},
          .rate = {0.2},
          .compliance = {1e-3}};
}
template <>
Attachment joint_sample<Attachment>() {
  return {.body = {0}, .node = {2}, .point = {point_a}, .compliance = {1e-3}};
}

const std::array<Vec3, 2> radius{Vec3(0.5, 0.7, 0.6), Vec3(0.3, 0.2, 0.06)};  // the second is a rod

/// Two bodies and a node, away from any special configuration.
struct Placed {
  std::array<Pose, 2> pose;
  Vec3 node;

  explicit Placed(int seed) {
    const auto number = [&](int k) { return std::sin(1.7 * seed + 2.3 * k); };
    for (int b = 0; b < 2; ++b) {
      pose[b].x = Vec3(b + 0.3 * number(b), 0.4 * number(b + 2), 0.5 * number(b + 4));
      turn(b, Vec3(3 * number(b + 6), 3 * number(b + 8), 3 * number(b + 10)), Eigen::Matrix3d::Identity());
    }
    node = Vec3(number(12), number(13), number(14));
  }

  /// Rotates body b by `angle` in the world from `from`.
  void turn(int b, const Vec3& angle, const Eigen::Matrix3d& from) {
    pose[b].rotation = rotation_by(angle).toRotationMatrix() * from;
    pose[b].turn_per_arc = pose[b].rotation * radius[b].cwiseInverse().asDiagonal();
  }

  /// Moved by `step` along column k of the joint's Jacobian.
  template <class C>
  Placed moved(int k, double step) const {
    Placed next = *this;
    const int part = k / 3, b = part / 2;
    if (b >= C::bodies)
      next.node[k % 3] += step;
    else if (part % 2 == 0)
      next.pose[b].x[k % 3] += step;
    else
      next.turn(b, step * pose[b].turn_per_arc.col(k % 3), pose[b].rotation);
    return next;
  }

  template <class C>
  typename C::Positions positions() const {
    typename C::Positions at;
    for (int b = 0; b < C::bodies; ++b) at.body[b] = &pose[b];
    if constexpr (C::nodes > 2 * C::bodies) at.node = node;
    at.time = 0.5;
    return at;
  }
};

template <class E>
void evaluate(const E& effect, const Placed& placed, typename Constraint<E>::Value& value,
              typename Constraint<E>::Jacobian& jacobian) {
  Constraint<E>::evaluate(effect, 0, placed.positions<Constraint<E>>(), value, jacobian);
}

template <class E>
void check_joint_jacobian(const E& effect) {
  using C = Constraint<E>;
  for (int seed = 0; seed < 20; ++seed) {
    const Placed placed(seed);
    typename C::Value value, above, below;
    typename C::Jacobian jacobian, unused;
    evaluate(effect, placed, value, jacobian);
    for (int k = 0; k < jacobian.cols(); ++k) {
      evaluate(effect, placed.moved<C>(k, joint_difference), above, unused);
      evaluate(effect, placed.moved<C>(k, -joint_difference), below, unused);
      INFO(effect.name << ", seed " << seed << ", column " << k);
      CHECK((jacobian.col(k) - (above - below) / (2 * joint_difference)).norm() < 1e-7);
    }
  }
}

/// The bound holds for the symmetric part of what J^T p changes by, and is zero where p is.
template <class E>
void check_bound(const E& effect) {
  using C = Constraint<E>;
  double tightest = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const Placed placed(seed);
    typename C::Value value, impulse;
    typename C::Jacobian jacobian;
    for (int r = 0; r < C::rows; ++r) impulse[r] = std::sin(3.7 * seed + 1.9 * r + 0.4);
    const auto bound = C::geometric_bound(effect, 0, placed.positions<C>(), impulse);
    // p . c along straight moves and rotations: its second derivative, by differences of the value.
    const int n = 3 * C::nodes;
    const auto product = [&](const Placed& at) {
      evaluate(effect, at, value, jacobian);
      return impulse.dot(value);
    };
    constexpr double wide = 1e-4;
    const double middle = product(placed);
    for (int trial = 0; trial < 30; ++trial) {
      Eigen::VectorXd move(n);
      for (int k = 0; k < n; ++k) move[k] = std::sin(5.3 * trial + 7.9 * k + seed);
      const auto along = [&](double step) {
        Placed next = placed;
        for (int part = 0; part < C::nodes; ++part) {
          const Vec3 own = step * move.segment<3>(3 * part);
          const int b = part / 2;
          if (b >= C::bodies)
            next.node += own;
          else if (part % 2 == 0)
            next.pose[b].x += own;
          else
            next.turn(b, placed.pose[b].turn_per_arc * own, placed.pose[b].rotation);
        }
        return next;
      };
      const double second = (product(along(wide)) - 2 * middle + product(along(-wide))) / (wide * wide);
      double allowed = 0;
      for (int k = 0; k < n; ++k) allowed += bound[k / 3] * move[k] * move[k];
      INFO(effect.name << ", seed " << seed << ", trial " << trial);
      CHECK(-second <= allowed + 1e-6 * (1 + allowed));
      if (allowed > 0) tightest = std::max(tightest, -second / allowed);
    }
    CHECK(C::geometric_bound(effect, 0, placed.positions<C>(), C::Value::Zero()).isZero(0));
  }
  INFO(effect.name);
  CHECK(tightest > 0.1);
}

template <class... E>
void check_joints(const std::variant<E...>*) {
  const auto check = []<class Each>(const Each* none) {
    if constexpr (RowEffect<Each> && BodyEffect<Each>) {
      Each joint = joint_sample<Each>();
      for (const bool damped : {false, true}) {
        if (damped) joint.damping = {0.1};
        check_joint_jacobian(joint);
        check_bound(joint);
      }
    } else {
      static_cast<void>(none);
    }
  };
  (check(static_cast<const E*>(nullptr)), ...);
}

}  // namespace

TEST_CASE("Jacobians and geometric bounds of all joints, large rotations included") {
  check_joints(static_cast<Effect*>(nullptr));
}
