// What the judge of steps knows of explicit forces.
#include <catch2/catch.hpp>
#include <cmath>

#include "body_scenes.h"
#include "claimed_step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// A stretched link of limited force pulls by explicit forces.
Step limited_link(std::vector<ForceBounds> bounds) {
  Step step(linked_body(1.5, 1, 0.01, std::move(bounds)));
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
