// Steps that are not searched for contacts, since all is known to be far apart.
#include "effects/clearance.h"

#include "contact_runs.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

constexpr double time_step = 0.01;

bool same(const Points& one, const Points& two) {
  return (one.array() == two.array()).all();
}

/// Makes `steps` in one workspace, each also in one that knows of nothing before, from which the first one
/// may not differ. `disturb` changes the scene and the state before step k. Steps with contacts are counted.
template <class Disturb>
int touching_steps(Scene scene, int steps, Disturb&& disturb) {
  Method method = contact_method("direct");
  method.warm_start = false;
  Workspace kept(scene, method);
  State state = scene.initial;
  int touching = 0;
  for (int k = 0; k < steps; ++k) {
    disturb(k, kept, scene, state);
    State expected = state;
    Workspace fresh(scene, method);
    const Report alone = step(fresh, time_step, expected), report = step(kept, time_step, state);
    INFO("step " << k);
    CHECK(report.status == Status::ok);
    CHECK(report.status == alone.status);
    CHECK(same(state.x, expected.x));
    CHECK(same(state.v, expected.v));
    if (!kept.contacts().empty()) ++touching;
  }
  return touching;
}

}  // namespace

TEST_CASE("what falls and flies from far apart meets as if every step were searched") {
  BodyScene build({.friction = 0.3, .restitution = 0.5});
  build.ground(0.1);
  build.box({0.2, 0.3, 0.4}, 1, {.position = {0, 0, 2}, .spin = {3, 1, 2}});
  build.ball(0.1, 1, {.position = {2, 0, 1.5}, .velocity = {-5, 0, 3}});
  build.ball(0.2, 1, {.position = {-2, 0, 1.5}, .velocity = {5, 0, 3}});
  Scene scene = build.finish();
  auto& contact = std::get<Contact>(scene.effects.back());
  for (int k = 0; k < 3; ++k) {
    contact.node.push_back(add_node(scene, Vec3(0.3 * k, 1, 3), 0.1));
    contact.radius.push_back(0.02);
    contact.node_material.push_back(0);
  }
  CHECK(touching_steps(scene, 90, [](int, Workspace&, Scene&, State&) {}) > 10);
}

TEST_CASE("a ground that begins to turn and a body that is moved are met without a search before") {
  BodyScene build({.friction = 0}, 0);
  const int ground = build.ground();
  const int ball = build.ball(0.1, 1, {.position = {3, 0, 2}});
  Scene scene = build.finish();
  const bool turns = GENERATE(true, false);
  const auto node = scene.bodies[static_cast<std::size_t>(ball)].node;
  CHECK(touching_steps(scene, 20, [&](int k, Workspace&, Scene&, State& state) {
          if (k < 10) state.v(0, node) = 0.01;  // it goes a little
          if (k == 10 && turns) state.spin.col(ground) = Vec3(0, -0.9 / time_step, 0);
          if (k == 10 && !turns) state.x(2, node) = 0.1;
        }) > 0);
}

TEST_CASE("what a spring that is tightened pulls farther than it flies is stopped at the ground") {
  BodyScene build({.friction = 0}, 0);
  build.ground();
  Scene scene = build.finish();
  const int held = add_node(scene, Vec3(0, 0, -5), infinity),
            node = add_node(scene, Vec3(0, 0, 2), 1, Vec3(1e-3, 0, 0));
  auto& contact = std::get<Contact>(scene.effects.back());
  contact.node = {node};
  contact.radius = {0.1};
  contact.node_material = {0};
  const std::size_t links = scene.effects.size();
  scene.effects.emplace_back(Distance{.node = {{held, node}}, .rest_length = {0}, .compliance = {1e6}});
  CHECK(touching_steps(scene, 20, [&](int k, Workspace& kept, Scene& now, State&) {
          if (k != 10) return;
          std::get<Distance>(now.effects[links]).compliance = {1e-6};
          kept.change(links, now.effects[links]);
        }) > 5);
}

TEST_CASE("a clearance is used up by ways, courses and turns, and by what is no number") {
  BodyScene build({}, 0);
  build.ground();
  const int box = build.box({0.2, 0.2, 0.2}, 1, {.position = {0, 0, 10}});
  const Scene scene = build.finish();
  const Contact& contact = *pbdcheck::contact_of(scene);
  Bodies bodies(scene);
  Points x, v;
  bodies.begin(scene.initial, x, v);
  std::vector<Pose> pose;
  bodies.place(x, pose);
  const Configuration start{x, pose, 0};
  Clearance clearance(contact);
  const Vec3 half = Vec3::Constant(0.1), centre(0, 0, 10), endless = Vec3::Constant(infinity);
  const std::vector<MovingBox> boxes{{{-endless, endless}, false, 0},
                                     {{centre - half, centre + half}, true, 1}};
  clearance.look(boxes, start, 0.01, [](int, int) { return true; });
  // 9.9 m are free: of 4096, 256 and 16 ways the second one, 2.56 m.
  const auto holds = [&](const Points& at, const Points& straight, const Points& to) {
    std::vector<Pose> there;
    bodies.place(at, there);
    const Configuration from{at, there, 0};
    clearance.begin(bodies, from, straight);
    return clearance.holds(bodies, from, to);
  };
  const auto node = scene.bodies[static_cast<std::size_t>(box)].node;
  const auto moved = [&](Eigen::Index column, double by) {
    Points there = x;
    there(1, column) += by;
    return there;
  };
  const Eigen::Index turned = bodies.column(box);
  const double arc = 1 / pose[static_cast<std::size_t>(box)].turn_per_arc.norm();  // m, of less than 1 rad
  CHECK(holds(x, x, x));
  CHECK(holds(moved(node, 1.4), moved(node, 1.4), moved(node, 1.4)));
  CHECK_FALSE(holds(moved(node, 2.56), moved(node, 2.56), moved(node, 2.56)));
  CHECK_FALSE(holds(x, moved(node, 2.56), x));
  CHECK_FALSE(holds(x, x, moved(node, 2.56)));
  CHECK(holds(x, x, moved(turned, arc)));
  CHECK_FALSE(holds(x, x, moved(turned, 100 * arc)));
  CHECK_FALSE(holds(x, x, moved(bodies.column(0), 1)));  // the ground's
  for (const Eigen::Index column : {Eigen::Index{node}, turned}) {
    const Points none = moved(column, std::numeric_limits<double>::quiet_NaN());
    CHECK_FALSE(holds(x, x, none));
    CHECK_FALSE(holds(x, none, column == turned ? none : x));
    CHECK_FALSE(holds(none, x, x));
  }
}
