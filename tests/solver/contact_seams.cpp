// Bodies that come flush beside others: the plane in which they slide parts them, and nothing else.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "body_scenes.h"
#include "contact_runs.h"
#include "mesh.h"
#include "refined.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;
using pbdcheck::Placing;

namespace {

constexpr double width = 1, size = 0.4, speed = 1, h = 0.01;  // m, m/s, s
constexpr int steps = 30;

Shape table_of(const std::string& kind) {
  const TriangleMesh cube = box_surface(Vec3::Constant(width));
  if (kind == "box") return Box{Vec3::Constant(width)};
  if (kind == "hull") return ConvexHull(cube);
  return ClosedMesh(kind == "mesh" ? cube : refined(cube));
}

void add_slider(const std::string& kind, const Placing& at, BodyScene& build) {
  const TriangleMesh cube = box_surface(Vec3::Constant(size));
  if (kind == "box") build.box(Vec3::Constant(size), 1, at);
  if (kind == "hull") build.hull(ConvexHull(cube), 10, at);
  if (kind == "mesh") build.mesh(ClosedMesh(cube), 10, at);
  if (kind == "cylinder") build.cylinder(size / 2, size, 1, at);
}

}  // namespace

// Without friction, and as high as what it comes from, it feels nothing: its velocity and its spin stay.
TEST_CASE("what slides flush from a table to the next one keeps its speed") {
  const auto kind = GENERATE(as<std::string>(), "box", "hull", "mesh", "cylinder");
  const auto table = GENERATE(as<std::string>(), "box", "hull", "mesh", "refined mesh");
  const double between = GENERATE(0.0, 0.01), spin = GENERATE(0.0, 3.0);  // m, rad/s
  if (kind == "cylinder" && spin > 0) return;                             // some miss a step, and say so
  std::mt19937 engine(7);
  std::uniform_real_distribution<> uniform(-1, 1);
  for (int draw = 0; draw < 4; ++draw) {
    BodyScene build({.friction = 0});
    for (const double x : {0.0, width + between}) build.fixed(table_of(table), {Vec3(x, 0, 0)});
    const double angle = draw == 0 ? 0 : uniform(engine);
    const Placing at{{0.2 + 0.1 * uniform(engine), 0.2 * uniform(engine), (width + size) / 2},
                     Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitZ())),
                     speed * Vec3::UnitX(),
                     spin * Vec3::UnitZ()};
    add_slider(kind, at, build);
    const Scene scene = build.finish();
    INFO(kind << " on " << table << ", " << between << " apart, spin " << spin << ", draw " << draw);
    for (const double tolerance : {1e-10, 1e-3}) {
      Method method = contact_method("direct");
      method.tolerance = tolerance;
      const State end = run(scene, method, h, steps);
      // The tolerance is of g h, what a step takes of the speed of fall.
      const double allowed = std::max(1e-9 * speed, steps * tolerance * pbdcheck::gravity * h);
      CHECK((end.v.col(2) - at.velocity).norm() <= allowed);
      CHECK((end.spin.col(2) - at.spin).norm() * size <= allowed);
      CHECK((end.x.col(2) - at.position - steps * h * at.velocity).norm() <= steps * h * allowed);
    }
  }
}

// Level with the border sideways, it comes over the plate before it is as low: at 2 m/s down and 1 m/s
// inwards.
TEST_CASE("what falls past a plate's border and inwards within a step does not go through") {
  constexpr double thick = 0.01, wide = 0.1, step = 0.011;  // m, s: farther than both are thick
  BodyScene build({.friction = 0}, 0);
  build.fixed(Box{{width, width, thick}}, {Vec3::Zero()});
  const Placing at{{(width + wide) / 2, 0, 1.2 * thick}, Eigen::Quaterniond::Identity(), {-1, 0, -2}};
  build.box({wide, wide, thick}, 1, at);
  const State end = run(build.finish(), contact_method("direct"), step, 1);
  CHECK(end.v(2, 1) >= at.velocity.z() + 0.1);
}

// It sinks into the tables, so that the second one's side is in front of it.
TEST_CASE("what slides on a table that yields is not thrown by the next one") {
  BodyScene build({.friction = 0, .compliance = 1e-6});
  for (const double x : {0.0, width}) build.fixed(table_of("box"), {Vec3(x, 0, 0)});
  const Placing at{
      {0.3, 0.05, (width + size) / 2}, Eigen::Quaterniond::Identity(), 2 * speed * Vec3::UnitX()};
  add_slider("mesh", at, build);
  const Scene scene = build.finish();
  const State end = run(scene, contact_method("direct"), h, steps);
  const double risen = scene.mass[2] * pbdcheck::gravity * (end.x(2, 2) - at.position.z());
  const double moving = scene.mass[2] * end.v.col(2).squaredNorm() / 2;  // J, of its centre alone
  CHECK(moving + risen <= scene.mass[2] * at.velocity.squaredNorm() / 2);
}

// It falls within the step in which it comes there, so that the plane of the top parts them no more: its
// front touches the border.
TEST_CASE("what comes flush beside a table's border, and nothing carries, strikes its side") {
  const auto kind = GENERATE(as<std::string>(), "box", "hull", "mesh");
  const auto table = GENERATE(as<std::string>(), "box", "hull", "mesh", "refined mesh");
  const double slower = GENERATE(1.0, 0.01), step = std::sqrt(slower) * h;  // falling by as much less
  const double gap = slower * 0.002;                                        // m, less than it goes in a step
  BodyScene build({.friction = 0});
  build.fixed(table_of(table), {Vec3::Zero()});
  add_slider(kind,
             {{-(width + size) / 2 - gap, 0.03, (width + size) / 2},
              Eigen::Quaterniond::Identity(),
              std::sqrt(slower) * speed * Vec3::UnitX()},
             build);
  const Scene scene = build.finish();
  INFO(kind << " beside " << table << ", slower by " << slower);
  const State end = run(scene, contact_method("direct"), step, 1);
  const Vec3 front = end.orientation[1] * Vec3::UnitX(), border(-width / 2, end.x(1, 1), width / 2);
  CHECK(std::abs(front.dot(border - end.x.col(1)) - size / 2) <= 1e-9);
  CHECK(end.x(2, 1) < (width + size) / 2);
}
