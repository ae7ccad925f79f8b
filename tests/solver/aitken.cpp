#include <catch2/catch.hpp>

#include "scenes.h"

using namespace pbd;
using namespace pbd::test;

// A mass on one link has one motion that plain multiplies by -kappa, kappa the free motion's excess over the
// link. The right share of each change, 1/(1 + kappa), is what two changes tell, and what is then left is of
// second order: the digits double from the third iteration on.
TEST_CASE("aitken gives each body its own share where plain walks away from the solution") {
  constexpr double h = 0.1;
  const std::vector<double> speeds{25, 45};  // of masses on links of 1 m: kappa 1.7 and 3.6
  Scene scene;
  Distance links;
  for (const double speed : speeds) {
    const int held = scene.nodes();
    add_node(scene, Vec3::Zero(), infinity);
    add_node(scene, Vec3(1, 0, 0), 1, Vec3(0, speed, 0));
    links.node.push_back({held, held + 1});
    links.rest_length.push_back(1);
    links.compliance.push_back(0);
  }
  scene.effects = {Gravity{}, links};
  Method method = direct_method(1e-10);
  method.outer = "plain";
  State state = scene.initial;
  CHECK(one_step(scene, method, h, state).status == Status::not_converged);
  method.outer = "aitken";
  state = scene.initial;
  const Report report = one_step(scene, method, h, state);
  CHECK(report.status == Status::ok);
  CHECK(report.outer_iterations <= 15);
  // The free motions' ends, projected on to the circle.
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const Vec3 free(1, h * speeds[i], -gravity * h * h);
    CHECK((state.x.col(static_cast<Eigen::Index>(2 * i + 1)) - free.normalized()).norm() <= 1e-9);
  }
}
