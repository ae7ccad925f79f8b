// Steps of what lies on each other: closed meshes whose triangles share planes, so that their diagonals are
// no edges, and light boxes that carry a million times their mass.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "contact_step.h"
#include "judged_contact.h"
#include "mesh.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::BodyScene;
using pbdcheck::Placing;

namespace {

/// Two cubes of 0.2 m as closed meshes, the upper one at `offset` (m) and with `velocity` (m/s).
Scene mesh_cubes(double friction, const Vec3& offset, const Vec3& velocity) {
  BodyScene build({.friction = friction}, gravity);
  build.ground();
  const ClosedMesh cube(box_surface(Vec3::Constant(0.2)));
  build.mesh(cube, 125, {.position = {0, 0, 0.1}});
  build.mesh(cube, 125, {.position = Vec3(0, 0, 0.3) + offset, .velocity = velocity});
  return build.finish();
}

}  // namespace

TEST_CASE("a mesh that lies flush on another slides off it where nothing rubs") {
  for (const Vec3& velocity : {Vec3(0.3, 0, 0), Vec3(-0.3, 0, 0), Vec3(0, -0.3, 0)}) {
    const Vec3 flush = 0.02 * Vec3(velocity.y(), velocity.x(), 0).normalized();  // on two sides alone
    const auto j = judged(mesh_cubes(0, flush, velocity));
    CHECK((j.v.col(2) - velocity).norm() <= 1e-9);
    CHECK(j.v.col(1).norm() <= 1e-9);
  }
}

// It begins 8 mm in front of the second one's side, and goes farther in the step.
TEST_CASE("what slides level to the next table is not struck by its side, if the first one carries it") {
  const auto kind = GENERATE(as<std::string>(), "box", "mesh", "cylinder");
  const bool carried = kind != "box" || GENERATE(true, false);
  constexpr double size = 0.2, wide = 1, speed = 1;
  BodyScene build({.friction = 0}, gravity);
  if (carried) build.fixed(Box{Vec3::Constant(wide)}, {Vec3::Zero()});
  build.fixed(Box{Vec3::Constant(wide)}, {wide * Vec3::UnitX()});
  const Placing at{{(wide - size) / 2 - 0.008, 0.03, (wide + size) / 2},
                   Eigen::Quaterniond::Identity(),
                   speed * Vec3::UnitX()};
  if (kind == "box") build.box(Vec3::Constant(size), 1, at);
  if (kind == "mesh") build.mesh(ClosedMesh(box_surface(Vec3::Constant(size))), 125, at);
  if (kind == "cylinder") build.cylinder(size / 2, size, 1, at);
  INFO(kind << ", carried " << carried);
  const auto j = judged(build.finish());
  const Vec3 change = j.v.rightCols<1>() - at.velocity;
  if (carried)
    CHECK(change.norm() <= 1e-9 * speed);
  else
    CHECK(change.x() < -0.1 * speed);
}

TEST_CASE("a corner on the diagonal of a mesh's face is over one triangle of it") {
  const auto j = judged(mesh_cubes(0.5, Vec3(0.05, 0.05, 0), Vec3::Zero()));
  CHECK(j.v.cwiseAbs().maxCoeff() <= 1e-9);
  // Four corners of the lower one on the ground; one of each over the other, and two pairs of edges that
  // cross.
  CHECK(j.all.size() == 8);
}

TEST_CASE("boxes that carry a million times their mass are judged to rest with the ground's force") {
  const double heavy = 1e6;
  BodyScene build({.friction = 0.5}, gravity);
  build.ground();
  for (int i = 0; i < 3; ++i)
    build.box(Vec3::Constant(0.2), i == 2 ? heavy : 1, {.position = {0, 0, 0.1 + 0.2 * i}});
  for (const Friction law : {Friction::coulomb, Friction::cone}) {
    const Scene scene = build.finish();
    const auto j = judged(scene, law);
    // The forces on each are known to rounding: 1e-16 of 1e7 N on 1 kg within 1e-2 s.
    CHECK(j.v.cwiseAbs().maxCoeff() <= 1e-8);
    double carried = 0;
    for (const JudgedContact& each : j.all)
      if (each.pair.surface[0] == 0 || each.pair.surface[1] == 0) carried += each.force[0];
    CHECK(std::abs(carried / ((heavy + 2) * gravity) - 1) <= 1e-9);
  }
}

TEST_CASE("a judge whose work is spent says so") {
  const Scene scene = mesh_cubes(0.5, Vec3(0.05, 0.05, 0), Vec3::Zero());
  const auto j = contact_newton(scene, scene.initial, judged_step_s, Friction::coulomb, cone_interior_point,
                                {.work = 2});
  CHECK(j.outcome == Outcome::not_converged);
  CHECK_THAT(j.reason, Catch::Contains("2 factorisations"));
}

TEST_CASE("fixed nodes that lie in the ground touch nothing where a ball lands beside them") {
  BodyScene build({.friction = 0}, gravity);
  build.ground();
  const double gap = 0.01;
  const int ball = build.ball(0.1, 1, {.position = {0, 0, 0.1 + gap}, .velocity = {0, 0, -3}});
  Scene scene = build.finish();
  std::array<int, 3> nodes{};
  for (std::size_t k = 0; k < 3; ++k)
    nodes[k] = add_node(scene, Vec3(1 + 0.1 * static_cast<double>(k), k == 1 ? 0.1 : 0, 0), infinity);
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect)) contact->triangle.push_back(nodes);
  const auto j = judged(scene);
  CHECK(std::abs(j.v(2, ball) + gap / judged_step_s) <= by_hand);
  CHECK(j.contacts == 1);
}

// m (v - v0) = -m g h - h (x + h v)/A from x = -A m g, where the spring carries the weight.
TEST_CASE(
    "what stands on a loaded spring goes on by it, whatever it would bounce by and overlaps recover by") {
  const double compliance = GENERATE(1e-5, 1e-3), recovery = GENERATE(1e-3, infinity);
  const double speed = GENERATE(0.0, -0.1);
  constexpr double mass = 2, radius = 0.1, h = judged_step_s;
  BodyScene build({.friction = 0.5, .restitution = 0.5, .compliance = compliance}, gravity);
  build.ground();
  build.ball(radius, mass,
             {.position = {0, 0, radius - compliance * mass * gravity}, .velocity = {0, 0, speed}});
  build.contact().recovery = recovery;
  const Vec3 expected(0, 0, speed / (1 + h * h / (compliance * mass)));
  CHECK((judged(build.finish()).v.col(1) - expected).norm() <= by_hand);
}

TEST_CASE("corners that slide over a face's side in the face's plane come to lie on it") {
  BodyScene build({.friction = 0}, gravity);
  build.fixed(Box{Vec3::Ones()}, {.position = {0, 0, -0.5}});
  // A plate that overhangs by 0.15 m where the step begins, and lies a little deep, as rounding has it.
  const double way = 0.2, speed = way / judged_step_s;
  build.box({0.4, 0.4, 0.1}, 1, {.position = {0.45, 0, 0.05 - 1e-13}, .velocity = {-speed, 0, 0}});
  const Scene scene = build.finish();
  const auto end = judged(scene);
  CHECK((end.v.col(1) - Vec3(-speed, 0, 0)).norm() <= by_hand);
  CHECK(end.spin.col(1).norm() <= by_hand);
  ContactStep own(scene, scene.initial, judged_step_s);
  own.find_contacts(own.step.start_velocity(), false);
  CHECK(std::ranges::count_if(own.contacts,
                              [](const JudgedContact& each) { return each.pair.a.count == 1; }) == 4);
}

TEST_CASE("corners that fall past a face, and end a hair beside it, fall freely") {
  BodyScene build({.friction = 0}, gravity);
  build.fixed(Box{Vec3::Ones()}, {.position = {0, 0, -0.5}});
  const double begin = 2e-4, hair = 1e-5, above = 4e-3;
  const Vec3 velocity(-(begin - hair) / judged_step_s, 0, -1);
  build.box({0.4, 0.4, 0.1}, 1, {.position = {0.7 + begin, 0, 0.05 + above}, .velocity = velocity});
  const auto end = judged(build.finish());
  CHECK((end.v.col(1) - velocity + Vec3(0, 0, gravity * judged_step_s)).norm() <= by_hand);
}
