#include "scenes/arch.h"

#include <catch2/catch.hpp>

#include "step/step.h"

using namespace pbdcheck;

TEST_CASE("an arch little above its least friction stands in every step by the default method") {
  constexpr double h = 0.01, g = 9.81;
  constexpr int stones = 25, steps = 10;
  for (const auto& [thickness, friction] : {std::pair{0.12, 0.395}, {0.15, 0.38}}) {
    CAPTURE(thickness, friction);
    pbd::Scene scene = Arch{thickness, stones}.scene();
    for (auto& effect : scene.effects)
      if (auto* contact = std::get_if<pbd::Contact>(&effect))
        for (pbd::ContactLaw& law : contact->law) law.friction = friction;
    const pbd::Method method;
    pbd::Workspace workspace(scene, method);
    pbd::State state = scene.initial;
    for (int k = 0; k < steps; ++k) CHECK(step(workspace, h, state).status == pbd::Status::ok);
    // A step's velocities err by the tolerance of the scale g h of stones about as heavy; nothing brings them
    // back, so that they add up, and so do the ways.
    const double most = stones * method.tolerance * g * h * h * steps * steps;
    CHECK((state.x - scene.initial.x).cwiseAbs().maxCoeff() <= most);
  }
}
