// What collides with restitution: one answer of every solver, and nothing sinks.
#include "body_scenes.h"
#include "contact_runs.h"
#include "linear/linear_names.h"
#include "mesh.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;

TEST_CASE("restitution gives every solver, outer iteration and start the same motion") {
  BodyScene build({.friction = 0, .restitution = 0.8});
  build.ground();
  const auto cube = [&](const Vec3& x, double mass, const Eigen::Quaterniond& turned, double speed) {
    build.box(Vec3::Ones(), mass, {x, turned, Vec3(0, 0, -speed)});
  };
  cube({0, 0, 0.51}, 1, Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Vec3(1, 0.4, 0).normalized())), 3);
  cube({0.2, 0.1, 1.53}, 1, Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Vec3(-0.3, 1, 0).normalized())), 3);
  cube({-0.1, 0.1, 2.55}, 2, Eigen::Quaterniond::Identity(), 3.5);
  const Scene scene = build.finish();
  build.contact().law[0].restitution = 0;
  const Scene dull = build.finish();
  for (const double h : {0.01, 0.002}) {
    Points expected;
    for (const auto relaxation : general_solver_names())
      for (const std::string outer : {"auto", "plain", "proximal"})
        for (const bool warm : {true, false}) {
          INFO(relaxation << " " << outer << " h " << h << (warm ? " warm" : " cold"));
          Method method;
          method.relaxation = relaxation;
          method.outer = outer;
          method.tolerance = 1e-10;
          method.max_sweeps = 20000;
          method.max_outer =
              200;  // a step of these is solved anew for what collides and what leaves its features
          method.warm_start = warm;
          const State end = run(scene, method, h, static_cast<int>(std::lround(0.04 / h)));
          if (expected.size() == 0) expected = end.v;
          // No bound, but ten thousand times the tolerance, where restitution makes more than 0.5 m/s.
          CHECK((end.v - expected).cwiseAbs().maxCoeff() <= 1e-6);
        }
    const Method method = contact_method("direct");
    const State end = run(dull, method, h, static_cast<int>(std::lround(0.04 / h)));
    CHECK((end.v - expected).row(2).minCoeff() < -0.5);  // m/s: it did return
  }
}

TEST_CASE("what is stopped within a step returns its speed, though its free motion met nothing") {
  // The lower ball stops on the ground, and the upper one, whose free motion would stay clear of it, meets
  // it.
  for (const auto relaxation : general_solver_names()) {
    INFO(relaxation);
    BodyScene build({.friction = 0, .restitution = 0}, 0);
    build.materials(2, {.friction = 0, .restitution = 0});
    build.law(0, 1, {.friction = 0, .restitution = 0.5});
    build.ground();
    build.ball(0.1, 1, {Vec3(0, 0, 0.1 + 1e-3), Eigen::Quaterniond::Identity(), Vec3(0, 0, -1)});
    build.ball(0.1, 1, {Vec3(0, 0, 0.3 + 5e-3), Eigen::Quaterniond::Identity(), Vec3(0, 0, -1.2)}, 1);
    const Scene scene = build.finish();
    const State end = run(scene, contact_method(relaxation), 0.01, 1);
    // They approach each other at 0.2 m/s and part at half of it; the lower one cannot go down.
    CHECK(end.v(2, 2) - end.v(2, 1) == Approx(0.1).epsilon(1e-6));
  }
}

// A corner about which a box turns at w is carried off by w^2 r h^2/2 a step, r its distance from the centre:
// 2e-6 m here, at which it approaches the ground anew in each step.
TEST_CASE("a box that bounces, rocks and falls over does not sink") {
  const Vec3 size(0.2, 0.2, 0.4);
  BodyScene build({.friction = 0.5, .restitution = 0.3});
  build.ground();
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(0.05, Vec3::UnitX()));
  build.box(size, 1, {Vec3(0, 0, 0.3), tilted});
  const Scene scene = build.finish();
  const Points corners = box_surface(size).x;
  for (const auto integrator : {"implicit_euler", "symplectic_euler"}) {
    INFO(integrator);
    Method method = contact_method("direct");
    method.integrator = integrator;
    Workspace workspace(scene, method);
    State state = scene.initial;
    int solved = 0;
    double deepest = 0;
    for (int k = 0; k < 1000; ++k) {
      if (step(workspace, 0.001, state).status != Status::ok) continue;
      ++solved;
      for (Eigen::Index i = 0; i < corners.cols(); ++i)
        deepest = std::max(deepest, -(state.x.col(1) + state.orientation[1] * Vec3(corners.col(i))).z());
    }
    CHECK(solved >= 990);
    CHECK(deepest <= 1e-6 * size.minCoeff() / 2);  // as contact_search.h states
  }
}
