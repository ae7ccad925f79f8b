// Steps with contact by the judges of contact problems: which they take, and which they refuse.
#include "cones/contact_judge.h"

#include <catch2/catch.hpp>

#include "harness/measure.h"
#include "scenes/contacts.h"
#include "step/step.h"

using namespace pbdcheck;

TEST_CASE("judged steps do not collide: restitution is refused by its place") {
  const auto falling = [](double restitution) {
    BodyScene build({.friction = 0.5});
    build.materials(2, {.friction = 0.5});
    build.law(0, 1, {.friction = 0.5, .restitution = restitution});
    build.ground();
    build.ball(0.1, 1, {.position = {0, 0, 0.1}, .velocity = {0, 0, -1}}, 1);
    return build.finish();
  };
  const auto& judge = cone_solvers().front();
  const auto judged = [&](const pbd::Scene& scene) {
    return judge_contacts(judge, scene, scene.initial, 0.01, pbd::reference::FrictionLaw::coulomb);
  };
  CHECK(judged(falling(0)).status == "ok");
  CHECK_THROWS_WITH(judged(falling(0.25)),
                    "contact restitution[1]: got 0.25; allowed: 0 in a step that is judged");
}

// Its cubes stay corner on corner within the step: corners are beside the faces by what is second order.
TEST_CASE("a column that is struck keeps the corners that it stands on, by the judge and the solver alike") {
  constexpr double h = 0.01;
  constexpr int cubes = 5;
  const auto law = GENERATE(pbd::reference::FrictionLaw::cone, pbd::reference::FrictionLaw::coulomb);
  pbd::Scene scene = column(cubes);
  scene.initial.v.col(cubes) = pbd::Vec3(0.5, 0.3, 0);
  std::erase_if(scene.effects,
                [](const pbd::Effect& effect) { return std::holds_alternative<pbd::Gyroscopic>(effect); });
  const auto judged = judge_contacts(cone_solvers().front(), scene, scene.initial, h, law);
  REQUIRE(judged.reason.empty());

  pbd::Method method;
  method.friction = pbd::reference::friction_law_names[static_cast<std::size_t>(law)];
  method.relaxation = "direct";
  method.tolerance = 1e-10;
  pbd::Workspace workspace(scene, method);
  pbd::State state = scene.initial;
  REQUIRE(step(workspace, h, state).status == pbd::Status::ok);
  const auto places_of = [&](const pbd::State& at) { return places(scene, at.x, at.orientation); };
  CHECK(relative_error(places_of(state), places_of(judged.end), places_of(scene.initial)) < 1e-8);
}
