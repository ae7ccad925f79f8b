// What the judge of steps knows of explicit forces.
#include <catch2/catch.hpp>
#include <cmath>

#include "claimed_step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// A body of 1 kg that a stretched link of limited force pulls towards a fixed one, by explicit forces.
Step limited_link(std::vector<ForceBounds> bounds) {
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3(1.5, 0, 0), 1, Vec3::Ones());
  scene.effects.emplace_back(BodyDistance{.body = {{0, 1}},
                                          .point = {{Vec3::Zero(), Vec3::Zero()}},
                                          .rest_length = {1},
                                          .compliance = {0.01},
                                          .bounds = std::move(bounds)});
  Step step(scene);
  step.integrator = "symplectic_euler";
  step.end.v.col(1).x() = -step.h * 10;  // of 50 N at most 10
  step.move();
  step.forces[0] = {std::nan("")};
  return step;
}

}  // namespace

TEST_CASE("a hinge folded onto itself turns either way") {
  for (const double lifted : {0.0, 0.1}) {
    Scene scene;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 1, 0), Vec3(0.6, 0.8, lifted)})
      add_node(scene, x, 1);
    scene.effects.emplace_back(Bending{.node = {{0, 1, 2, 3}}, .rest_angle = {0}, .compliance = {1}});
    Step step(scene);
    step.integrator = "symplectic_euler";
    step.forces[0] = {std::nan("")};
    step.move();
    CHECK(refuted(step) == (lifted > 0 ? Names{"momentum"} : Names{}));  // it is claimed to stay at rest
    CHECK(step.judge().left_out.contains("momentum: what an angle at its jump acts on") == (lifted == 0));
  }
}

TEST_CASE("explicit forces stay within their limits") {
  CHECK(refuted(limited_link({{-10, 10}})).empty());
  CHECK(refuted(limited_link({{-20, 20}})) == Names{"momentum"});
  CHECK(refuted(limited_link({})) == Names{"momentum"});
}
