#include "studies/robustness/units.h"

namespace pbdcheck {

using namespace pbd;

namespace {

template <class S>
Shape scaled(S shape, double length) {
  if constexpr (requires { shape.radius; }) shape.radius *= length;
  if constexpr (requires { shape.length; }) shape.length *= length;
  if constexpr (requires { shape.size; }) shape.size *= length;
  if constexpr (requires { shape.surface; })
    return S(TriangleMesh{shape.surface.x * length, shape.surface.triangles});
  return shape;
}

struct Units {
  double length, mass;

  void operator()(Gravity& e) const { e.acceleration *= length; }
  void operator()(ExternalForce& e) const {
    for (auto& force : e.force) force *= mass * length;
  }
  void operator()(Anchor& e) const {
    for (auto& target : e.target) target *= length;
    for (auto& compliance : e.compliance) compliance /= mass;
  }
  void operator()(Distance& e) const {
    for (auto& rest : e.rest_length) rest *= length;
    for (auto& compliance : e.compliance) compliance /= mass;
  }
  void operator()(Bending& e) const {
    for (auto& compliance : e.compliance) compliance /= mass * length * length;
  }
  void operator()(TriangleStrain& e) const {
    for (auto& rest : e.rest) rest *= length;
    e.thickness *= length;
    moduli(e);
  }
  void operator()(TetStrain& e) const {
    for (auto& rest : e.rest) rest *= length;
    moduli(e);
  }
  void operator()(ExternalTorque& e) const {
    for (auto& torque : e.torque) torque *= mass * length * length;
  }
  void operator()(Gyroscopic&) const {}
  void operator()(PointJoint& e) const { of_lengths(e); }
  void operator()(LineJoint& e) const { of_lengths(e); }
  void operator()(BodyDistance& e) const {
    of_lengths(e);
    bounds(e, mass * length);
    for (auto& rest : e.rest_length) rest *= length;
  }
  void operator()(SlideJoint& e) const {
    of_lengths(e);
    bounds(e, mass * length);
    for (auto& rest : e.rest_position) rest *= length;
    for (auto& rate : e.rate) rate *= length;
  }
  void operator()(Attachment& e) const {
    for (auto& point : e.point) point *= length;
    for (auto& compliance : e.compliance) compliance /= mass;
  }
  void operator()(AxisJoint& e) const { of_angles(e); }
  void operator()(PerpendicularJoint& e) const { of_angles(e); }
  void operator()(RotationJoint& e) const { of_angles(e); }
  void operator()(AngleJoint& e) const {
    of_angles(e);
    bounds(e, mass * length * length);
  }
  void operator()(Contact& e) const {
    for (auto& collider : e.collider) {
      collider.frame.origin *= length;
      collider.shape = std::visit([&](const auto& shape) { return scaled(shape, length); }, collider.shape);
    }
    for (auto& radius : e.radius) radius *= length;
    for (auto& law : e.law) law.compliance /= mass;
    e.thickness *= length;
    e.margin *= length;
    e.recovery *= length;
  }

 private:
  template <class Strain>
  void moduli(Strain& e) const {
    e.material.young *= mass / length;
    if (e.damping) e.damping->young *= mass / length;
  }
  template <class Joint>
  static void bounds(Joint& e, double unit) {
    for (auto& pair : e.bounds)
      for (auto& force : pair) force *= unit;
  }
  template <class Joint>
  void of_lengths(Joint& e) const {
    for (auto& pair : e.point)
      for (auto& point : pair) point *= length;
    for (auto& compliance : e.compliance) compliance /= mass;
  }
  template <class Joint>
  void of_angles(Joint& e) const {
    for (auto& compliance : e.compliance) compliance /= mass * length * length;
  }
};

}  // namespace

Scene in_units(Scene scene, double length, double mass) {
  for (auto& value : scene.mass) value *= mass;
  scene.initial.x *= length;
  scene.initial.v *= length;
  for (auto& body : scene.bodies) body.inertia *= mass * length * length;
  for (auto& effect : scene.effects) std::visit(Units{length, mass}, effect);
  return scene;
}

}  // namespace pbdcheck
