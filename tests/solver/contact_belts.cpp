// Surfaces that move along themselves: what lies on them is dragged by friction, by formulas.
#include "contact_runs.h"
#include "linear/linear_names.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

/// A belt whose upper face is at z = 0, `turned` about z, and moves along its own x at `speed` (m/s).
BodyScene belt(double friction, double speed, double turned = 0, double restitution = 0) {
  BodyScene build({.friction = friction, .restitution = restitution});
  build.fixed(Box{{20, 2, 0.2}},
              {Vec3(0, 0, -0.1), Eigen::Quaterniond(Eigen::AngleAxisd(turned, Vec3::UnitZ()))});
  build.contact().collider[0].surface_velocity = {speed, 0, 0};
  return build;
}

constexpr double mu = 0.25;
constexpr int steps = 40;

}  // namespace

// Of implicit Euler v_k = k mu g h up to the belt's speed v after N = v/(mu g h) steps, so that the box slips
// sum (v - v_k) h = v^2/(2 mu g) - v h/2.
TEST_CASE("a belt brings a box to its speed in v/(mu g), and the box slips v^2/(2 mu g)") {
  constexpr double speed = 1, h = speed / (mu * gravity) / steps, turned = 0.7;
  const Vec3 along(std::cos(turned), std::sin(turned), 0);
  BodyScene build = belt(mu, speed, turned);
  build.box(Vec3(0.2, 0.2, 0.1), 4, {Vec3(0, 0, 0.05)});
  const Scene scene = build.finish();
  for (const auto relaxation : {"direct", "gauss_seidel", "conjugate_gradients"})
    for (const std::string_view law : {"coulomb", "disc"}) {
      INFO(relaxation << " " << law);
      Method method = contact_method(relaxation, law);
      method.max_sweeps = 20000;
      Workspace workspace(scene, method);
      State state = scene.initial;
      for (int k = 1; k <= steps + 5; ++k) {
        REQUIRE(step(workspace, h, state).status == Status::ok);
        const Vec3 expected = std::min(k * mu * gravity * h, speed) * along;
        CHECK((state.v.col(1) - expected).norm() <= 1e-9);
        if (k == 10) CHECK(std::abs(ground_force(workspace).dot(along) / (mu * weight(scene)) - 1) <= 1e-9);
      }
      const double slipped = state.time * speed - along.dot(state.x.col(1));
      CHECK(std::abs(slipped - (speed * speed / (2 * mu * gravity) - speed * h / 2)) <= 1e-9);
    }
}

TEST_CASE("slips of contacts on a belt are against its surface") {
  BodyScene build = belt(mu, 1);
  build.box(Vec3(0.2, 0.2, 0.1), 4, {Vec3(0, 0, 0.05), Eigen::Quaterniond::Identity(), Vec3(0, 2, 0)});
  const Scene scene = build.finish();
  Workspace workspace(scene, contact_method("direct"));
  const State end = run(scene, contact_method("direct"), 0.001, 1, workspace);
  REQUIRE(workspace.contacts().size() == 4);
  for (const ContactForce& contact : workspace.contacts()) {
    const Vec3 slip = contact.collider[0] == 1 ? contact.slip : Vec3(-contact.slip);
    CHECK((slip - Vec3(end.v.col(1)) + Vec3(1, 0, 0)).norm() <= 1e-6);  // it turns by rounding
  }
}

// m v = P, 2/5 m r^2 w = r P: the lowest point is at the belt's speed where v + 5 v/2 = V.
TEST_CASE("a ball on a belt rolls at 2/7 of its speed") {
  BodyScene build = belt(mu, 1);
  build.ball(0.1, 1, {Vec3(0, 0, 0.1)});
  const State end = run(build.finish(), contact_method("direct"), 0.001, 300);
  CHECK(std::abs(end.v(0, 1) - 2.0 / 7) <= 1e-10);
  CHECK(std::abs(end.spin(1, 1) + 5.0 / 0.7) <= 1e-9);
}

TEST_CASE("a belt does not push along its normals, and does nothing without friction") {
  for (const double restitution : {0.0, 0.5}) {
    BodyScene still = belt(0, 0, 0, restitution), moving = belt(0, 3, 0, restitution);
    moving.contact().collider[0].surface_velocity.z() = 5;
    for (BodyScene* build : {&still, &moving}) build->box(Vec3(0.2, 0.2, 0.1), 4, {Vec3(0, 0, 0.1)});
    const Method method = contact_method("direct");
    const State one = run(still.finish(), method, 0.01, 60), two = run(moving.finish(), method, 0.01, 60);
    CHECK(one.x == two.x);
    CHECK(one.v == two.v);
  }
  BodyScene rough = belt(mu, 0);
  rough.contact().collider[0].surface_velocity.z() = 5;
  rough.box(Vec3(0.2, 0.2, 0.1), 4, {Vec3(0, 0, 0.05)});
  const State end = run(rough.finish(), contact_method("direct"), 0.01, 30);
  CHECK(end.v.cwiseAbs().maxCoeff() <= 1e-10);
}
