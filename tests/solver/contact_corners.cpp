// Contacts that are easily lost, or made of nothing: what lies lowest only once it has turned, ground that
// turns, dampers before they are met, overlaps that part.
#include <set>
#include <string_view>

#include "body_scenes.h"
#include "contact_runs.h"
#include "linear/linear_names.h"
#include "mesh.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

/// Of a unit cube's corners, the lowest one's height over the plane through `origin` across `up`, m.
double lowest_corner(const State& state, int body, Eigen::Index node, const Vec3& up = Vec3::UnitZ()) {
  const Points corners = box_surface(Vec3::Ones()).x;
  double low = infinity;
  for (Eigen::Index i = 0; i < corners.cols(); ++i)
    low = std::min(low, up.dot(state.x.col(node) +
                               state.orientation[static_cast<std::size_t>(body)] * Vec3(corners.col(i))));
  return low;
}

Shape unit_cube(const std::string& kind) {
  if (kind == "mesh") return ClosedMesh(box_surface(Vec3::Ones()));
  if (kind == "hull") return ConvexHull(box_surface(Vec3::Ones()));
  return Box{Vec3::Ones()};
}

/// Its top is at z = 0.
Shape slab(const std::string& kind, Frame& frame) {
  const Vec3 size(8, 8, 2);
  if (kind == "half space") return HalfSpace{};
  frame.origin = Vec3(0, 0, -1);
  if (kind == "mesh") return ClosedMesh(box_surface(size));
  if (kind == "hull") return ConvexHull(box_surface(size));
  return Box{size};
}

}  // namespace

TEST_CASE("a cube that lands almost flat moves as a box on a half space, whatever both are made of") {
  const auto cube = GENERATE(as<std::string>(), "box", "hull", "mesh");
  const auto ground = GENERATE(as<std::string>(), "half space", "box", "hull", "mesh");
  for (const auto& [tilt, speed] : {std::pair{0.02, 4.0}, {0.03, 3.0}, {0.05, 12.0}, {0.12, 25.0}}) {
    const auto landing = [t = tilt, v = speed](const std::string& upper, const std::string& lower) {
      Scene scene;
      const int fixed = add_world(scene);
      const Eigen::Quaterniond turned(Eigen::AngleAxisd(t, Vec3::UnitY()));
      const int body = add_body(scene, Vec3::Zero(), 1, Vec3::Constant(1.0 / 6), turned, Vec3(0, 0, -v));
      scene.initial.x(2, 1) = 1e-4 - lowest_corner(scene.initial, body, 1);
      Contact contact;
      Frame below;
      const Shape shape = slab(lower, below);
      contact.collider = {{shape, fixed, below}, {unit_cube(upper), body}};
      contact.law = {ContactLaw{0}};  // friction would leave the motion to how contacts share it
      scene.effects = {Gravity{}, Gyroscopic{}, contact};
      return scene;
    };
    const Method method = contact_method("direct");
    const Scene scene = landing(cube, ground), usual = landing("box", "half space");
    Workspace own(scene, method), expected(usual, method);
    State state = scene.initial, other = usual.initial;
    INFO(cube << " on " << ground << " tilt " << tilt << " speed " << speed);
    for (int k = 0; k < 20; ++k) {
      REQUIRE(step(own, 0.01, state).status == Status::ok);
      REQUIRE(step(expected, 0.01, other).status == Status::ok);
      CHECK(lowest_corner(state, 1, 1) >= -1e-9);
      CHECK((state.x - other.x).norm() <= 1e-8);
    }
  }
}

TEST_CASE("ground that turns meets what lies far from its centre") {
  const bool endless = GENERATE(true, false);
  Scene scene;
  const int ground = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity),
                              Eigen::Quaterniond::Identity(), Vec3::Zero(), Vec3(0, -1, 0));
  const int box = add_body(scene, Vec3(10, 0, 0.5 + 0.05), 1, Vec3::Constant(1.0 / 6));
  Contact contact;
  Frame below;
  if (!endless) below.origin = Vec3(0, 0, -1);
  const Shape shape = endless ? Shape(HalfSpace{}) : Shape(Box{Vec3(40, 4, 2)});
  contact.collider = {{shape, ground, below}, {Box{Vec3::Ones()}, box}};
  scene.effects = {contact};
  const Method method = contact_method("direct");
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < 4; ++k) {
    REQUIRE(step(workspace, 0.01, state).status == Status::ok);
    const Vec3 up = state.orientation[static_cast<std::size_t>(ground)] * Vec3::UnitZ();
    CHECK(lowest_corner(state, box, 1, up) >= -1e-9);
  }
}

TEST_CASE("a contact's damper is met with the shape, not before") {
  for (const double h : {0.02, 0.005, 0.001})
    for (const double retardation : {0.0, 0.1}) {
      BodyScene build({.friction = 0, .restitution = 0, .compliance = 1e-5, .damping = retardation}, 0);
      build.ground();
      const int ball =
          build.ball(0.3, 1, {Vec3(0, 0, 0.4005), Eigen::Quaterniond::Identity(), Vec3(0, 0, -3)});
      const Scene scene = build.finish();
      const Method method = contact_method("direct");
      Workspace workspace(scene, method);
      State state = scene.initial;
      bool pushed = false;
      for (int k = 0; k * h < 0.2; ++k) {
        REQUIRE(step(workspace, h, state).status == Status::ok);
        for (const ContactForce& contact : workspace.contacts())
          if (contact.force.z() > 0) {
            pushed = true;
            CHECK(contact.gap <= 0);
          }
      }
      CHECK(pushed);
      CHECK(state.v(2, ball) > -3);
    }
}

TEST_CASE("an overlap at rest parts at the speed it is told, under every integrator with contact") {
  for (const std::string integrator : {"implicit_euler", "newmark", "symplectic_euler"})
    for (const double alpha : {0.5, 1.0}) {
      INFO(integrator << " alpha " << alpha);
      BodyScene build({.friction = 0}, 0);
      build.ground();
      build.box(Vec3::Constant(0.2), 1, {Vec3(0, 0, 0.1 - 1e-2)});
      build.contact().recovery = 0.1;
      const Scene scene = build.finish();
      Method method = contact_method("direct");
      method.integrator = integrator;
      if (integrator == "newmark") method.alpha = alpha;
      Workspace workspace(scene, method);
      State state = scene.initial;
      for (int k = 0; k < 5; ++k) {
        REQUIRE(step(workspace, 0.01, state).status == Status::ok);
        CHECK(state.v(2, 1) == Approx(0.1));
      }
    }
}

TEST_CASE("contacts report the impulses that acted, wherever their directions were taken") {
  for (const bool at_start : {false, true})
    for (const std::string integrator : {"implicit_euler", "symplectic_euler"}) {
      INFO(integrator << (at_start ? " directions at the start" : ""));
      constexpr double h = 0.02;
      BodyScene build({.friction = 0.3});
      build.fixed(Sphere{0.5}, {Vec3::Zero()});
      build.ball(0.5, 1, {Vec3(0, 0, 1), Eigen::Quaterniond::Identity(), Vec3(3, 0, -3)});
      const Scene scene = build.finish();
      Method method = contact_method("direct");
      method.integrator = integrator;
      if (at_start) method.direction_blend = 0;
      Workspace workspace(scene, method);
      State state = scene.initial;
      REQUIRE(step(workspace, h, state).status == Status::ok);
      const Vec3 gained = state.v.col(1) - scene.initial.v.col(1) + h * gravity * Vec3::UnitZ();
      Vec3 impulse = Vec3::Zero();
      for (const ContactForce& contact : workspace.contacts()) {
        impulse += h * (contact.collider[0] == 1 ? contact.force : Vec3(-contact.force));
        CHECK(std::abs(contact.normal.dot(contact.slip)) <= 1e-12);
      }
      CHECK((impulse - gained).norm() <= 1e-12 * gained.norm());
    }
}

TEST_CASE("a node does not touch the body that it is attached to") {
  BodyScene build({.friction = 0.3});
  build.ground();
  const int box = build.box(Vec3::Constant(0.2), 1, {Vec3(0, 0, 0.1)});
  Scene scene = build.finish();
  const int node = add_node(scene, Vec3(0, 0, 0.15), 0.1);  // within the box
  auto& contact = std::get<Contact>(scene.effects.back());
  contact.node = {node};
  contact.radius = {0.01};
  contact.node_material = {0};
  scene.effects.emplace_back(
      Attachment{.body = {box}, .node = {node}, .point = {Vec3(0, 0, 0.05)}, .compliance = {0}});
  const State end = run(scene, contact_method("direct"), 0.01, 20);
  CHECK((end.x.col(node) - scene.initial.x.col(node)).norm() <= 1e-9);
}

TEST_CASE("a ball in free flight that ends in a box's side is stopped there") {
  BodyScene build({.friction = 0}, 0);
  build.fixed(Box{Vec3::Ones()}, {Vec3::Zero()});
  build.ball(0.1, 1, {Vec3(0.62, 0, 0.62), Eigen::Quaterniond::Identity(), Vec3(-7, 0, -62)});
  const Scene scene = build.finish();
  Workspace workspace(scene, contact_method("direct"));
  State state = scene.initial;
  REQUIRE(step(workspace, 0.01, state).status == Status::ok);
  CHECK(state.x(0, 1) >= 0.6 - 1e-4 * 0.1);
}

TEST_CASE("what parts as a step begins and comes down in it closes its gap and does not collide") {
  const double h = 0.01, gap = 1e-4;
  pbdcheck::BodyScene build({.friction = 0, .restitution = 0.5}, 9.81);
  build.ground();
  build.ball(0.1, 1, {.position = {0, 0, 0.1 + gap}, .velocity = {0, 0, 0.01}});
  const Scene scene = build.finish();
  State state = scene.initial;
  Method method;
  method.tolerance = 1e-12;
  Workspace workspace(scene, method);
  REQUIRE(step(workspace, h, state).status == Status::ok);
  CHECK(std::abs(state.v(2, 1) + gap / h) <= 1e-10);
}

TEST_CASE("boxes that begin side by side in each other part within the step") {
  constexpr double size = 0.2, depth = 0.005, h = 0.01;
  BodyScene build({.friction = 0.5});
  build.ground();
  for (const double y : {0.0, size - depth})
    build.box(Vec3::Constant(size), 1, {.position = {0, y, size / 2}});
  const Scene scene = build.finish();
  for (const std::string outer : {"auto", "proximal"}) {
    Method method;
    method.outer = outer;
    method.tolerance = 1e-10;
    const State end = run(scene, method, h, 1);
    // The tolerance is of the 0.25 m/s at which they part.
    CHECK(end.x(1, 2) - end.x(1, 1) >= size - 1e-10);
  }
}

TEST_CASE("auto goes on by direct on few contacts and by sweeps on many") {
  constexpr double size = 0.2, h = 0.01;
  const bool many = GENERATE(false, true);
  BodyScene build({.friction = 0.2});
  build.ground();
  const auto box = [&](double x, double y, double z, double speed = 0) {
    build.box(Vec3::Constant(size), 1, {.position = {x, y, z}, .velocity = {speed, speed / 2, 0}});
  };
  for (int copy = 0; copy < (many ? 20 : 1); ++copy) {
    box(copy, 0, size / 2);
    box(copy + size, size, size / 2);
    box(copy + size, 1e-6, size / 2);
    // It slides, comes to rest and turns, so that conjugate gradients spend their sweeps.
    box(copy + size / 2 + 1e-6, size / 2, 3 * size / 2, 0.1);
  }
  const Scene scene = build.finish();
  Method method;
  method.tolerance = 1e-7;
  Workspace workspace(scene, method);
  State state = scene.initial;
  std::set<std::string_view> parts;
  for (int k = 0; k < 10; ++k) {
    const Report report = step(workspace, h, state);
    REQUIRE(report.status == Status::ok);
    parts.insert(report.linear_part);
  }
  CHECK((workspace.contacts().size() > 200) == many);
  if (many) CHECK(parts.contains("gauss_seidel"));
  CHECK(parts.contains("semismooth_newton") == !many);
}

// A rod leans on a smooth wall by balls of 1e-7 m: less than rounding is told of these from step to step.
TEST_CASE("what is tiny where it stands is not let go by rounding") {
  constexpr double tip = 1e-7, half = 0.5;
  const double angle = 0.9 + 0.011 * GENERATE(range(0, 40));
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const Eigen::Quaterniond across(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
  const Eigen::Quaterniond leaning(Eigen::AngleAxisd(std::numbers::pi + angle, Vec3::UnitY()));
  const Vec3 up = leaning * Vec3::UnitX();
  const Vec3 middle(tip + half * std::abs(up.x()), 0, tip + half * std::abs(up.z()));
  const int rod = add_body(scene, middle, 1, Vec3(1e-3, 1, 1) * (4 * half * half / 12), leaning);
  Contact contact;
  contact.materials = 2;
  contact.law = {{.friction = 1}, {.friction = 0}, {.friction = 0}, {.friction = 0}};
  contact.collider = {
      {HalfSpace{}, 0},
      {.shape = HalfSpace{}, .body = 0, .frame = {Vec3::Zero(), across.toRotationMatrix()}, .material = 1},
      {.shape = Sphere{tip}, .body = rod, .frame = {half * Vec3::UnitX()}},
      {.shape = Sphere{tip}, .body = rod, .frame = {-half * Vec3::UnitX()}}};
  scene.effects = {Gravity{}, contact};
  Method method;
  method.relaxation = "direct";
  method.tolerance = 1e-12;
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < 100; ++k) REQUIRE(step(workspace, 0.01, state).status == Status::ok);
  INFO("at " << angle << " rad");
  CHECK((state.x.col(rod) - middle).norm() < 1e-6);
}

namespace {

/// A cube of 0.4 m and 0.64 kg beside a fixed cube of 1 m at the origin.
struct BesideCube {
  Vec3 position, velocity, spin;  // m, m/s, rad/s about its own axes
  Eigen::Quaterniond turn;
  double friction;
};

Scene beside_cube(const BesideCube& cube, const std::string& table) {
  BodyScene build({.friction = cube.friction});
  build.fixed(unit_cube(table), {Vec3::Zero()});
  build.box(Vec3::Constant(0.4), 0.64, {cube.position, cube.turn.normalized(), cube.velocity, cube.spin});
  return build.finish();
}

}  // namespace

// Its free motion ends 6 mm from the other one. The plane of a feature that it comes near to on its way goes
// on, and is cut by 8 mm there.
TEST_CASE("a cube that comes by another one's border without touching keeps its motion") {
  constexpr double h = 0.01;
  const auto table = GENERATE(as<std::string>(), "box", "hull", "mesh");
  const BesideCube cube{{-0.39367649562554663, -0.64004145335937024, 0.82472902473738252},
                        {1.34306, -0.268932, -1.69416},
                        {3.15544, 3.8962, 2.2043},
                        {0.26236298520711343, -0.12045735455615759, 0.22289631831433554, 0.93111380668984745},
                        0};
  const Scene scene = beside_cube(cube, table);
  const State end = run(scene, contact_method("direct"), h, 1);
  const Vec3 free = cube.velocity - h * pbdcheck::gravity * Vec3::UnitZ();
  CHECK((end.v.col(1) - free).norm() <= 1e-12 * free.norm());
  CHECK((end.spin.col(1) - cube.spin).norm() <= 1e-12 * cube.spin.norm());
}
