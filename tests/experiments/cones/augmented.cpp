// The augmented Lagrangian on rows of steps where contacts stick, slide and open, and joints hold. A round of
// its proximal iteration leaves an error of sigma/(sigma + lambda), lambda from N's spectrum: it converges
// linearly. What is asked of it is what Newton's method asks: a tolerance before its patience ends.
#include "linear/augmented_lagrangian.h"

#include <catch2/catch.hpp>

#include "harness/rows_of_step.h"
#include "linear/natural_residual.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbdcheck;

namespace {

/// What Newton's method waits for a gain at most.
constexpr int patience = 10;

/// True if the natural residual falls to that share in so many calls.
bool converges(Rows& rows, Points& v, double share, int calls) {
  const double target = share * natural_residual(rows, v);
  AugmentedLagrangian augmented;
  for (int k = 0; k < calls && natural_residual(rows, v) > target; ++k) CHECK(augmented.improve(rows, v) > 0);
  return natural_residual(rows, v) <= target;
}

}  // namespace

TEST_CASE("the augmented Lagrangian solves the convex law's rows, from any impulses") {
  const LinearStep step = linear_step(pile(), pile().initial, 0.01, Friction::cone);
  REQUIRE(AugmentedLagrangian::applies(step.rows));
  for (const double start : {0.0, 0.3}) {
    Rows rows = step.rows;
    for_each_block(rows.blocks, [&](auto& block) {
      for (auto& impulse : block.impulse) impulse.setConstant(start);
    });
    Points v = step.v_free;
    apply_impulses(rows, v);
    CHECK(converges(rows, v, 1e-9, 3));
    Points rebuilt = step.v_free;
    apply_impulses(rows, rebuilt);
    CHECK((rebuilt - v).norm() < 1e-12 * v.norm());
  }
}

TEST_CASE("the augmented Lagrangian solves joints, soft contacts and contacts without friction") {
  BodyScene build({});
  build.materials(3, {.friction = 0.5});
  build.law(0, 1, {.friction = 0});
  build.law(0, 2, {.friction = 0.5, .compliance = 1e-6});
  build.ground();
  PointJoint joints;
  int last = -1;
  for (int k = 0; k < 3; ++k) {
    const int body = build.box(Vec3(0.2, 0.2, 0.1), 1 + 10 * k,
                               {.position = {0.25 * k, 0, 0.05}, .velocity = {1, 0.2 * k, -1}}, k);
    if (k > 0) {
      joints.body.push_back({last, body});
      joints.point.push_back({Vec3(0.125, 0, 0), Vec3(-0.125, 0, 0)});
      joints.compliance.push_back(k == 1 ? 0 : 1e-3);
    }
    last = body;
  }
  Scene scene = build.finish();
  scene.effects.emplace_back(std::move(joints));
  const LinearStep step = linear_step(scene, scene.initial, 0.01, Friction::coulomb);
  Rows rows = step.rows;
  int limited = 0, rough = 0, free = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i)
      ++(block.frictional() ? rough : block.bounded() ? limited : free);
  });
  REQUIRE(limited >= 4);
  REQUIRE(rough >= 8);
  REQUIRE(free == 2);
  Points v = step.v_free;
  CHECK(converges(rows, v, 1e-8, patience));
}

TEST_CASE("its fixed point of the slips is Coulomb's law, which another friction does not obey") {
  const LinearStep step = linear_step(pile(), pile().initial, 0.01, Friction::coulomb);
  Rows rows = step.rows;
  Points v = step.v_free;
  const double first = natural_residual(rows, v);
  CHECK(converges(rows, v, 1e-8, patience));
  for_each_block(rows.blocks, []<class Block>(Block& block) { block.law = Friction::cone; });
  CHECK(natural_residual(rows, v) > 1e-4 * first);
}

TEST_CASE("the augmented Lagrangian leaves the law box to others") {
  CHECK_FALSE(AugmentedLagrangian::applies(linear_step(pile(), pile().initial, 0.01, Friction::box).rows));
}
