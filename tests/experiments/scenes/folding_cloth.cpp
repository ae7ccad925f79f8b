// Cloth that folds under contact: what is pressed is not convex, and no line search guards iterations.
#include <catch2/catch.hpp>

#include "read_scene.h"
#include "step/step.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

TEST_CASE("a cloth that falls on its edge and folds is solved at every step by quasi_newton") {
  const SceneFile file = read(R"([[cloth]]
cells = [12, 12]
size_m = [1, 1]
area_density_kg_m2 = 0.2
rotation_rad = [1.57, 0.001, 0.002]
translation_m = [0, 0, 0.004]
velocity_m_s = [0, 0, -3]
links = { stiffness_n_per_m = 20000 }
contact = { surface = true }
[[rigid_body]]
name = "ground"
shape = "half_space"
[gravity]
[contact]
friction = 0.3
surfaces_touch = false
thickness_m = 0.005
[method]
tolerance = 1e-4
outer = "quasi_newton"
)");
  pbd::Workspace workspace(file.scene, file.method);
  pbd::State state = file.scene.initial;
  for (int k = 0; k < 30; ++k) {
    INFO("step " << k);
    CHECK(step(workspace, 0.02, state).status == pbd::Status::ok);
  }
}
