// Steps with a closed form, and what the judges refuse.
#include "judge.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "judged_scenes.h"
#include "nonlinear.h"
#include "primal_newton.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

TEST_CASE("free particles move by gravity and external forces") {
  Scene scene;
  add_node(scene, Vec3(1, 2, 3), 2, Vec3(0.5, 0, 1));
  add_node(scene, Vec3(0, 0, 0), infinity, Vec3(1, 0, 0));
  scene.effects = {Gravity{}, ExternalForce{{0, 0}, {Vec3(4, 0, 0), Vec3(0, 2, 0)}}};
  const double h = 0.1;
  for (const NamedJudge& named : judges()) {
    INFO(named.name);
    const Judgement j = named.judge(scene, scene.initial, h);
    CHECK(j.outcome == Outcome::ok);
    const Vec3 velocity = Vec3(0.5, 0, 1) + h * Vec3(2, 1, -9.81);
    CHECK((j.v.col(0) - velocity).norm() <= 1e-11);
    CHECK((j.x.col(0) - Vec3(1, 2, 3) - h * velocity).norm() <= 1e-12);
    CHECK((j.x.col(1) - Vec3(h, 0, 0)).norm() <= 1e-15);
    CHECK((j.v.col(1) - Vec3(1, 0, 0)).norm() == 0);
  }
}

TEST_CASE("one implicit Euler step of a pendulum projects the free step onto its circle") {
  // M (x - y)/h^2 = gamma x/l is radial, so that x = l y/|y| and gamma = m (l - |y|)/h^2, y the free step.
  const double h = 1.0 / 30, mass = 0.1;
  const Scene scene = swinging_chain(1, 1);
  const Vec3 y = scene.initial.x.col(1) + h * scene.initial.v.col(1) + h * h * Vec3(0, 0, -9.81);
  for (const NamedJudge& named : judges()) {
    INFO(named.name);
    const Judgement j = named.judge(scene, scene.initial, h);
    CHECK((j.x.col(1) - y.normalized()).norm() <= 1e-13);
    CHECK(j.multiplier(0) == Approx(mass * (1 - y.norm()) / (h * h)).epsilon(1e-10));
  }
}

TEST_CASE("one implicit Euler step of a spring pendulum and of a compliant anchor") {
  // Along y: m (r - |y|)/h^2 + (r - l)/A = 0.
  const double h = 1.0 / 30, mass = 0.1, compliance = 1e-3, inertia = mass / (h * h);
  Scene scene = swinging_chain(1, 1);
  const Vec3 y = scene.initial.x.col(1) + h * scene.initial.v.col(1) + h * h * Vec3(0, 0, -9.81);
  std::get<Distance>(scene.effects[1]).compliance[0] = compliance;
  const double r = (inertia * y.norm() + 1 / compliance) / (inertia + 1 / compliance);
  CHECK((primal_newton(scene, scene.initial, h).x.col(1) - r * y.normalized()).norm() <= 1e-13);
  const Vec3 target(0.3, 0.4, 0.5);
  scene.effects[1] = Anchor{{1}, {target}, {compliance}};
  const Vec3 held = (inertia * y + target / compliance) / (inertia + 1 / compliance);
  CHECK((primal_newton(scene, scene.initial, h).x.col(1) - held).norm() <= 1e-13);
}

TEST_CASE("an observer sees iterates that end at the result, with increasing times") {
  const Scene scene = cantilever(4, 1e5, 0.3, Strain::green);
  double last = -1;
  Points seen;
  int count = 0;
  const auto observe = [&](double seconds, const Points& x) {
    CHECK(seconds >= last);
    last = seconds, seen = x, ++count;
  };
  const Judgement j = primal_newton(scene, scene.initial, 1.0 / 60, {.observer = observe});
  CHECK(count == j.iterations);
  CHECK((seen - j.x).norm() == 0);
}

TEST_CASE("judges refuse damping, which they do not know") {
  Scene scene = cantilever(4, 1e5, 0.3, Strain::green);
  std::get<TetStrain>(scene.effects[0]).damping = Material{1e3, 0.3};
  for (const auto& judge : judges())
    CHECK_THROWS_WITH(judge.judge(scene, scene.initial, 0.01), Catch::Contains("effects[0] damping"));
}

TEST_CASE("judges are found by name") {
  CHECK(find_judge("primal_newton") == static_cast<Judge>(primal_newton));
  CHECK(find_judge("ipopt") == static_cast<Judge>(ipopt));
  CHECK_THROWS_WITH(find_judge("oracle"), Catch::Contains("primal_newton, ipopt"));
}
