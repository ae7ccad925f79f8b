// Scenes of `coupling` of which single steps were hard.
#include "studies/contact/coupling_scenes.h"

#include <catch2/catch.hpp>

#include "studies/contact/contact_answers.h"

using namespace pbdcheck;

TEST_CASE("two soft cubes strike each other face on face, and no step misses or loses momentum") {
  // Their nodes and edges touch in more places than they can answer, and in places that contradict each other
  // by rounding: impulses must change for long before one of them ends.
  constexpr double h = 0.002;  // s
  constexpr int steps = 13;    // until all of the faces' edges have met
  const pbd::Scene scene = cubes_meet();
  pbd::Method method = contact_method("direct");
  method.tolerance = 1e-10;
  const auto momentum = [&](const pbd::State& state) {
    pbd::Vec3 sum = pbd::Vec3::Zero();
    for (int node = 0; node < scene.nodes(); ++node)
      sum += scene.mass[static_cast<std::size_t>(node)] * state.v.col(node);
    return sum;
  };
  const ContactRun run = simulate_contacts(scene, method, h, steps);
  CHECK(run.steps_ok == steps);
  CHECK((momentum(run.end) - momentum(scene.initial)).norm() < 1e-10 * cube_mass * impact_speed);
}
