// Steps with contact by the judges of contact problems: which they take, and which they refuse.
#include "cones/contact_judge.h"

#include <catch2/catch.hpp>

#include "scenes/contacts.h"

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
