// The system of a step of rigid bodies: values against their definitions, derivatives against differences.
#include "rigid_step.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "every_joint.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

namespace {

Vector numbers(Eigen::Index count, double seed) {
  return Vector::NullaryExpr(count, [seed](Eigen::Index i) { return std::sin(seed + 2.3 * double(i)); });
}

}  // namespace

TEST_CASE("joint values are what their definitions say in rotation matrices") {
  const Scene scene = every_joint(1e-3);
  const RigidModel model = make_rigid_model(scene);
  const Vector c = values_at(model, {scene.initial.x, scene.initial.orientation, scene.initial.time});
  const Eigen::Matrix3d a = turn_a.toRotationMatrix(), b = turn_b.toRotationMatrix();
  const Points& x = scene.initial.x;
  const Vec3 gap = x.col(1) + b * point_b - x.col(0) - a * point_a;
  const Vec3 u = a * axis_a, to = b * across_b, from = a * across_a;
  Eigen::Index row = 0;
  const auto take = [&](int rows) { return c.segment(std::exchange(row, row + rows), rows); };
  CHECK((take(3) - gap).norm() < 1e-15);
  // Two normals of the axis measure what is left of a vector across it.
  CHECK(take(2).norm() == Approx((b * axis_b).cross(u).norm()));
  CHECK(take(1)[0] == Approx(u.dot(b * axis_b)));
  // |2 vec| = 2 sin(angle/2), about the rotation's axis.
  const Eigen::AngleAxisd left(
      Eigen::Quaterniond(0.8, 0.1, 0.5, -0.2).normalized().toRotationMatrix().transpose() * a.transpose() *
      b);
  CHECK((take(3) - 2 * std::sin(left.angle() / 2) * left.axis()).norm() < 1e-14);
  CHECK(take(2).norm() == Approx(gap.cross(u).norm()));
  CHECK(take(1)[0] == Approx(gap.norm() - 0.7));
  // The angle rotates the reference about the axis to the other's part across it.
  const Vec3 there = (to - u.dot(to) * u).normalized();
  const double angle = take(1)[0] + 0.2 + 0.3 * 2;
  CHECK((Eigen::AngleAxisd(angle, u) * from - there).norm() < 1e-13);
  CHECK(take(1)[0] == Approx(u.dot(gap) - 0.1 - 0.2 * 2));
  CHECK((take(3) - (x.col(2) - x.col(0) - a * point_a)).norm() < 1e-15);
}

TEST_CASE("forces and torques of joints are the work of their values by turns in the world") {
  const Scene scene = every_joint(1e-3);
  const RigidModel model = make_rigid_model(scene);
  const Placement at{scene.initial.x, scene.initial.orientation, 2};
  const Vector gamma = numbers(model.rows(), 0.3);
  Vector forces = Vector::Zero(model.unknowns);
  for (const Block& block : blocks_at(model, at, Coordinates::turns))
    for (const auto& [node, body, offset] : block.parts) {
      const Vector own = block.jacobian.transpose() * gamma.segment(block.row, block.rows());
      forces.segment<3>(model.nodes.first[node]) += own.segment<3>(offset);
      if (body >= 0) forces.segment<3>(model.rotors[body].unknown) += own.segment<3>(offset + 3);
    }
  constexpr double step = 1e-6;
  for (int b = 0; b < 2; ++b)
    for (int axis = 0; axis < 3; ++axis) {
      const auto work = [&](double angle) {
        Placement turned = at;
        turned.orientation[b] = Eigen::AngleAxisd(angle, Vec3::Unit(axis)) * at.orientation[b];
        return gamma.dot(values_at(model, turned));
      };
      const Vec3 torque = at.orientation[b] * Vec3(forces.segment<3>(model.rotors[b].unknown));
      CHECK(torque[axis] == Approx((work(step) - work(-step)) / (2 * step)).epsilon(1e-7));
    }
}

TEST_CASE("the system's derivatives agree with differences of its residuals") {
  for (const auto* implicit : {"implicit", "explicit", "none"}) {
    Scene scene = every_joint(1e-3);
    const std::string torque(implicit);
    if (torque == "none")
      scene.effects.erase(scene.effects.begin() + 1);
    else
      scene.effects[1] = Gyroscopic{torque == "implicit"};
    const RigidStep step{make_rigid_model(scene), scene.initial, 0.3};
    const Vector velocity = step.start_velocity() + numbers(step.model.unknowns, 1);
    const Vector gamma = numbers(step.model.rows(), 0.7);
    const RigidSystem system = system_at(step, velocity, gamma);
    constexpr double size = 1e-6;
    for (int i = 0; i < step.model.unknowns; ++i) {
      const Vector increment = Vector::Unit(step.model.unknowns, i);
      const Vector change = size * velocity_change(step, velocity, increment);
      const RigidSystem up = system_at(step, velocity + change, gamma),
                        down = system_at(step, velocity - change, gamma);
      const Vector force = (up.force(gamma) - down.force(gamma)) / (2 * size);
      INFO(torque << " " << i);
      CHECK((system.tangent.col(i) - force).norm() <= 1e-7 * (1 + force.norm()));
      CHECK((system.jacobian.col(i) - (up.value - down.value) / (2 * size)).norm() <= 1e-7);
    }
  }
}
