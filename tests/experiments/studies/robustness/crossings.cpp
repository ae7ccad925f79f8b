// Triangles that cross, placed by hand.
#include "studies/robustness/crossings.h"

#include <catch2/catch.hpp>

#include "scenes/contacts.h"

using namespace pbdcheck;
using pbd::Vec3;

namespace {

/// A triangle in the ground plane's height 1, with others to come.
pbd::Scene triangles(const std::vector<std::array<Vec3, 3>>& corners, BodyScene build = BodyScene({})) {
  pbd::Scene scene = build.finish();
  auto& contact = std::get<pbd::Contact>(scene.effects.back());
  for (const auto& [a, b, c] : corners) {
    const int first = pbd::add_node(scene, a, 1);
    pbd::add_node(scene, b, 1);
    pbd::add_node(scene, c, 1);
    contact.triangle.push_back({first, first + 1, first + 2});
  }
  return scene;
}

double crossing(const pbd::Scene& scene) {
  return Crossings(scene).count(scene.initial);
}

const std::array<Vec3, 3> flat{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)};

}  // namespace

TEST_CASE("a triangle that an edge goes through crosses, one that it passes by does not") {
  const auto standing = [](double x, double low) {
    return std::array{Vec3(x, 0.2, low), Vec3(x, 0.2, low + 1), Vec3(x + 5, 5, low + 0.5)};
  };
  CHECK(crossing(triangles({flat, standing(0.2, 0.5)})) == 2);                 // by an edge of each
  CHECK(crossing(triangles({flat, standing(0.2, 1.1)})) == 0);                 // above
  CHECK(crossing(triangles({flat, standing(0.9, 0.5)})) == 0);                 // beside
  CHECK(crossing(triangles({flat, standing(-0.1, 0.5)})) == 1);                // by two edges of the first
  for (const auto& [a, b, c] : {flat, std::array{flat[0], flat[2], flat[1]}})  // from both sides
    CHECK(crossing(triangles({{a, b, c}, {Vec3(0.3, 0.1, 0), Vec3(0.3, 0.1, 2), Vec3(9, -9, 1)}})) == 2);
}

TEST_CASE("neighbours do not cross, nor surfaces that are not to touch each other") {
  pbd::Scene scene = triangles({flat, {Vec3(0.2, 0.2, 0.5), Vec3(0.2, 0.2, 1.5), Vec3(5, 5, 1)}});
  auto& contact = std::get<pbd::Contact>(scene.effects.back());
  contact.surfaces_touch = false;
  CHECK(crossing(scene) == 0);
  contact.surfaces_touch = true;
  contact.triangle[1] = {0, 4, 2};  // along an edge of the first
  CHECK(crossing(scene) == 0);
}

TEST_CASE("edges in one plane do not cross by rounding") {
  pbd::Scene scene = triangles({flat, {Vec3(0.3, 0, 1), Vec3(0.6, 0, 1), Vec3(0.5, -0.3, 2)}});
  scene.initial.x(1, 3) = scene.initial.x(1, 4) = 1e-17;
  scene.initial.x(2, 4) = 1 - 1e-16;
  scene.initial.x(2, 3) = 1 + 4e-16;
  CHECK(crossing(scene) == 0);
  scene.initial.x(1, 3) = scene.initial.x(1, 4) = 1e-3;
  scene.initial.x(2, 3) = 1 + 1e-6;
  scene.initial.x(2, 4) = 1 - 1e-6;
  CHECK(crossing(scene) > 0);
}

TEST_CASE("what is rigid is crossed where it stands, and half spaces below") {
  BodyScene build({});
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
  build.box(Vec3(0.2, 0.2, 0.2), 1, {Vec3(0.3, 0.3, 1), turn});
  CHECK(crossing(triangles({flat}, build)) == 1);  // the box's edges go through it
  BodyScene large({});
  large.box(Vec3(4, 4, 0.5), 1, {Vec3(2.3, 0, 1), turn});
  CHECK(crossing(triangles({flat}, large)) == 1);  // its edges go through the box
  BodyScene far({});
  far.box(Vec3(0.2, 0.2, 0.2), 1, {Vec3(0.3, 0.3, 1.2), turn});
  CHECK(crossing(triangles({flat}, far)) == 0);
  BodyScene ground({});
  ground.ground();
  CHECK(crossing(triangles({flat, {Vec3(0, 0, 0.1), Vec3(1, 0, -0.1), Vec3(0, 1, 0.1)}}, ground)) == 1);
}
