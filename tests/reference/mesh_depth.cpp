// Depths that points prove, beside those of boxes known by hand.
#include "mesh_depth.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "claimed_contacts.h"
#include "hollow_meshes.h"

using namespace pbd;
using reference::proved_depth;

namespace {

const Shape cube = ClosedMesh(box_surface(Vec3(2, 2, 2)));

double depth_in_cube(const Shape& other, const Frame& at, const Frame& of_cube = {}) {
  const reference::PlacedShape a{&other, at}, b{&cube, of_cube};
  const double depth = proved_depth(a, b);
  CHECK(proved_depth(b, a) == depth);
  return depth;
}

}  // namespace

TEST_CASE("depth of closed meshes: nodes, balls and edges in a cube, and a cube's nodes in shapes") {
  const auto is = [](double depth, double expected) { return std::abs(depth - expected) <= 1e-12; };
  CHECK(is(depth_in_cube(Sphere{0.5}, {{0, 0, 1.2}}), 0.3));
  CHECK(is(depth_in_cube(Sphere{0.5}, {{0, 0, 0.8}}), 0.7));
  CHECK(depth_in_cube(Sphere{0.5}, {{0, 0, 1.5001}}) == 0);
  CHECK(is(depth_in_cube(Capsule{0.5, 1}, {{0, 0, 1.9}}), 0.1));
  CHECK(is(depth_in_cube(Box{{0.5, 0.5, 0.5}}, {{1.1, 0.2, 0}}), 0.15));
  CHECK(is(depth_in_cube(ConvexHull(box_surface({0.5, 0.5, 0.5})), {{1.1, 0.2, 0}}), 0.15));
  CHECK(is(depth_in_cube(ClosedMesh(box_surface({0.5, 0.5, 0.5})), {{0.2, -1.1, 0}}), 0.15));
  CHECK(is(depth_in_cube(Box{{6, 6, 6}}, {{3.9, 0, 0}}), 0.1));  // its own nodes are outside
  CHECK(is(depth_in_cube(Cylinder{6, 2}, {{0, 0, 1.9}}), 0.1));  // the cube's nodes
  // An edge of the cube that lies in a cylinder between its nodes.
  const Eigen::Matrix3d lying = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix();
  CHECK(std::abs(depth_in_cube(Cylinder{0.3, 1}, {{1.2, 0.1, 1}, lying}) - 0.1) <= 1e-7);
  CHECK(std::abs(depth_in_cube(Capsule{0.3, 1}, {{1.2, 0.1, 1}, lying}) - 0.1) <= 1e-7);
  // A spit: no node of either is in the other.
  CHECK(is(depth_in_cube(Box{{0.2, 0.2, 8}}, {{0.3, 0, 0}}), 0.8));
  CHECK(is(depth_in_cube(ClosedMesh(box_surface({0.2, 0.2, 8})), {{0.3, 0, 0}}), 0.8));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  CHECK(is(depth_in_cube(Sphere{0.5}, {turn * Vec3(0, 0, 1.2), turn}, {Vec3::Zero(), turn}), 0.3));
}

TEST_CASE("depth of closed meshes: what stands in the hollow of one is in none of it") {
  const Shape profile = ClosedMesh(test::angle_profile()), ball = Sphere{0.2}, pin = Box{{0.1, 0.1, 0.1}};
  const reference::PlacedShape hollow{&profile, {}};
  CHECK(proved_depth({&ball, {{0.3, 0.3, 0}}}, hollow) == 0);
  CHECK(proved_depth({&pin, {{0.3, 0.3, 0}}}, hollow) == 0);
  CHECK(std::abs(proved_depth({&ball, {{0.15, 0.5, 0}}}, hollow) - 0.05) <= 1e-12);
  CHECK(std::abs(proved_depth({&ball, {{-0.1, 0.5, 0}}}, hollow) - 0.3) <= 1e-12);
}

TEST_CASE("depth of closed meshes in triangles that keep a radius free") {
  const auto depth = [&](double z, double size, double radius) {
    const std::array<Vec3, 3> triangle{Vec3(-size, -size, z), Vec3(size, -size, z), Vec3(0, size, z)};
    return proved_depth({&cube, {}}, triangle, radius);
  };
  const auto is = [](double found, double expected) { return std::abs(found - expected) <= 1e-12; };
  CHECK(is(depth(1.03, 0.5, 0.05), 0.02));  // nodes over a face
  CHECK(is(depth(1.03, 9, 0.05), 0.02));    // the cube's nodes
  CHECK(depth(1.06, 9, 0.05) == 0);
  CHECK(is(depth(0.97, 0.5, 0.05), 0.08));
  CHECK(depth(0.97, 9, 0.05) >= 0.05);  // cut by edges
  CHECK(depth(0.97, 9, 0) == 0);
  // Through the cube by its own sides alone: the cube's edges, and its corners and middle, are outside.
  const std::array<Vec3, 3> beside{Vec3(-2, 0.3, 0), Vec3(8, 0.3, 0), Vec3(8, 0.4, 0)};
  CHECK(proved_depth({&cube, {}}, beside, 0.05) >= 0.05);
}

TEST_CASE("depth: closed meshes that a step pushes into each other") {
  pbdcheck::BodyScene scene(ContactLaw{.friction = 0}, 0);
  const auto add = [&](const Vec3& position, const Vec3& velocity) {
    scene.mesh(ClosedMesh(box_surface(Vec3(1, 1, 1))), 1, {.position = position, .velocity = velocity});
  };
  add({0, 0, 0}, {1, 0, 0});
  add({1.005, 0, 0}, {0, 0, 0});
  test::Step step(scene.finish());
  step.move();  // 0.01 m: 5 mm deep, and no force told
  CHECK(test::refuted(step) == test::Names{"depth"});
  step.end.v.col(0).x() = 0.4;
  step.scene.initial.v.col(0).x() = 0.4;
  step.move();
  CHECK(test::refuted(step).empty());
}
