// Spheres about nodes on deformable surfaces.
#include <algorithm>
#include <random>

#include "contact_runs.h"
#include "mesh.h"
#include "touching_sheets.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double sphere_radius = 0.05, sphere_mass = 0.3;  // m, kg

/// Spheres at these places above a surface; its nodes stand behind them.
Scene spheres(const std::vector<Vec3>& places, ContactLaw law, double pull = gravity) {
  Scene scene;
  Contact contact{.collider = {}};
  contact.law = {law};
  for (const Vec3& place : places) {
    contact.node.push_back(add_node(scene, place, sphere_mass));
    contact.radius.push_back(sphere_radius);
    contact.node_material.push_back(0);
  }
  if (pull > 0) scene.effects.emplace_back(Gravity{Vec3(0, 0, -pull)});
  scene.effects.emplace_back(contact);
  return scene;
}

constexpr double resting = sphere_radius + thickness / 2;  // m, of a centre over a surface

}  // namespace

TEST_CASE("a sphere about a node rests on triangles, edges and nodes alike, and they carry its weight") {
  const int cells = GENERATE(1, 3, 40);
  const Vec3 place = GENERATE(Vec3(0.013, 0.027, 0), Vec3(0, 0, 0), Vec3(0.15, 0.15, 0));
  const auto relaxation = GENERATE("direct", "gauss_seidel", "conjugate_gradients");
  const bool surfaces_touch = GENERATE(false, true);
  Scene scene = spheres({place + Vec3(0, 0, resting + 0.01)}, {.friction = 0.5});
  add_surface(scene, sheet(cells, 0.9, 0), true);
  contact_in(scene).surfaces_touch = surfaces_touch;
  const Method method = contact_method(relaxation);
  Workspace workspace(scene, method);
  const State end = run(scene, method, 0.01, 20, workspace);
  INFO(relaxation << ", " << cells << " cells");
  CHECK((end.x.col(0) - place - Vec3(0, 0, resting)).norm() <= 1e-9);
  Vec3 force = Vec3::Zero();
  for (const ContactForce& each : workspace.contacts()) {
    CHECK(each.collider[0] == 0);
    CHECK(each.collider[1] > 0);
    force += each.force;
    if (each.force.norm() > 0) CHECK(std::abs(each.point.z() - thickness / 2) <= 1e-9);
  }
  CHECK(std::abs(force.z() / weight(scene) - 1) <= 1e-9);
}

TEST_CASE("a sphere about a node and a free surface exchange momentum alone") {
  Scene scene = spheres({Vec3(0.02, -0.03, 0.1)}, {.friction = 0.6}, 0);
  scene.initial.v.col(0) = Vec3(0.4, 0.1, -2);
  const int first = add_surface(scene, sheet(6, 0.5, 0), false, 2);
  const Method method = contact_method("direct");
  const State end = run(scene, method, 0.002, 100);
  Vec3 sum = Vec3::Zero();
  for (int node = 0; node < scene.nodes(); ++node)
    sum += scene.mass[static_cast<std::size_t>(node)] * Vec3(end.v.col(node) - scene.initial.v.col(node));
  CHECK(sum.norm() <= 1e-10);
  CHECK(end.v.rightCols(scene.nodes() - first).row(2).mean() < -0.1);  // they have met
}

TEST_CASE("a sphere about a node that is thrown at a held surface stays on its side, however fast") {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> share(-1, 1);
  int met = 0;
  for (int number = 0; number < 300; ++number) {
    Scene scene = spheres({Vec3(0.3 * share(engine), 0.3 * share(engine), 0.3)}, {.friction = 0.5}, 0);
    constexpr double h = 0.01;
    const double speed = std::pow(100, (share(engine) + 1) / 2) * sphere_radius / h;
    scene.initial.v.col(0) = speed * Vec3(0.5 * share(engine), 0.5 * share(engine), -1).normalized();
    add_surface(scene, sheet(7, 40, 0), true);
    Workspace workspace(scene, contact_method("direct"));
    State state = scene.initial;
    for (int k = 0; k < 40; ++k) {
      const Report report = step(workspace, h, state);
      REQUIRE(report.status == Status::ok);
      REQUIRE(state.x(2, 0) >= resting - 1e-9);
    }
    met += state.v(2, 0) > -1e-9;
  }
  CHECK(met == 300);
}

TEST_CASE("a node touches no triangle with a node of its own link") {
  Scene scene = spheres({Vec3(0, 0, 0.02)}, {.friction = 0.5});
  const int first = add_surface(scene, sheet(2, 0.2, 0), true);
  const int middle = first + 4;
  scene.effects.emplace_back(Distance{.node = {{0, middle}}, .rest_length = {0.02}, .compliance = {0}});
  Workspace workspace(scene, contact_method("direct"));
  State state = scene.initial;
  for (int k = 0; k < 10; ++k) REQUIRE(step(workspace, 0.01, state).status == Status::ok);
  CHECK(workspace.contacts().empty());
}

// One cell, of corners 1 to 4 and triangles 1 2 4 and 1 4 3, or with the other diagonal. The sphere comes
// from beside: at a corner, or at the middle of the edge from 1 to 2.
TEST_CASE(
    "a sphere that flies at an edge or a corner is stopped, unless the triangles there are all its links'") {
  const bool at_corner = GENERATE(true, false);
  const int linked = GENERATE(0, 1, 2, 3, 4);
  Scene scene = spheres({at_corner ? Vec3(-0.2, -0.2, 0) : Vec3(0, -0.2, 0)}, {.friction = 0}, 0);
  const Vec3 to = at_corner ? Vec3(-0.1, -0.1, 0) : Vec3(0, -0.1, 0), way = to - scene.initial.x.col(0);
  scene.initial.v.col(0) = way;
  const int first = add_surface(scene, sheet(1, 0.2, 0), true);
  REQUIRE(first == 1);
  if (linked > 0)
    scene.effects.emplace_back(Distance{.node = {{0, linked}}, .rest_length = {0}, .compliance = {1e9}});
  const auto held = [&](int node) { return linked == node; };
  bool meets = linked == 0;
  for (const auto& triangle : contact_in(scene).triangle) {
    const bool there = std::find(triangle.begin(), triangle.end(), 1) != triangle.end() &&
                       (at_corner || std::find(triangle.begin(), triangle.end(), 2) != triangle.end());
    meets = meets || (there && std::none_of(triangle.begin(), triangle.end(), held));
  }
  const State end = run(scene, contact_method("direct"), 0.05, 20);
  const double left = (to - end.x.col(0)).dot(way.normalized());
  INFO("linked to " << linked << (at_corner ? ", at a corner" : ", at an edge"));
  CHECK((left >= resting - 1e-9) == meets);
}
