// What a shape's edges end: nothing is held or thrown back where a face is no more.
#include "contact_runs.h"
#include "mesh.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbd::test;
using pbdcheck::BodyScene;

namespace {

constexpr double half = 0.5, own_half = 0.2, h = 0.01;  // m, of the fixed box and of the other one; s
const Vec3 under_at(0, 0, -half);                       // its top is at z = 0

/// A fixed box, and one of 1 kg above it.
Scene over_box(const ContactLaw& law, const Vec3& at, const Vec3& velocity, bool mesh = false) {
  BodyScene build(law);
  build.fixed(Box{Vec3::Constant(2 * half)}, {.position = under_at});
  build.box(Vec3::Constant(2 * own_half), 1, {.position = at, .velocity = velocity});
  if (mesh) build.contact().collider.back().shape = ClosedMesh(box_surface(Vec3::Constant(2 * own_half)));
  return build.finish();
}

}  // namespace

TEST_CASE("what falls past a box, 6 mm beside it, falls freely") {
  const double restitution = GENERATE(0.0, 0.5), tolerance = GENERATE(1e-4, 1e-12);
  const bool mesh = GENERATE(false, true);
  const Vec3 at(half + own_half + 6e-3, 0.05, 0.35), velocity(0, 0, -6);
  const Scene scene = over_box({.friction = 0.3, .restitution = restitution}, at, velocity, mesh);
  Method method = contact_method("direct");
  method.tolerance = tolerance;
  constexpr int steps = 8;
  const State end = run(scene, method, h, steps);
  const double fallen = steps * h * 6 + pbdcheck::gravity * h * h * steps * (steps + 1) / 2;
  INFO("restitution " << restitution << " tolerance " << tolerance << " mesh " << mesh);
  CHECK((end.x.col(1) - (at - fallen * Vec3::UnitZ())).norm() <= 1e-12);
  CHECK(end.spin.col(1).norm() <= 1e-12);
}

TEST_CASE("what slides over an edge is carried where both are") {
  const Scene scene = over_box({.friction = 0.2}, Vec3(half - own_half / 4, 0.05, own_half), Vec3(3, 0, 0));
  Workspace workspace(scene, contact_method("direct"));
  State state = scene.initial;
  constexpr double beside = 1e-8;  // m: more than the share of the radius that contact_search.h tells
  double carried = 0;
  for (int k = 0; k < 12; ++k) {
    REQUIRE(step(workspace, h, state).status == Status::ok);
    for (const ContactForce& each : workspace.contacts()) {
      if (!(each.force.norm() > 1e-6)) continue;
      carried += each.force.z();
      const Vec3 on_top = each.point - under_at,
                 on_own = state.orientation[1].conjugate() * Vec3(each.point - state.x.col(1));
      INFO("step " << k << " at " << each.point.transpose());
      CHECK(on_top.cwiseAbs().maxCoeff() <= half + beside);
      CHECK(on_own.cwiseAbs().maxCoeff() <= own_half + beside);
    }
  }
  CHECK(std::abs(carried) > 0.5 * 9.81);  // N in sum: it was carried before it tipped
}

// Its leading edge comes over the top within the step and would end 0.5 mm below it; its centre is beside the
// fixed box, about whose edge it tips.
TEST_CASE("what comes over an edge within a step lies on it at its end") {
  const Vec3 at(half + own_half + 0.02, 0.05, own_half + 0.06);
  const Scene scene = over_box({.friction = 0}, at, Vec3(-4, 0, -6));
  const State end = run(scene, contact_method("direct"), h, 1);
  const Vec3 edge = end.orientation[1].conjugate() * Vec3(Vec3(half, 0.05, 0) - end.x.col(1));
  CHECK(std::abs(edge.z() + own_half) <= 1e-9);
  CHECK(end.spin(1, 1) > 0);  // the far side goes down
}

TEST_CASE("what comes down to a face bounces, and where the face has ended flies on") {
  // 1 mm above it and 10 mm from its edge: it is down after 1 ms, or after 8 ms, 16 mm on. There it clears
  // the edge, whose distance from its centre is never below (0.1^2 + 0.006^2)^(1/2) m - 0.125 m/s * 2 ms >
  // 0.1 m.
  const double fast = GENERATE(1.0, 0.125);
  const Vec3 velocity(2, 0, -fast);
  BodyScene build({.friction = 0, .restitution = 1}, 0);
  build.fixed(Box{Vec3::Constant(2 * half)}, {.position = under_at});
  build.ball(0.1, 1, {.position = {half - 0.01, 0, 0.1 + 1e-3}, .velocity = velocity});
  const State end = run(build.finish(), contact_method("direct"), h, 1);
  const Vec3 expected = fast == 1 ? Vec3(2, 0, fast) : velocity;
  CHECK((end.v.col(1) - expected).norm() <= 1e-9);
}

TEST_CASE("a fold that rises beside its edge holds what crosses it once it falls there") {
  // Two triangles with a fold along y between them, lower by 0.1 um than their outer corners, which go 1 um
  // down; a rod across it goes with them, and may not go below it.
  constexpr double thickness = 2e-3, half = 0.01, h = 0.01, speed = 1e-4, rise = 1e-7, heavy = 1e6;
  BodyScene build({.friction = 0}, 0);
  build.box({0.3, 2 * half, 2 * half}, 1,
            {.position = {0, 0, half + thickness / 2 + rise}, .velocity = {0, 0, -speed}});
  Scene scene = build.finish();
  auto& contact = std::get<Contact>(scene.effects.back());
  contact.thickness = thickness;
  std::vector<int> node;
  for (const Vec3& x : {Vec3(0, -0.5, 0), Vec3(0, 0.5, 0), Vec3(0.5, 0, rise), Vec3(-0.5, 0, rise)})
    node.push_back(add_node(scene, x, heavy, Vec3(0, 0, x.x() == 0 ? 0 : -speed)));
  contact.triangle = {{node[0], node[2], node[1]}, {node[0], node[1], node[3]}};
  const State end = run(scene, contact_method("direct"), h, 1);
  const double lowest = end.x(2, node[0]) + thickness / 2 + half;
  CHECK(std::abs(end.x(2, 0) - lowest) <= 1e-9);
}
