#include "touch.h"

#include <Eigen/Dense>

#include "error.h"

namespace pbd::reference {
namespace {

Vec3 placed_by(const RigidStep& step, const Placement& at, const Feature& feature) {
  const auto b = static_cast<std::size_t>(feature.body);
  return at.x.col(step.model.rotors[b].node) + at.orientation[b] * feature.point;
}

}  // namespace

Vec3 seen_by(const RigidStep& step, const Placement& at, int body, const Vec3& point) {
  const auto b = static_cast<std::size_t>(body);
  return at.orientation[b].conjugate() * (point - at.x.col(step.model.rotors[b].node));
}

Feature feature_of(const Collider& collider, const Vec3& seen) {
  Feature feature{.body = collider.body, .point = collider.frame.origin};
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) {
    feature.radius = sphere->radius;
  } else if (std::holds_alternative<HalfSpace>(collider.shape)) {
    feature.plane = true;
    feature.normal = collider.frame.rotation.col(2);
  } else if (const auto* box = std::get_if<Box>(&collider.shape)) {
    const Vec3 local = collider.frame.rotation.transpose() * (seen - collider.frame.origin);
    feature.point = collider.frame.place(local.cwiseSign().cwiseProduct(box->size / 2));
  } else {
    throw SetupError("plain_contraction_of_contacts", "another shape", "spheres, boxes and half spaces");
  }
  return feature;
}

TouchingAt touching_at(const RigidStep& step, const Placement& at, const Touch& touch) {
  TouchingAt found;
  const Vec3 a = placed_by(step, at, touch.a), b = placed_by(step, at, touch.b);
  const Vec3 normal = touch.b.plane
                          ? Vec3(at.orientation[static_cast<std::size_t>(touch.b.body)] * touch.b.normal)
                          : Vec3((a - b).normalized());
  found.point_a = a - touch.a.radius * normal;
  found.gap = normal.dot(found.point_a - b) - touch.b.radius;
  found.point_b =
      touch.b.plane ? Vec3(found.point_a - found.gap * normal) : Vec3(b + touch.b.radius * normal);
  const Vec3 tangent = (touch.across - normal.dot(touch.across) * normal).normalized();
  found.directions << normal.transpose(), tangent.transpose(), normal.cross(tangent).transpose();
  return found;
}

Eigen::MatrixXd rows_of(const RigidStep& step, const Placement& at, const Touch& touch,
                        const TouchingAt& found, const Vec3& place) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, step.model.unknowns);
  for (const auto& [feature, sign] : {std::pair{&touch.a, 1.0}, {&touch.b, -1.0}}) {
    const Rotor& rotor = step.model.rotors[static_cast<std::size_t>(feature->body)];
    const Eigen::Matrix3d own =
        found.directions * at.orientation[static_cast<std::size_t>(feature->body)].toRotationMatrix();
    if (const int i = step.model.nodes.first[rotor.node]; i >= 0)
      rows.middleCols<3>(i) += sign * found.directions;
    if (const int i = rotor.unknown; i >= 0)
      rows.middleCols<3>(i) -= sign * own * cross_matrix(seen_by(step, at, feature->body, place));
  }
  return rows;
}

}  // namespace pbd::reference
