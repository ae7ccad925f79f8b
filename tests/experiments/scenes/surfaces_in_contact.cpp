// Surfaces in contact, whose iterations have no line search: of cloth that folds, sheets that meet in
// flight and a block that is pressed flat.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "harness/probes.h"
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

TEST_CASE("sheets that meet in flight are solved as at rest, whatever their common speed") {
  constexpr int steps = 12;
  const auto flown = [](const pbd::Vec3& common) {
    const auto sheet = [&](int cells, double size, const pbd::Vec3& place, double speed) {
      return fmt::format(R"([[cloth]]
cells = [{0}, {0}]
size_m = [{1}, {1}]
area_density_kg_m2 = 0.2
links = {{ stiffness_n_per_m = 1000 }}
contact = {{ surface = true }}
translation_m = [{2}, {3}, {4}]
velocity_m_s = [{5}, {6}, {7}]
)",
                         cells, size, place[0], place[1], place[2], common[0], common[1], common[2] + speed);
    };
    const SceneFile file = read(sheet(6, 0.4, {0, 0, 0}, 0) + sheet(4, 0.25, {0.06, 0.09, 0.03}, -1.5) +
                                "[contact]\nthickness_m = 0.005\n[method]\ntolerance = 1e-6\n");
    pbd::Workspace workspace(file.scene, file.method);
    pbd::State state = file.scene.initial;
    int iterations = 0;
    for (int k = 0; k < steps; ++k) {
      const pbd::Report report = step(workspace, 0.005, state);
      INFO("step " << k);
      CHECK(report.status == pbd::Status::ok);
      iterations += static_cast<int>(report.outer_iterations);
    }
    state.x.colwise() -= state.time * common;
    return std::pair{iterations, state.x};
  };
  const auto [iterations, x] = flown(pbd::Vec3::Zero());
  CHECK(iterations > 2 * steps);  // they meet
  const auto [boosted, boosted_x] = flown({30, -20, 50});
  CHECK(std::abs(boosted - iterations) <= steps);  // where rounding decides whether a step has arrived
  CHECK((boosted_x - x).cwiseAbs().maxCoeff() < 1e-6 * 0.4);  // of their size, as the tolerance
}

// They fold and come over each other's borders from beside: what is asked of that must not take energy.
TEST_CASE("soft blocks that are thrown at each other gain no energy") {
  const SceneFile file = read(R"([[solid]]
cells = [3, 3, 3]
size_m = [0.2, 0.2, 0.2]
translation_m = [-0.1, -0.1, -0.1]
velocity_m_s = [9.428416, 0, 0]
rotation_rad = [0.1942, 0.0921, -0.2039]
density_kg_m3 = 1000
young_pa = 9172
poisson = 0.3
contact = { surface = true }
[[solid]]
cells = [3, 3, 3]
size_m = [0.2, 0.2, 0.2]
translation_m = [0.25, -0.0275, -0.0206]
rotation_rad = [0.0207, -0.1722, -0.25]
velocity_m_s = [-4.288891, 0, 0]
density_kg_m3 = 1000
young_pa = 4623
poisson = 0.3
contact = { surface = true }
[contact]
friction = 0.8
thickness_m = 0.0071
[method]
tolerance = 1e-4
)");
  pbd::Workspace workspace(file.scene, file.method);
  pbd::State state = file.scene.initial;
  const double start = total_energy(file.scene, state);
  double energy = start;
  for (int k = 0; k < 20; ++k) {
    const pbd::Report report = step(workspace, 1e-3, state);
    const double after = total_energy(file.scene, state);
    INFO("step " << k << " " << report.reason);
    CHECK(after <= energy + file.method.tolerance * start);
    energy = after;
  }
}

TEST_CASE("a soft block that is pressed flat on the ground is solved at every step") {
  const auto [young, speed] = GENERATE(std::pair{3e4, 5.0}, std::pair{2e4, 9.0});
  const SceneFile file = read(fmt::format(R"([[solid]]
cells = [4, 2, 2]
size_m = [0.6, 0.2, 0.4]
translation_m = [0, 0, 0.01]
rotation_rad = [0.3, 0.2, 0]
density_kg_m3 = 1000
young_pa = {}
poisson = 0.3
velocity_m_s = [0, 0, {}]
contact = {{ surface = true }}
[[rigid_body]]
name = "ground"
shape = "half_space"
position_m = [0, 0, -0.25]
[gravity]
[contact]
friction = 0.5
[method]
tolerance = 1e-3
)",
                                          young, -speed));
  pbd::Workspace workspace(file.scene, file.method);
  pbd::State state = file.scene.initial;
  for (int k = 0; k < 12; ++k) {
    INFO("young_pa " << young << " step " << k);
    CHECK(step(workspace, 1.0 / 60, state).status == pbd::Status::ok);
  }
}
