// Limits that have no rows while nothing comes near them.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "body_scenes.h"
#include "effects/angle_joint.h"
#include "effects/body_distance.h"
#include "effects/slide_joint.h"
#include "error.h"
#include "rows/effect_constraint.h"
#include "scenes/contacts.h"
#include "step/step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double waiting_step_s = 0.01;  // s
const std::vector<std::array<int, 2>> two_bodies{{0, 1}};
const std::vector<ForceBounds> idle_above_0{{0, infinity}};

/// Two bodies at places of their own.
struct Placed {
  Points x;
  std::vector<Pose> pose;
  double time = 0;

  Configuration at() const { return {x, pose, time}; }
};

template <class E>
double value_at(const E& effect, const Placed& placed) {
  typename Constraint<E>::Value value;
  typename Constraint<E>::Jacobian unused;
  Constraint<E>::evaluate(effect, 0, local_at(effect, 0, {0, 2, 1, 3}, placed.at()), value, unused);
  return value[0];
}

/// The part of the gap that is told for the way between two places, and the part that closes.
template <class E>
std::array<double, 2> parts_closed(const E& effect, const Placed& from, const Placed& to) {
  const double gap = value_at(effect, from);
  SeenBodies seen({0, 1});
  seen.see(from.at());
  const auto own = local_at(effect, 0, {0, 2, 1, 3}, from.at());
  return {Constraint<E>::approach(effect, 0, own, gap).part(seen.wandered(to.at())),
          (gap - value_at(effect, to)) / gap};
}

class Places {
 public:
  Placed any() {
    Placed placed{Points::Zero(3, 4), {}};
    for (int b = 0; b < 2; ++b) placed.pose.push_back({direction(), turned(direction()), {}});
    return placed;
  }

  Placed near(const Placed& from, double way, double turn) {
    Placed placed = from;
    for (Pose& pose : placed.pose) {
      pose.x += way * direction();
      pose.rotation = turned(turn * direction()) * pose.rotation;
    }
    placed.time += way;
    return placed;
  }

  Vec3 direction() {
    Vec3 found;
    for (double& each : found) each = normal_(random_);
    return found.normalized();
  }

 private:
  static Eigen::Matrix3d turned(const Vec3& by) { return rotation_by(by).toRotationMatrix(); }

  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

/// No way closes more than is told, of ways that are told not to come to a stop; how many those are.
template <class E, class Make>
int most_told(Make&& make) {
  Places places;
  int told = 0;
  for (int k = 0; k < 20000; ++k) {
    const E effect = make(places);
    const Placed from = places.any();
    const double size = std::pow(10.0, -3 * (k % 100) / 100.0);
    if (!(value_at(effect, from) > 0)) continue;
    const Placed to = places.near(from, k % 3 == 0 ? 0 : size, k % 3 == 1 ? 0 : size);
    const auto [part, closed] = parts_closed(effect, from, to);
    if (!(part < 1)) continue;
    ++told;
    CHECK(closed < 1);
    CHECK(value_at(effect, to) > 0);
  }
  return told;
}

double swung_to(const State& state) {
  return std::atan2(-state.x(2, 1), state.x(0, 1));
}

}  // namespace

TEST_CASE("a limit is not reached by ways that are told to come a part of the way to it") {
  const auto distance = [](Places& places) {
    return BodyDistance{two_bodies, {{places.direction(), places.direction()}}, {0.3}, {0}, {}, idle_above_0};
  };
  CHECK(most_told<BodyDistance>(distance) > 5000);
  const auto slide = [](Places& places) {
    return SlideJoint{
        two_bodies,  {{places.direction(), places.direction()}}, {places.direction()}, {0.1}, {0.5}, {0}, {},
        idle_above_0};
  };
  CHECK(most_told<SlideJoint>(slide) > 2000);
  const auto angle = [](Places& places) {
    const Vec3 axis = places.direction();
    return AngleJoint{two_bodies, {axis},      {{axis.unitOrthogonal(), places.direction()}},
                      {0.4},      {0.5},       {0},
                      {},         idle_above_0};
  };
  CHECK(most_told<AngleJoint>(angle) > 2000);
}

TEST_CASE("the part of the way to a limit that is told is sharp for the ways that close it most") {
  Placed from{Points::Zero(3, 4), {2, {Vec3(0, 0, 0), Eigen::Matrix3d::Identity(), {}}}};
  from.pose[1].x.x() = 2;
  Placed to = from;
  SECTION("centres that go towards each other") {
    const BodyDistance links{two_bodies, {{Vec3(0, 0, 0), Vec3(0, 0, 0)}}, {1}, {0}, {}, idle_above_0};
    to.pose[0].x.x() += 0.2;
    to.pose[1].x.x() -= 0.2;
    const auto [part, closed] = parts_closed(links, from, to);
    CHECK(closed == Approx(part).epsilon(1e-12));
    const SlideJoint slide{two_bodies,  {{Vec3(0, 0, 0), Vec3(0, 0, 0)}}, {Vec3::UnitX()}, {1}, {0}, {0}, {},
                           idle_above_0};
    const auto [told, slid] = parts_closed(slide, from, to);
    CHECK(slid == Approx(told).epsilon(1e-12));
  }
  SECTION("bodies that turn against each other") {
    // asin(p) is taken for pi/3 p.
    const Vec3 z = Vec3::UnitZ(), x = Vec3::UnitX();
    const AngleJoint stop{two_bodies, {z}, {{x, x}}, {-0.5}, {0}, {0}, {}, idle_above_0};
    to.pose[0].rotation = rotation_by(Vec3(0, 0, 1e-4)).toRotationMatrix();
    to.pose[1].rotation = rotation_by(Vec3(0, 0, -1e-4)).toRotationMatrix();
    const auto [part, closed] = parts_closed(stop, from, to);
    CHECK(part / closed == Approx(std::numbers::pi / 3).epsilon(1e-6));
  }
}

TEST_CASE("a limit that nothing comes near has no row and no force, and changes no bit") {
  const Scene free_scene = [] {
    Scene scene;
    add_world(scene);
    add_body(scene, Vec3(1, 0, 0), 1, Vec3(0.1, 0.2, 0.3), Eigen::Quaterniond::Identity(), Vec3(0, 1, 0),
             Vec3(1, 2, 3));
    scene.effects.emplace_back(Gravity{});
    scene.effects.emplace_back(Gyroscopic{});
    return scene;
  }();
  Scene roped = free_scene;
  const std::vector<ForceBounds> below{{-infinity, 0}};
  roped.effects.emplace_back(
      BodyDistance{two_bodies, {{Vec3(0, 0, 0), Vec3(0.1, 0, 0)}}, {9}, {0}, {}, below});
  Workspace alone(free_scene, {}), with(roped, {});
  State expected = free_scene.initial, state = roped.initial;
  for (int k = 0; k < 100; ++k) {
    CHECK(step(alone, waiting_step_s, expected).status == Status::ok);
    CHECK(step(with, waiting_step_s, state).status == Status::ok);
    CHECK(with.costs().at(0).rows == 0);
    CHECK(with.forces(2) == std::vector<double>{0});
    CHECK(with.impulses(2) == std::vector<double>{0});
  }
  CHECK(state.x == expected.x);
  CHECK(state.v == expected.v);
  CHECK(state.spin == expected.spin);
}

TEST_CASE("a limit that waits holds what a collision throws beyond it within the step") {
  pbdcheck::BodyScene build({.friction = 0});
  const int held = build.ball(0.1, 1, {Vec3(0.9, 0, 0)});
  build.ball(0.1, 1, {Vec3(0.2, 0, 0), Eigen::Quaterniond::Identity(), Vec3(60, 0, 0)});
  Scene scene = build.finish();
  std::erase_if(scene.effects, [](const Effect& effect) { return std::holds_alternative<Gravity>(effect); });
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  const int world = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const std::vector<ForceBounds> below{{-infinity, 0}};
  scene.effects.emplace_back(BodyDistance{{{world, held}}, {centres}, {0.92}, {0}, {}, below});
  for (const std::string relaxation : {"gauss_seidel", "conjugate_gradients", "direct"}) {
    INFO(relaxation);
    Method method;
    method.relaxation = relaxation;
    Workspace workspace(scene, method);
    State state = scene.initial;
    CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
    const Vec3 at = state.x.col(scene.bodies[static_cast<std::size_t>(held)].node);
    CHECK(at.norm() == Approx(0.92).epsilon(1e-6));
    CHECK(workspace.forces(scene.effects.size() - 1).at(0) < 0);
  }
}

TEST_CASE("limits that wait stop what comes to them slowly or fast, and wait again") {
  const auto speed = GENERATE(0.01, 1.0, 30.0);  // rad/s
  constexpr double most = 1.2;                   // rad
  Scene scene;
  add_world(scene);
  add_body(scene, Vec3(0.5, 0, 0), 2, Vec3(1e-3, 2.0 / 12, 2.0 / 12), Eigen::Quaterniond::Identity(),
           Vec3(0, 0, -0.5 * speed), Vec3(0, speed, 0));
  const Vec3 y = Vec3::UnitY(), x = Vec3::UnitX();
  scene.effects.emplace_back(PointJoint{two_bodies, {{Vec3::Zero(), Vec3(-0.5, 0, 0)}}, {0}});
  scene.effects.emplace_back(AxisJoint{two_bodies, {{y, y}}, {0}});
  scene.effects.emplace_back(AngleJoint{{{0, 1}, {0, 1}},
                                        {y, y},
                                        {{x, x}, {x, x}},
                                        {-most, most},
                                        {0, 0},
                                        {0, 0},
                                        {},
                                        {{0, infinity}, {-infinity, 0}}});
  Workspace workspace(scene, {});
  State state = scene.initial;
  const double turn = speed * waiting_step_s;
  INFO(speed << " rad/s");
  // From 0 to one stop, and back to the other.
  for (const auto& [way, stop] : {std::pair{most, 1}, std::pair{2 * most, 0}}) {
    const double sign = stop == 1 ? 1 : -1;
    state.spin.col(1) = Vec3(0, sign * speed, 0);
    state.v.col(1) = state.spin.col(1).cross(state.x.col(1));
    const int steps = static_cast<int>(1.5 * way / turn) + 2;
    std::int64_t rows = 0, least = 2;
    for (int k = 0; k < steps; ++k) {
      CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
      CHECK(std::abs(swung_to(state)) <= most + 1e-8);
      rows += workspace.costs().at(2).rows;
      least = std::min(least, workspace.costs().at(2).rows);
      if (k + 1 < steps) continue;
      CHECK(sign * workspace.forces(2)[static_cast<std::size_t>(stop)] <= 0);
      CHECK(swung_to(state) == Approx(sign * most).epsilon(1e-6));
    }
    if (turn < 0.02) CHECK(rows < steps);  // of two a step: each limit waits most of the time
    if (turn < 0.02) CHECK(least == 0);
  }
}

TEST_CASE("a limit that waits is looked at anew where it is changed") {
  Scene scene = linked_body(1, 2, 0, {{-infinity, 0}});
  Workspace workspace(scene, {});
  State state = scene.initial;
  const auto rope = std::find_if(scene.effects.begin(), scene.effects.end(), [](const Effect& effect) {
    return std::holds_alternative<BodyDistance>(effect);
  });
  const auto index = static_cast<std::size_t>(rope - scene.effects.begin());
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.costs().at(0).rows == 0);
  auto shorter = std::get<BodyDistance>(*rope);
  shorter.rest_length = {0.9};
  workspace.change(index, shorter);
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.costs().at(0).rows == 1);
  CHECK(workspace.forces(index)[0] < 0);
}

TEST_CASE("ropes that wait take no other bodies or number, and stop what they stopped") {
  Scene scene;
  add_world(scene);
  for (const double y : {0.0, 5.0})
    add_body(scene, Vec3(1, y, 0), 1, Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3(1, 0, 0));
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  const BodyDistance ropes{{{0, 1}, {1, 2}}, {centres, centres}, {1.5, 8}, {0, 0}, {}, {2, {-infinity, 0}}};
  scene.effects.emplace_back(ropes);
  Workspace workspace(scene, {});
  State state = scene.initial;
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.costs().at(0).rows == 0);
  BodyDistance other = ropes;
  SECTION("other bodies") {
    other.body[0] = {0, 2};
  }
  SECTION("one rope less") {
    other.body.pop_back(), other.point.pop_back(), other.rest_length.pop_back();
    other.compliance.pop_back(), other.bounds.pop_back();
  }
  SECTION("one that gives way") {
    other.compliance[0] = 1e-3;
  }
  CHECK_THROWS_AS(workspace.change(0, other), SetupError);
  for (int k = 0; k < 100; ++k) {
    CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
    CHECK(state.x.col(1).norm() <= 1.5 + 1e-8);
  }
  CHECK(state.x.col(1).norm() > 1.4);
}

TEST_CASE("a limit that is made a motor between steps drives from then on") {
  Scene scene;
  add_world(scene);
  add_body(scene, Vec3(1, 0, 0), 1, Vec3::Ones());
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  SlideJoint slide{two_bodies, {centres}, {Vec3::UnitX()}, {0}, {0}, {0}, {}, idle_above_0};
  scene.effects.emplace_back(slide);
  Workspace workspace(scene, {});
  State state = scene.initial;
  if (GENERATE(true, false)) {
    CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
    CHECK(workspace.forces(0) == std::vector<double>{0});
  }
  slide.bounds = {{-5, 5}};
  slide.rest_position = {2};
  workspace.change(0, slide);
  CHECK(step(workspace, waiting_step_s, state).status == Status::ok);
  CHECK(workspace.forces(0).at(0) == Approx(5).epsilon(1e-12));
}

TEST_CASE("a limit that waits is called before it is reached where no iterate is near a solution") {
  Scene scene = rod_chain(20);  // turns; one sweep a step leaves it far from solved
  std::erase_if(scene.effects, [](const Effect& effect) { return std::holds_alternative<Gravity>(effect); });
  const int body =
      add_body(scene, Vec3::Zero(), 1, Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3(1, 0, 0));
  const std::vector<ForceBounds> below{{-infinity, 0}};
  const std::array<Vec3, 2> centres{Vec3(0, 0, 0), Vec3(0, 0, 0)};
  scene.effects.emplace_back(SlideJoint{{{0, body}}, {centres}, {Vec3::UnitX()}, {1}, {0}, {0}, {}, below});
  Method method;
  method.outer = "plain";
  method.relaxation = "gauss_seidel";
  method.max_outer = method.max_sweeps = 1;
  Workspace workspace(scene, method);
  State state = scene.initial;
  std::int64_t rows = 0;
  for (int k = 0; k < 150; ++k) {
    CHECK(step(workspace, waiting_step_s, state).status == Status::not_converged);
    CHECK(state.x(0, scene.bodies[static_cast<std::size_t>(body)].node) <= 1 + 1e-9);
    rows += workspace.costs().back().rows;
  }
  CHECK(state.x(0, scene.bodies[static_cast<std::size_t>(body)].node) == Approx(1).epsilon(1e-9));
  CHECK(rows <= 50 + 8);  // it rests for 50 steps, and 4 of both bodies are 8 of one
}

TEST_CASE("a stop that waits holds a ball that friction turns past it by a whole turn in a step") {
  constexpr double most = 1;  // rad
  const auto down =
      GENERATE(9.6, 9.8, 10.04, 10.4);  // m/s; friction makes 25 rad/s of each, at 1/40 s a turn
  pbdcheck::BodyScene build({.friction = 1});
  build.ground();
  const int ball = build.ball(0.1, 1, {Vec3(0, 0, 0.101), Eigen::Quaterniond::Identity(), Vec3(0, 0, -down)});
  Scene scene = build.finish();
  for (Effect& effect : scene.effects)
    if (auto* contact = std::get_if<Contact>(&effect))
      contact->collider[0].surface_velocity = Vec3(400, 0, 0);
  const Vec3 y = Vec3::UnitY(), x = Vec3::UnitX();
  scene.effects.emplace_back(
      AngleJoint{{{add_world(scene), ball}}, {y}, {{x, x}}, {-most}, {0}, {0}, {}, idle_above_0});
  INFO(down << " m/s");
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark", "generalised_alpha"}) {
    INFO(integrator);
    Method method;
    method.integrator = integrator;
    Workspace workspace(scene, method);
    State state = scene.initial;
    CHECK(step(workspace, 0.025, state).status == Status::ok);
    const Vec3 turned = state.orientation[static_cast<std::size_t>(ball)] * x;
    CHECK(std::atan2(-turned.z(), turned.x()) >= -most - 1e-6);
    CHECK(workspace.forces(scene.effects.size() - 1).at(0) > 0);
  }
}
