// Contact of closed meshes in a step, against boxes, balances and all pairs.
#include <random>

#include "contact_runs.h"
#include "refined.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using namespace pbdcheck;

namespace {

/// An octahedron's triangles cut into four, `times` times, and the nodes moved onto a sphere.
TriangleMesh ball_surface(double radius, int times) {
  TriangleMesh mesh{(Points(3, 6) << 1, -1, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 1, -1).finished(),
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int k = 0; k < times; ++k) mesh = refined(mesh);
  mesh.x = radius * mesh.x.colwise().normalized();
  return mesh;
}

}  // namespace

TEST_CASE("a closed mesh of a cube rests as the box does") {
  const Vec3 size = Vec3::Constant(0.2);
  for (const bool on_mesh : {false, true}) {
    const auto scene_of = [&](bool mesh) {
      BodyScene build({.friction = 0.5});
      const Vec3 slab(1, 1, 0.1);
      if (on_mesh)
        build.fixed(mesh ? Shape(ClosedMesh(refined(box_surface(slab)))) : Shape(Box{slab}),
                    {Vec3(0, 0, -0.05)});
      else
        build.ground();
      build.box(size, 8, {Vec3(0.01, 0.02, 0.1), Eigen::Quaterniond::Identity(), Vec3(0.3, 0.1, 0)});
      if (mesh) build.contact().collider.back().shape = ClosedMesh(box_surface(size));
      return build.finish();
    };
    const Scene box = scene_of(false), mesh = scene_of(true);
    const Method method = contact_method("direct");
    Workspace of_box(box, method), of_mesh(mesh, method);
    const State end = run(box, method, 0.01, 30, of_box), mesh_end = run(mesh, method, 0.01, 30, of_mesh);
    INFO((on_mesh ? "on a mesh" : "on a half space"));
    CHECK(std::abs(ground_force(of_mesh).z() / weight(mesh) - 1) <= 1e-9);
    CHECK((end.x - mesh_end.x).cwiseAbs().maxCoeff() <= 1e-9);
    CHECK(end.x(0, 1) > 0.015);  // it has slid
    CHECK(of_mesh.contacts().size() >= of_box.contacts().size());
  }
}

// What stands still moves by at most the tolerance of g h^2 a step, over the share of its inertia that a
// corner moves: far below 1e-8 m in 20 steps.
TEST_CASE("equal cubes of triangles stand flush on each other, or turned, or shifted") {
  const Vec3 size = Vec3::Constant(0.2);
  const double turn = GENERATE(0.0, 0.3);
  const Vec3 shift = GENERATE(Vec3(0, 0, 0), Vec3(0.03, 0, 0), Vec3(0.03, 0.05, 0));
  const bool boxes = GENERATE(false, true);  // every other cube is a box
  BodyScene build({.friction = 0.5});
  build.ground();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(k * turn, Vec3::UnitZ()));
    build.box(size, 8, {(k % 2) * shift + Vec3(0, 0, 0.1 + 0.2 * k), turned});
    if (!boxes || k % 2 == 0) build.contact().collider.back().shape = ClosedMesh(box_surface(size));
  }
  const Scene scene = build.finish();
  for (const auto relaxation : {"conjugate_gradients", "direct"}) {
    INFO(relaxation << ", turned by " << turn << ", shifted by " << shift.transpose() << ", boxes " << boxes);
    Method method = contact_method(relaxation);
    method.tolerance = 1e-8;
    const State end = run(scene, method, 0.01, 20);
    CHECK((end.x - scene.initial.x).cwiseAbs().maxCoeff() <= 1e-8);
  }
}

TEST_CASE("a ball of triangles on a plate of triangles gets the impulse that stops it") {
  constexpr double h = 0.005, mass = 2, radius = 0.1;
  BodyScene build({.friction = 0.5});
  build.fixed(ClosedMesh(refined(refined(box_surface({1, 1, 0.1})))), {Vec3(0, 0, -0.05)});
  build.ball(radius, mass, {Vec3(0.013, 0.027, 0.12), Eigen::Quaterniond(0.9, 0.3, 0.1, 0.2).normalized()});
  build.contact().collider.back().shape = ClosedMesh(ball_surface(radius, 2));
  const Scene scene = build.finish();
  const Method method = contact_method("direct");
  Workspace workspace(scene, method);
  State state = scene.initial;
  int touching = 0;
  for (int k = 0; k < 60; ++k) {
    const double before = state.v(2, 1);
    REQUIRE(step(workspace, h, state).status == Status::ok);
    CHECK(std::abs(mass * (state.v(2, 1) - before) / h + mass * gravity - ground_force(workspace).z()) <=
          1e-8 * mass * gravity);
    for (const ContactForce& contact : workspace.contacts()) CHECK(contact.gap >= -1e-9);
    touching += ground_force(workspace).z() > 0;
  }
  CHECK(touching > 30);
  CHECK(state.x(2, 1) <= radius + 1e-9);  // no higher than a ball that touches with a node
  CHECK(state.x(2, 1) >= 0.93 * radius);  // no lower than one on a face of a twice refined octahedron
}

TEST_CASE("what comes flush over a mesh's border without friction keeps its speed") {
  constexpr double width = 1, size = 0.4, speed = 1, h = 0.01;  // m, m/s, s
  const auto kind = GENERATE(as<std::string>(), "box", "hull", "mesh", "cylinder");
  const bool fine = GENERATE(false, true);
  const TriangleMesh table = box_surface(Vec3::Constant(width)), cube = box_surface(Vec3::Constant(size));
  std::mt19937 engine(9);
  std::uniform_real_distribution<> uniform(-1, 1);
  for (int draw = 0; draw < 5; ++draw) {
    BodyScene build({.friction = 0});
    build.fixed(ClosedMesh(fine ? refined(table) : table), {Vec3::Zero()});
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(uniform(engine), Vec3::UnitZ()));
    const double inside = 0.1 + 0.08 * uniform(engine);  // m, of the centre: it overhangs, and does not tip
    const Placing at{{-width / 2 + inside, 0.2 * uniform(engine), (width + size) / 2},
                     turned,
                     speed * Vec3(1, uniform(engine), 0)};
    if (kind == "box") build.box(Vec3::Constant(size), 1, at);
    if (kind == "hull") build.hull(ConvexHull(cube), 10, at);
    if (kind == "mesh") build.mesh(ClosedMesh(cube), 10, at);
    if (kind == "cylinder") build.cylinder(size / 2, size, 1, at);
    const Scene scene = build.finish();
    INFO(kind << ", fine " << fine << ", draw " << draw);
    const State end = run(scene, contact_method("direct"), h, 30);
    CHECK((end.v.col(1) - at.velocity).norm() <= 1e-9 * speed);
    CHECK(end.spin.col(1).norm() * size <= 1e-9 * speed);
  }
}

TEST_CASE("of a cloud of balls no pair overlaps after a step") {
  constexpr double radius = 0.1;
  constexpr int count = 150;
  std::mt19937 engine(5);
  std::uniform_real_distribution<> uniform(-1, 1);
  BodyScene build({.friction = 0}, 0);
  std::vector<Vec3> centres;
  while (centres.size() < count) {
    const Vec3 centre = 0.8 * Vec3(uniform(engine), uniform(engine), uniform(engine));
    if (std::any_of(centres.begin(), centres.end(),
                    [&](const Vec3& c) { return (c - centre).norm() < 2.01 * radius; }))
      continue;
    centres.push_back(centre);
    build.ball(radius, 1, {centre, Eigen::Quaterniond::Identity(), -3 * centre});
  }
  const Scene scene = build.finish();
  Workspace workspace(scene, contact_method("direct"));
  const State end = run(scene, contact_method("direct"), 0.02, 3, workspace);
  double nearest = infinity;
  int touching = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < i; ++j) {
      const double apart = (end.x.col(i) - end.x.col(j)).norm();
      nearest = std::min(nearest, apart);
      touching += apart <= 2 * radius + 1e-9;
    }
  CHECK(nearest >= 2 * radius - 1e-9);
  CHECK(touching > count / 4);
}
