#include "studies/robustness/same_scene.h"

#include <algorithm>

namespace pbdcheck {

using namespace pbd;

namespace {

/// Vectors of bodies' and shapes' own frames; diagonal.
Eigen::Matrix3d own(const Isometry& by) {
  return Vec3(by.turn.determinant(), 1, 1).asDiagonal();
}

Eigen::Quaterniond turned(const Eigen::Quaterniond& orientation, const Eigen::Matrix3d& before,
                          const Eigen::Matrix3d& after) {
  return Eigen::Quaterniond(before * orientation.toRotationMatrix() * after).normalized();
}

struct Moving {
  explicit Moving(const Isometry& isometry)
      : by_(isometry), mirror_(own(isometry)), sense_(isometry.turn.determinant() < 0 ? -1 : 1) {}

  void operator()(Gravity& e) const { e.acceleration = by_.turn * e.acceleration; }
  void operator()(ExternalForce& e) const {
    for (auto& force : e.force) force = by_.turn * force;
  }
  void operator()(Anchor& e) const {
    for (auto& target : e.target) target = by_.shift + by_.turn * target;
  }
  void operator()(Distance&) const {}
  void operator()(Bending& e) const {
    for (auto& angle : e.rest_angle) angle *= sense_;
  }
  void operator()(TriangleStrain& e) const {
    for (auto& rest : e.rest) rest = by_.turn * rest;
  }
  void operator()(TetStrain& e) const {
    for (std::size_t i = 0; i < e.node.size(); ++i) {
      e.rest[i] = by_.turn * e.rest[i];
      if (sense_ > 0) continue;
      std::swap(e.node[i][0], e.node[i][1]);
      e.rest[i].col(0).swap(e.rest[i].col(1));
    }
  }
  void operator()(ExternalTorque& e) const {
    for (auto& torque : e.torque) torque = sense_ * (by_.turn * torque);
  }
  void operator()(Gyroscopic&) const {}
  void operator()(PointJoint& e) const { points(e); }
  void operator()(AxisJoint& e) const { pairs(e.axis); }
  void operator()(PerpendicularJoint& e) const { pairs(e.axis); }
  void operator()(RotationJoint& e) const {
    for (auto& rest : e.rest) rest = turned(rest, mirror_, mirror_);
  }
  void operator()(LineJoint& e) const {
    points(e);
    for (auto& axis : e.axis) axis = mirror_ * axis;
  }
  void operator()(BodyDistance& e) const { points(e); }
  void operator()(AngleJoint& e) const {
    for (auto& axis : e.axis) axis = sense_ * (mirror_ * axis);
    pairs(e.reference);
  }
  void operator()(SlideJoint& e) const {
    points(e);
    for (auto& axis : e.axis) axis = mirror_ * axis;
  }
  void operator()(Attachment& e) const {
    for (auto& point : e.point) point = mirror_ * point;
  }
  void operator()(Contact& e) const {
    for (auto& collider : e.collider) {
      collider.frame = {mirror_ * collider.frame.origin, mirror_ * collider.frame.rotation * mirror_};
      collider.shape = std::visit([&](const auto& shape) { return mirrored(shape); }, collider.shape);
    }
    if (sense_ < 0)
      for (auto& triangle : e.triangle) std::swap(triangle[0], triangle[1]);
  }

 private:
  Isometry by_;
  Eigen::Matrix3d mirror_;
  double sense_;

  template <class Pairs>
  void pairs(Pairs& vectors) const {
    for (auto& pair : vectors)
      for (auto& vector : pair) vector = mirror_ * vector;
  }
  template <class Joint>
  void points(Joint& e) const {
    pairs(e.point);
  }
  /// Shapes without points of their own are their own mirror_ images.
  template <class S>
  Shape mirrored(const S& shape) const {
    if constexpr (requires { shape.surface; }) {
      if (sense_ > 0) return shape;
      TriangleMesh surface{mirror_ * shape.surface.x, shape.surface.triangles};
      for (auto& triangle : surface.triangles) std::swap(triangle[0], triangle[1]);
      return S(std::move(surface));
    } else {
      return shape;
    }
  }
};

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> where(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    where[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  return where;
}

/// Numbers, alone or in lists of fixed size.
struct Renumber {
  const std::vector<int>& where;

  void operator()(int& number) const { number = where[static_cast<std::size_t>(number)]; }
  template <class List>
  void operator()(List& numbers) const {
    for (auto& each : numbers) (*this)(each);
  }
};

struct Renumbering {
  Renumber node, body;

  template <class E>
  void operator()(E& effect) const {
    if constexpr (requires { effect.node; }) node(effect.node);
    if constexpr (requires { effect.body; }) body(effect.body);
    if constexpr (std::is_same_v<E, Contact>) {
      for (auto& collider : effect.collider) body(collider.body);
      node(effect.triangle);
      body(effect.apart);
      std::reverse(effect.collider.begin(), effect.collider.end());
      std::reverse(effect.node.begin(), effect.node.end());
      std::reverse(effect.radius.begin(), effect.radius.end());
      std::reverse(effect.node_material.begin(), effect.node_material.end());
    }
  }
};

}  // namespace

State moved(const State& state, const Isometry& by) {
  const Eigen::Matrix3d mirror = own(by);
  State to = state;
  to.x = (by.turn * state.x).colwise() + by.shift;
  to.v = by.turn * state.v;
  for (auto& orientation : to.orientation) orientation = turned(orientation, by.turn, mirror);
  to.spin = mirror.determinant() * mirror * state.spin;
  return to;
}

Scene moved(Scene scene, const Isometry& by) {
  scene.initial = moved(scene.initial, by);
  for (auto& effect : scene.effects) std::visit(Moving(by), effect);
  return scene;
}

Order any_order(const Scene& scene, Random& random) {
  return {random.order(scene.nodes()), random.order(static_cast<int>(scene.bodies.size())),
          random.order(static_cast<int>(scene.effects.size()))};
}

State reordered(const State& state, const Order& order) {
  State to = state;
  to.x = state.x(Eigen::all, order.node);
  to.v = state.v(Eigen::all, order.node);
  to.spin = state.spin(Eigen::all, order.body);
  for (std::size_t i = 0; i < order.body.size(); ++i)
    to.orientation[i] = state.orientation[static_cast<std::size_t>(order.body[i])];
  return to;
}

Scene reordered(const Scene& scene, const Order& order) {
  const auto node = inverse(order.node), body = inverse(order.body);
  const Renumbering renumbering{{node}, {body}};
  Scene to;
  to.initial = reordered(scene.initial, order);
  for (const int i : order.node) to.mass.push_back(scene.mass[static_cast<std::size_t>(i)]);
  for (const int i : order.body) {
    to.bodies.push_back(scene.bodies[static_cast<std::size_t>(i)]);
    renumbering.node(to.bodies.back().node);
  }
  for (const int i : order.effect) {
    to.effects.push_back(scene.effects[static_cast<std::size_t>(i)]);
    std::visit(renumbering, to.effects.back());
  }
  return to;
}

}  // namespace pbdcheck
