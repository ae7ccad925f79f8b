// How much a step may miss: its tolerance times sqrt(m) (|v1 - v0| + h g), the scale of its momentum, and not
// ten times that.
#include <catch2/catch.hpp>

#include "claimed_step.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double loose = 1e-3;  // a tolerance far above rounding

bool refutes(const Step& step, std::string_view check) {
  for (const auto& finding : step.judge(loose).refuted)
    if (finding.check == check) return true;
  return false;
}

/// A node that falls freely, faster than it would by `missed` (m/s).
Step falling(double missed) {
  Scene scene;
  add_node(scene, Vec3(0, 0, 1), 2, Vec3(1, 0, 0));
  scene.effects.emplace_back(Gravity{});
  Step step(scene);
  step.end.v.col(0).z() -= Step::h * weight_per_kg + missed;
  step.move();
  return step;
}

}  // namespace

TEST_CASE("momentum: speed that is off by ten times its tolerance is refuted, by a tenth not") {
  const double scale = 2 * Step::h * weight_per_kg;  // |v1 - v0| + h g
  CHECK_FALSE(refutes(falling(0.1 * loose * scale), "momentum"));
  CHECK(refutes(falling(10 * loose * scale), "momentum"));
}

TEST_CASE("constraints: a link that is off by ten times its tolerance is refuted, by a tenth not") {
  const Step solved = swinging_link(0);
  const Vec3 changed = solved.end.v.col(1) - solved.scene.initial.v.col(1);
  const double length =
      Step::h * (changed.norm() + Step::h * weight_per_kg);  // m, that the scale moves it by
  CHECK_FALSE(refutes(swinging_link(0.1 * loose * length), "constraints"));
  CHECK(refutes(swinging_link(10 * loose * length), "constraints"));
}

TEST_CASE("motion: orientations follow the angular velocities") {
  Scene scene;
  add_body(scene, Vec3::Zero(), 1, Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3::Zero(), Vec3(0, 0, 2));
  Step step(scene);
  step.move();
  CHECK(refuted(step).empty());
  step.end.orientation[0] = reference::turned_by(step.end.orientation[0], Vec3(0, 0, 1e-9));
  CHECK(refuted(step) == Names{"motion"});
}
