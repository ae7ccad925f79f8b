// What overlaps parts by a recovery speed at most; what began apart is let into nothing for it.
#include <catch2/catch.hpp>

#include "body_scenes.h"
#include "contact_runs.h"
#include "contact_shapes.h"
#include "pressed_surfaces.h"
#include "scenes/contacts.h"
#include "step/step.h"

using namespace pbd;

TEST_CASE("a ball that begins beside a cube ends outside it, however slowly overlaps recover") {
  constexpr double radius = 0.1, side = 0.4, h = 0.01;  // m, m, s
  const double recovery = GENERATE(0.1, 1.0, infinity);
  pbdcheck::BodyScene build({.friction = 0.5}, 0);
  build.fixed(Box{Vec3::Constant(side)}, {});
  build.ball(radius, 1, {.position = {-0.31, 0.22, 0}, .velocity = {20, 0, 0}});
  build.contact().recovery = recovery;
  const Scene scene = build.finish();
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  for (int k = 0; k < 4; ++k) {
    REQUIRE(step(workspace, h, state).status == Status::ok);
    const Vec3 beside = (state.x.col(1).cwiseAbs() - Vec3::Constant(side / 2)).cwiseMax(0);
    INFO("recovery " << recovery << ", step " << k);
    CHECK(beside.norm() >= radius * (1 - 1e-4));
  }
}

// 7.9 cm in each other across two edges, and by less across faces' sides, which they leave as they part. One
// contact that parts two bodies of 1 kg at r brings at most r^2/4 J kg: turning, they weigh less there.
TEST_CASE("two boxes that begin in each other edge to edge part by the recovery speed, whatever the step") {
  const double h = GENERATE(0.01, 0.005, 0.002, 0.001), recovery = GENERATE(0.1, 1.0);
  const double friction = GENERATE(0.0, 0.5);
  const auto turned = [](const Vec3& by) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(by.norm(), by.normalized()));
  };
  pbdcheck::BodyScene build({.friction = friction}, 0);
  build.box({0.2487, 0.2801, 0.2311}, 1,
            {.position = {0, 0.0003, 0.0352}, .orientation = turned({0.9993, -0.5292, 0.1353})});
  build.box({0.2446, 0.1695, 0.1675}, 1,
            {.position = {0.2504, 0, -0.0568}, .orientation = turned({-0.0198, 0.4677, -2.478})});
  build.contact().recovery = recovery;
  const Scene scene = build.finish();
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  INFO("h " << h << ", recovery " << recovery << ", friction " << friction);
  REQUIRE(step(workspace, h, state).status == Status::ok);
  const double energy = test::kinetic_energy(scene, state);
  CHECK(energy > 0);
  CHECK(energy <= recovery * recovery / 4);
}

TEST_CASE("surfaces in each other part by a tenth of their thickness in a step") {
  using namespace pbd::test;
  PressedSurfaces pressed(GENERATE(Pressing::node, Pressing::edge), {.friction = 0.3});
  pressed.sink();
  const State end = run(pressed.scene, contact_method("direct"), PressedSurfaces::h, 1);
  for (const int node : pressed.nodes)
    CHECK((Vec3(end.v.col(node)) - pressed.after_sinking()).norm() <= 1e-9);
}

TEST_CASE("a sphere in a surface parts within the step, be it of radius 0") {
  using namespace pbd::test;
  const double radius = GENERATE(0.0, 0.05), deep = PressedSurfaces::thickness / 5;
  PressedSurfaces pressed(Pressing::sphere, {.friction = 0.3});
  std::get<Contact>(pressed.scene.effects[1]).radius = {radius};
  pressed.scene.initial.x(2, pressed.nodes[0]) = radius + PressedSurfaces::thickness / 2 - deep;
  const State end = run(pressed.scene, contact_method("direct"), PressedSurfaces::h, 1);
  const double up = deep / PressedSurfaces::h;
  const Vec3 expected(0, PressedSurfaces::speed - 0.3 * (up + pbdcheck::gravity * PressedSurfaces::h), up);
  CHECK((Vec3(end.v.col(pressed.nodes[0])) - expected).norm() <= 1e-9);
}

// The contact that parts them first leaves its features on the way, and nothing took its place: they stayed
// in each other with ok. Poses as they were found among random ones.
TEST_CASE("boxes that begin deep in each other part in a step that says ok, whatever contacts leave it") {
  struct Placed {
    Vec3 size, position, rotation;  // m, m, rad
  };
  const std::vector<std::array<Placed, 2>> pairs{
      {{{{0.43204886125110276, 0.15845656897331717, 0.4689938598224884},
         {0, 0, 0},
         {0.9986441392292114, 1.6819997657826247, -1.7169909586841348}},
        {{0.4117383391704851, 0.1704826677675016, 0.40661877024313176},
         {0.10434997587438044, -0.03205133619780154, 0.08987013239600533},
         {-0.9462565717084015, -1.3558558759245471, -0.3779327346094603}}}},
      {{{{0.1409939766602608, 0.10090732054514927, 0.2555930430609581},
         {0, 0, 0},
         {-1.5590104353319036, -1.2180011150364143, 1.8953496179879559}},
        {{0.30092227103033353, 0.28800949935957454, 0.43443350138173986},
         {0.05918778902375865, 0.10859853473297404, 0.09570438290668604},
         {1.17818659723808, -1.6238676052912835, 0.5026575489018055}}}},
      {{{{0.23592006257706083, 0.3687328260652958, 0.228972764001652},
         {0, 0, 0},
         {-0.5701187141040807, 0.3894956864649788, -0.9563215789795594}},
        {{0.2856221008894264, 0.25408743116978394, 0.21862397005304698},
         {-0.13356978803634484, 0.05146536743810631, 0.05548375728462113},
         {1.4640326091290268, -0.9693990620943405, -1.4020889246528636}}}},
  };
  int parted = 0;
  for (const auto& pair : pairs) {
    pbdcheck::BodyScene build({}, 0);
    for (const Placed& each : pair)
      build.box(each.size, 1,
                {.position = each.position,
                 .orientation = Eigen::Quaterniond(
                     Eigen::AngleAxisd(each.rotation.norm(), each.rotation.normalized()))});
    const Scene scene = build.finish();
    const auto apart = [&](const State& state) {
      const auto placed = [&](std::size_t body) {
        const Frame at{state.x.col(static_cast<Eigen::Index>(body)),
                       state.orientation[body].toRotationMatrix()};
        return test::convex(Box{pair[body].size}, at);
      };
      return test::signed_distance(placed(0), placed(1));
    };
    REQUIRE(apart(scene.initial) < -0.05);
    Workspace workspace(scene, Method{});
    State state = scene.initial;
    if (step(workspace, 0.01, state).status != Status::ok) continue;
    ++parted;
    CHECK(apart(state) > -1e-6);
  }
  CHECK(parted > 0);  // else nothing has been seen
}
