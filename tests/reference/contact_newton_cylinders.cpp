// Steps of what touches a cylinder's side, caps and rims, by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "judged_contact.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

constexpr double rim_radius = 0.1, rim_length = 0.3;

/// Where a ball of `size` (m) ends that meets a fixed cylinder about z without friction and gravity.
Vec3 end_of_ball(double size, const Vec3& position, const Vec3& velocity, bool node) {
  BodyScene build({.friction = 0}, 0);
  build.fixed(Cylinder{rim_radius, rim_length}, {.position = Vec3::Zero()});
  if (!node) build.ball(size, 1, {.position = position, .velocity = velocity});
  if (node) {
    build.contact().node.push_back(1);
    build.contact().radius.push_back(size);
    build.contact().node_material.push_back(0);
  }
  Scene scene = build.finish();
  if (node) add_node(scene, position, 1, velocity);
  return judged(scene).x.col(1);
}

/// Above what a cylinder's lowest point is, m.
double height_of_rim(const ContactJudgement& j, int body) {
  const double upright = std::abs((j.orientation[static_cast<std::size_t>(body)] * Vec3::UnitZ()).z());
  return j.x(2, body) - rim_length / 2 * upright - rim_radius * std::sqrt(1 - upright * upright);
}

}  // namespace

TEST_CASE("balls and nodes end on a cylinder's side and cap where they would be nearest") {
  for (const bool node : {false, true})
    for (const double size : {0.02, node ? 0.0 : 0.01}) {
      INFO(node << " " << size);
      // Impulses are along the normal of the end: where it would be, projected.
      const Vec3 beside(0.08, 0.09 + size, 0.05), into(-2, -3, 0.5);
      Vec3 end = beside + judged_step_s * into;
      end.head<2>() *= (rim_radius + size) / end.head<2>().norm();
      CHECK((end_of_ball(size, beside, into, node) - end).norm() <= by_hand);
      const Vec3 above(0.03, -0.04, rim_length / 2 + size + 0.01), down(0.4, 0.2, -3);
      end = above + judged_step_s * down;
      end.z() = rim_length / 2 + size;
      CHECK((end_of_ball(size, above, down, node) - end).norm() <= by_hand);
    }
}

TEST_CASE("balls and round nodes end on a cylinder's rim at their radius from its nearest point") {
  const double size = 0.03;
  const Vec3 from(0.09, 0.08, rim_length / 2 + 0.03), into(-1, -1, -2);
  const Vec3 free = from + judged_step_s * into;
  Vec3 rim(free.x(), free.y(), rim_length / 2);
  rim.head<2>() *= rim_radius / free.head<2>().norm();
  const Vec3 end = rim + size * (free - rim).normalized();
  for (const bool node : {false, true}) CHECK((end_of_ball(size, from, into, node) - end).norm() <= by_hand);
}

TEST_CASE("a point that goes by beyond a cylinder's rim meets nothing") {
  const Vec3 from(0.101, 0, rim_length / 2 + 0.005), by(0.1, 0, -2);
  CHECK((end_of_ball(0, from, by, true) - (from + judged_step_s * by)).norm() <= by_hand);
}

TEST_CASE("a cylinder that lies on the ground slips and turns as by hand") {
  const auto j = judged(pbdcheck::slipping(pbdcheck::Round::cylinder));
  const double friction = 0.2, slowed = friction * gravity * judged_step_s;
  const Eigen::Index body = j.x.cols() - 1;
  CHECK(std::abs(j.v(0, body) - (1 - slowed)) <= by_hand);
  const Vec3 spin = j.orientation.back() * Vec3(j.spin.col(j.spin.cols() - 1));
  CHECK(std::abs(spin.y() - 2 * slowed / 0.1) <= by_hand / 0.1);  // I = m R^2/2
}

TEST_CASE("a cylinder stands on its cap and comes down on its rim") {
  BodyScene standing({.friction = 0.5}, gravity);
  standing.ground();
  standing.cylinder(rim_radius, rim_length, 2, {.position = {0, 0, rim_length / 2}});
  const auto still = judged(standing.finish());
  CHECK(still.v.cwiseAbs().maxCoeff() <= by_hand);
  CHECK(still.spin.cwiseAbs().maxCoeff() <= by_hand);

  BodyScene tilted({.friction = 0.3}, gravity);
  tilted.ground();
  const Eigen::Quaterniond askew(Eigen::AngleAxisd(0.5, Vec3(1, 2, 0).normalized()));
  const double low = rim_length / 2 * std::cos(0.5) + rim_radius * std::sin(0.5);
  tilted.cylinder(rim_radius, rim_length, 2,
                  {.position = {0, 0, low + 0.01}, .orientation = askew, .velocity = {0.5, 0, -3}});
  const auto fallen = judged(tilted.finish());
  CHECK(std::abs(height_of_rim(fallen, 1)) <= by_hand);
  CHECK(fallen.contacts == 1);
}

TEST_CASE("a cube ends with a face on a cylinder's rim that was beside it and behind the face") {
  constexpr double side = 0.06, inertia = side * side / 6;  // of 1 kg
  const Vec3 turn(2.536, -1.245, 1.239), from(-0.0302, 0.1294, 0.1759), velocity(-0.02, -1.07, -1.72),
      spin(-9.88, 5.88, 0.18);
  BodyScene build({.friction = 0}, 0);
  build.fixed(Cylinder{rim_radius, rim_length}, {.position = Vec3::Zero()});
  build.box(Vec3::Constant(side), 1,
            {.position = from,
             .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())),
             .velocity = velocity,
             .spin = spin});
  const auto j = judged(build.finish());
  // The face's impulse is along its normal, at the rim's point that is deepest below it; nothing else turns a
  // cube.
  const Vec3 centre = j.x.col(1), down = j.orientation[1] * Vec3::UnitZ();
  Vec3 rim(0, 0, rim_length / 2);
  rim.head<2>() -= rim_radius * down.head<2>().normalized();
  const Vec3 lever = rim - centre;
  const double off = 1e-9 * (centre - from).norm(), pushed = -down.dot(Vec3(j.v.col(1)) - velocity);
  CHECK(pushed > 0);
  CHECK((lever - down.dot(lever) * down).norm() < side / 2);
  CHECK(std::abs(down.dot(lever) - side / 2) <= off);
  CHECK((Vec3(j.v.col(1)) - velocity + pushed * down).norm() <= off / judged_step_s);
  const Vec3 turned = j.orientation[1] * (Vec3(j.spin.col(1)) - spin);
  CHECK((inertia * turned + lever.cross(pushed * down)).norm() <= side * off / judged_step_s);
}

TEST_CASE("a box stands on an edge that crosses a cylinder's cap next to the rim, along it") {
  constexpr double side = 0.1, within = 1e-3;
  BodyScene build({.friction = 0}, gravity);
  build.fixed(Cylinder{rim_radius, rim_length}, {.position = Vec3::Zero()});
  build.box({side, 0.06, side}, 1,
            {.position = {rim_radius - within, 0, rim_length / 2 + side / std::sqrt(2.0)},
             .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(std::atan(1.0), Vec3::UnitY()))});
  const auto still = judged(build.finish());
  CHECK(still.v.cwiseAbs().maxCoeff() <= by_hand);
  CHECK(still.spin.cwiseAbs().maxCoeff() <= by_hand / side);
}
