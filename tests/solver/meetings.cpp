// What meets on its way in one step, by closed forms. Momentum, and the gap that is closed where the step
// ends, give the impulse p: of a ball m, v and what it meets at the gap g before it,
//   h (v - p/m - (p/M + a^2 p/I)) = g,   a the arm of the impulse on a body M, I at rest.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "effects/searched_pairs.h"
#include "step/step.h"

using namespace pbd;

namespace {

/// A ball at rest in the origin's frame moves along x, `way` a step, at what stands at `x`.
struct ThrownBall {
  static constexpr double h = 0.01, radius = 0.1, ball_mass = 0.5;
  Scene scene;
  double speed;

  ThrownBall(double way, const Vec3& begin, const Shape& other, double mass, const Vec3& inertia)
      : speed(way / h) {
    Contact contact;
    contact.continuous = true;
    contact.law[0].friction = 0;
    add_body(scene, begin, ball_mass, Vec3::Constant(2e-3), Eigen::Quaterniond::Identity(),
             Vec3(speed, 0, 0));
    contact.collider.push_back({Sphere{radius}, 0});
    add_body(scene, Vec3::Zero(), mass, inertia);
    contact.collider.push_back({other, 1});
    scene.effects.emplace_back(contact);
  }

  struct End {
    State state;
    std::vector<ContactForce> contacts;
  };
  End end() const {
    Workspace workspace(scene, Method{});
    State state = scene.initial;
    REQUIRE(step(workspace, h, state).status == Status::ok);
    return {state, workspace.contacts()};
  }
};

}  // namespace

TEST_CASE("a fast ball meets another one on its way and goes on with it") {
  constexpr double h = ThrownBall::h, radius = ThrownBall::radius, ball_mass = ThrownBall::ball_mass;
  const double way = GENERATE(1.5, 10.0, 40.0), mass = GENERATE(0.01, 2.0, 1e3), gap = 0.7;
  const ThrownBall balls(way, Vec3(-gap - 2 * radius, 0, 0), Sphere{radius}, mass,
                         Vec3::Constant(0.01 * mass));
  const auto [end, contacts] = balls.end();
  const double p = (balls.speed - gap / h) / (1 / ball_mass + 1 / mass);
  INFO("way " << way << " m, " << mass << " kg");
  CHECK(end.v(0, 1) == Approx(p / mass).epsilon(1e-7));
  CHECK(end.v(0, 0) == Approx(balls.speed - p / ball_mass).epsilon(1e-7));
  CHECK(end.x(0, 1) - end.x(0, 0) == Approx(2 * radius).epsilon(1e-6));
  CHECK(end.spin.norm() <= 1e-9 * balls.speed);
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].met.has_value());
  CHECK(h * contacts[0].force.norm() == Approx(p).epsilon(1e-7));
}

TEST_CASE("a rod that is met far out turns by the impulse there, however far both have gone") {
  constexpr double h = ThrownBall::h, radius = ThrownBall::radius, ball_mass = ThrownBall::ball_mass;
  // The faster, the harder to turn: the rod leans towards the ball by its turn's square.
  const auto [way, inertia] = GENERATE(std::pair(2.0, 40.0), std::pair(20.0, 4000.0));
  const double arm = 0.4, mass = 3, gap = 0.9, thick = 0.05;
  // The rod slides along itself: its arm is the one where it is met, not where the step ends.
  const double slide = -0.3, at = gap / way;
  ThrownBall rod(way, Vec3(-gap - radius - thick, 0, arm + at * slide), Capsule{thick, 1.0}, mass,
                 Vec3(inertia, inertia, 0.01));
  rod.scene.initial.v.col(1) = Vec3(0, 0, slide / h);
  const auto [end, contacts] = rod.end();
  const double p = (rod.speed - gap / h) / (1 / ball_mass + 1 / mass + arm * arm / inertia);
  INFO("way " << way << " m");
  // When it is met is known to 3e-4 of its radius, of a way of which the arm changes by the slide's share.
  const double known = 1e-7 + 3e-4 * thick * std::abs(slide) / (way * arm);
  CHECK(end.v(0, 1) == Approx(p / mass).epsilon(known));
  CHECK(end.spin(1, 1) == Approx(arm * p / inertia).epsilon(known));
  CHECK(end.v(0, 0) == Approx(rod.speed - p / ball_mass).epsilon(known));
  REQUIRE(contacts.size() == 1);
  REQUIRE(contacts[0].met);
  const std::size_t of_rod = contacts[0].collider[0] == 1 ? 0 : 1;
  // Where it touched: on its side.
  CHECK(contacts[0].met->arm[of_rod].z() == Approx(arm));
  CHECK(contacts[0].met->arm[of_rod].x() == Approx(-thick).epsilon(1e-3));
}

TEST_CASE("what turns by more than half a turn a step is met where its turn leads it") {
  // The rod goes once round and a little on: by the shorter turn it would come near nothing.
  constexpr double h = ThrownBall::h, turn = 2 * std::numbers::pi + 0.2;
  ThrownBall rod(0, Vec3(GENERATE(0.4, -0.4), 0, 0), Capsule{0.05, 1.0}, 3, Vec3(0.3, 0.3, 0.01));
  rod.scene.initial.spin.col(1) = Vec3(0, turn / h, 0);
  const auto [end, contacts] = rod.end();
  CHECK(contacts.size() >= 1);
  CHECK(end.spin(1, 1) * h < turn - 0.1);
}

TEST_CASE("what was ahead of a ball before it was turned aside is not pushed") {
  constexpr double h = ThrownBall::h;
  ThrownBall balls(10, Vec3::Zero(), Sphere{0.1}, 1, Vec3::Constant(0.01));
  balls.scene.initial.x.col(1) = Vec3(2, -0.1, 0);
  const int ahead = add_body(balls.scene, Vec3(5, 0, 0), 1, Vec3::Constant(0.01));
  std::get<Contact>(balls.scene.effects[0]).collider.push_back({Sphere{0.1}, ahead});
  const auto [end, contacts] = balls.end();
  CHECK(end.v(1, 0) * h > 0.3);  // turned aside
  CHECK(end.v.col(ahead) == Vec3::Zero());
}

// A ball is stopped by a wall at x = 5 on its free way, and so comes to be where a heavy one, from aside,
// takes it along: by a contact whose normal is y, past the wall's end. That it spins changes nothing.
TEST_CASE("what is turned aside later is not held by what it would have met") {
  constexpr double h = ThrownBall::h, way = 10, stopped = 4.8, when = 0.48;  // m, m, of the step
  ThrownBall balls(way, Vec3::Zero(), Sphere{0.1}, infinity, Vec3::Constant(infinity));
  balls.scene.initial.x.col(1) = Vec3(5, 0, 0);
  balls.scene.initial.spin.col(0) = Vec3(0, 0, GENERATE(0.0, 3.1) / h);
  const int heavy = add_body(balls.scene, Vec3(stopped * when, -0.2 - way * when, 0), 1e6,
                             Vec3::Constant(1e4), Eigen::Quaterniond::Identity(), Vec3(0, way / h, 0));
  std::get<Contact>(balls.scene.effects[0]).collider.push_back({Sphere{0.1}, heavy});
  const auto [end, contacts] = balls.end();
  CHECK(end.x(1, 0) > 1);  // taken along
  CHECK(end.x(0, 0) == Approx(way).epsilon(1e-3));
}

TEST_CASE("what strikes a wall on its way does not come back, whatever the integrator carries on") {
  constexpr double way = 3, gap = 10;
  Method method;
  method.integrator = GENERATE("implicit_euler", "newmark", "bdf2", "generalised_alpha");
  const ThrownBall ball(way, Vec3(-gap - 0.1 - 0.5, 0, 0), Box{Vec3(1, 4, 4)}, infinity,
                        Vec3::Constant(infinity));
  Workspace workspace(ball.scene, method);
  State state = ball.scene.initial;
  INFO(method.integrator);
  for (int k = 0; k < 7; ++k) {
    REQUIRE(step(workspace, ThrownBall::h, state).status == Status::ok);
    CHECK(state.v(0, 0) >= -1e-6 * ball.speed);
  }
  CHECK(state.v(0, 0) <= 1e-6 * ball.speed);
  CHECK(state.x(0, 0) == Approx(-0.6).epsilon(1e-6));
}

// A rough ball meets the axis of a wheel whose side is a belt, as that has turned by a part of its turn.
TEST_CASE("a belt that turns drags what it meets as it stands there") {
  constexpr double h = ThrownBall::h, way = 10, gap = 4, turn = std::numbers::pi / 2, met_at = gap / way;
  ThrownBall ball(way, Vec3(-gap - 0.1 - 0.5, 0, 0), Box{Vec3(1, 4, 4)}, infinity, Vec3::Constant(infinity));
  ball.scene.initial.spin.col(1) = Vec3(turn / h, 0, 0);
  auto& contact = std::get<Contact>(ball.scene.effects[0]);
  contact.law[0].friction = 0.5;
  contact.collider[1].surface_velocity = Vec3(0, 1, 0);
  const auto [end, contacts] = ball.end();
  const double angle = std::atan2(end.v(2, 0), end.v(1, 0));
  CHECK(end.v.col(0).tail<2>().norm() > 0.1);
  CHECK(angle == Approx(met_at * turn).epsilon(1e-3));
}

TEST_CASE("what features far beside each other say is looked at again from nearer") {
  // 0.3 m apart; of a feature beside them a reach of 1 m tells -0.1 m.
  const auto beside = [](double reach) { return reach < 0.3 ? infinity : reach < 1 ? 0.3 : -0.1; };
  CHECK(gap_by_reach(beside, 10, 1e-3) == 0.3);
  const auto touching = [](double) { return -1e-3; };
  CHECK(gap_by_reach(touching, 10, 1e-3) == -1e-3);
  // Where nothing nearer tells, they are at least as far apart as was looked.
  const auto far = [](double reach) { return reach < 4 ? infinity : -0.1; };
  const double told = gap_by_reach(far, 10, 1e-3);
  CHECK(told > 0.9);
  CHECK(told < 4);
}

TEST_CASE("a common speed makes nothing of what lies on each other, where contact is continuous") {
  const auto tipped = [](double speed) {
    Scene scene;
    add_body(scene, Vec3(0, 0, -0.1), infinity, Vec3::Constant(infinity), Eigen::Quaterniond::Identity(),
             Vec3(0, speed, 0));
    add_body(scene, Vec3(0.52, 0, 0.1), 1, Vec3::Constant(0.01), Eigen::Quaterniond::Identity(),
             Vec3(0, speed, 0));
    Contact contact;
    contact.continuous = true;
    contact.law[0].friction = 0.5;
    contact.collider = {{Box{Vec3(1, 1, 0.2)}, 0}, {Box{Vec3::Constant(0.2)}, 1}};
    scene.effects = {Gravity{}, contact};
    Workspace workspace(scene, Method{});
    State state = scene.initial;
    for (int k = 0; k < 20; ++k) REQUIRE(step(workspace, ThrownBall::h, state).status == Status::ok);
    return state;
  };
  const State resting = tipped(0), flying = tipped(100);
  const Vec3 way(0, 100 * 20 * ThrownBall::h, 0);
  CHECK((flying.x.col(1) - way - resting.x.col(1)).norm() < 1e-7);
  CHECK(resting.orientation[1].angularDistance(flying.orientation[1]) < 1e-6);
}

TEST_CASE("what begins on a face does not cut across its edge where contact is continuous") {
  // By less than half the box's width, so that what touches tells of it, but the face ends on the way.
  constexpr double side = 0.2;
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  const Vec3 begin(side / 2 - 0.035, 0, side / 2), way(0.04, 0, -0.03);
  const int node = add_node(scene, begin, 1, way / ThrownBall::h);
  Contact contact;
  contact.continuous = GENERATE(true, false);
  contact.law[0].friction = 0;
  contact.collider.push_back({Box{Vec3::Constant(side)}, 0});
  contact.node = {node};
  contact.radius = {0};
  contact.node_material = {0};
  scene.effects.emplace_back(contact);
  Workspace workspace(scene, Method{});
  State state = scene.initial;
  REQUIRE(step(workspace, ThrownBall::h, state).status == Status::ok);
  const Vec3 end = contact.continuous ? Vec3(way.x(), 0, 0) : way;
  CHECK((state.x.col(node) - begin - end).norm() < 1e-8);
}
