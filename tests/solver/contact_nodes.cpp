// Spheres of nodes that touch each other.
#include "contact_runs.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double nodes_h = 0.01;

/// Nodes of these radii at places along x, with velocities along it; friction 0.5.
struct Row {
  std::vector<double> mass, radius, place, speed;
};
Scene row_of(const Row& row, double restitution, bool touch = true) {
  Scene scene;
  Contact contact{.collider = {}};
  contact.nodes_touch = touch;
  contact.law = {{.friction = 0.5, .restitution = restitution}};
  for (std::size_t i = 0; i < row.mass.size(); ++i) {
    contact.node.push_back(add_node(scene, Vec3(row.place[i], 0, 0), row.mass[i], Vec3(row.speed[i], 0, 0)));
    contact.radius.push_back(row.radius[i]);
    contact.node_material.push_back(0);
  }
  scene.effects = {contact};
  return scene;
}

/// They approach at 1 m/s, 2 mm apart.
Row pair() {
  return {{1, 3}, {0.1, 0.2}, {0, 0.302}, {1, 0}};
}

}  // namespace

// m_a v_a + m_b v_b = 1 kg m/s; without restitution the gap closes, v_a - v_b = 2 mm/h.
TEST_CASE("nodes that meet share their momentum, and part at their share of the speed") {
  for (const auto relaxation : {"direct", "gauss_seidel", "jacobi", "conjugate_gradients"}) {
    INFO(relaxation);
    const Method method = contact_method(relaxation);
    const State dull = run(row_of(pair(), 0), method, nodes_h, 1);
    CHECK(std::abs(dull.v(0, 1) - 0.2) <= 1e-10);
    CHECK(std::abs(dull.v(0, 0) - 0.4) <= 1e-10);
    const State later = run(row_of(pair(), 0), method, nodes_h, 3);
    CHECK(std::abs(later.v(0, 0) - later.v(0, 1)) <= 1e-10);
    CHECK(std::abs(later.x(0, 1) - later.x(0, 0) - 0.3) <= 1e-10);
    const State lively = run(row_of(pair(), 0.5), method, nodes_h, 1);
    CHECK(std::abs(lively.v(0, 1) - lively.v(0, 0) - 0.5) <= 1e-10);
    CHECK(std::abs(lively.v(0, 0) + 3 * lively.v(0, 1) - 1) <= 1e-10);
  }
}

TEST_CASE("nodes go through each other unless they are to touch, and so do those of one element") {
  const State free = run(row_of(pair(), 0, false), contact_method("direct"), nodes_h, 100);
  CHECK(free.v(0, 0) == 1);
  CHECK(free.v(0, 1) == 0);
  // A chain whose spheres overlap their neighbours': the last node hits the first one's sphere alone.
  Scene scene = row_of({{1, 1, 1}, {0.2, 0.1, 0.2}, {0, 0.3, 0.5}, {0, 0, -0.5}}, 0);
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}, {1, 2}}, .rest_length = {0.3, 0.2}, .compliance = {1, 1}});
  Workspace workspace(scene, contact_method("direct"));
  State state = run(scene, contact_method("direct"), nodes_h, 1, workspace);
  CHECK(workspace.contacts().empty());
  double least = infinity;  // m
  for (int k = 0; k < 40; ++k) {
    REQUIRE(step(workspace, nodes_h, state).status == Status::ok);
    least = std::min(least, state.x(0, 2) - state.x(0, 0));
    for (const ContactForce& each : workspace.contacts()) CHECK(each.collider == std::array{0, 2});
  }
  CHECK(std::abs(least - 0.4) <= 1e-10);
}

// Three spheres of infinite mass carry a fourth: their normals lean by cos = height/(r_a + r_b).
TEST_CASE("a node that lies on three others presses on each by its share of the weight") {
  constexpr double radius = 0.1, mass = 2;
  for (const double friction : {0.0, 0.5}) {
    Scene scene;
    Contact contact{.collider = {}};
    contact.nodes_touch = true;
    contact.law = {{.friction = friction}};
    const double around = 2 * radius / std::sqrt(3.0),
                 height = std::sqrt(4 * radius * radius - around * around);
    for (int i = 0; i < 3; ++i)
      add_node(scene, around * Vec3(std::cos(2.0944 * i), std::sin(2.0944 * i), 0), infinity);
    add_node(scene, Vec3(0, 0, height + 1e-3), mass);
    for (int i = 0; i < 4; ++i) {
      contact.node.push_back(i);
      contact.radius.push_back(radius);
      contact.node_material.push_back(0);
    }
    scene.effects = {Gravity{}, contact};
    Workspace workspace(scene, contact_method("direct"));
    const State end = run(scene, contact_method("direct"), nodes_h, 50, workspace);
    CHECK(end.v.cwiseAbs().maxCoeff() <= 1e-9);
    CHECK(std::abs(end.x(2, 3) - height) <= 1e-5);  // 2.0944 is not a third of a turn
    Vec3 sum = Vec3::Zero();
    for (const ContactForce& each : workspace.contacts()) {
      sum += each.collider[0] == 3 ? each.force : Vec3(-each.force);
      if (friction == 0)
        CHECK(std::abs(each.normal.dot(each.force) - mass * gravity / 3 / (height / (2 * radius))) <= 1e-4);
    }
    CHECK((sum - Vec3(0, 0, mass * gravity)).norm() <= 1e-8);
  }
}
