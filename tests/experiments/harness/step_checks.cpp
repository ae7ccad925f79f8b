// Steps of the solver are judged as they are done; a claim that is changed by one number is told.
#include "harness/step_checks.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "harness/step_judge.h"
#include "results.h"
#include "scenes/contacts.h"
#include "scenes/scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

pbd::Method method_of(const char* relaxation) {
  pbd::Method method;
  method.relaxation = relaxation;
  return method;
}

/// The largest distance over the scale of all steps of a scene from solutions of the judge; all say ok.
double worst_of(const std::string& scene) {
  const TemporaryFolder folder;
  SceneFile file = read_scene_file(folder.write("scene.toml", scene));
  pbd::Workspace workspace = file.workspace();
  pbd::State state = file.scene.initial;
  double worst = 0;
  for (std::int64_t k = 0; k < file.steps; ++k) {
    const pbd::State begun = state;
    const pbd::Report report = step(workspace, file.step_s, state);
    INFO("step " << k + 1);
    CHECK(report.status == pbd::Status::ok);
    const double nearest =
        judge_claim("cone_interior_point", claim_of(file.scene, workspace, begun, state, file.step_s, report))
            .nearest.of_scale;
    worst = std::max(worst, std::isnan(nearest) ? pbd::infinity : nearest);
  }
  return worst;
}

}  // namespace

// Two corners of a box rebound off a face; beside them a corner of what is below is nearer to another face.
TEST_CASE("what collides with a face is pushed as far off it as it ends, by the judge and the solver alike") {
  SceneFile file = read_scene_file(scenes / "boxes_at_edges.toml", {"method.tolerance=1e-8"});
  pbd::Workspace workspace = file.workspace();
  pbd::State state = file.scene.initial;
  for (int k = 0; k < 15; ++k) {
    const pbd::State begun = state;
    const pbd::Report report = step(workspace, file.step_s, state);
    INFO("step " << k + 1);
    REQUIRE(report.status == pbd::Status::ok);
    const JudgedClaim judged = judge_claim(
        "cone_interior_point", claim_of(file.scene, workspace, begun, state, file.step_s, report));
    CHECK(judged.nearest.of_scale <= 1e-6);  // as `judged_frames` asks at this tolerance
  }
}

TEST_CASE("a claim is another solution where it is next to none and leaves what a solution may") {
  const double none = std::nan(""), left = pbd::reference::allowed_residual;
  const auto solves = [](double nearest, double residual) {
    JudgedClaim judged{{}, {}, {}};
    judged.nearest.of_scale = nearest;
    judged.residual = residual;
    return judged.solves_as_it_is();
  };
  CHECK(solves(2 * next_to_solution, left));
  CHECK(solves(none, left));
  CHECK_FALSE(solves(next_to_solution, left));
  CHECK_FALSE(solves(2 * next_to_solution, 2 * left));
  CHECK_FALSE(solves(2 * next_to_solution, none));
}

TEST_CASE("no step of a scene that comes with the program is refuted") {
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    INFO(entry.path());
    const TemporaryFolder folder;
    const double duration = 5 * read_scene_file(entry.path()).step_s;
    const auto ran = run_program({"simulate", entry.path(), "--check", "--set",
                                  "step.duration_s=" + std::to_string(duration), "-o", folder.path});
    CHECK(ran.exit_code == 0);
    CHECK_THAT(ran.out, Catch::StartsWith("checked: 5 steps by ") && Catch::Contains("none refuted"));
    const auto record = record_of(folder.path);
    CHECK(record["status"] == "complete");
    CHECK(record["checks"]["steps"] == 5);
    CHECK(record["checks"]["compared"] >= 5);
    CHECK(rows_of(folder.path / "checks.csv").size() == 1);
  }
}

TEST_CASE(
    "a ball that strikes a hanging cloth ends no deeper in it than it was, and by features that are near") {
  const TemporaryFolder folder;
  const auto run = [&](const char* duration) {
    return run_program(
        {"simulate", scenes / "ball_at_cloth.toml", "--check", "--set", duration, "-o", folder.path});
  };
  CHECK(run("step.duration_s=0.205").exit_code == 0);
  CHECK_THAT(run("step.duration_s=0.225").out, Catch::Contains("none refuted"));  // after a missed step, too
}

// Step 32 is one in which lines of the folding cloth's edges pass each other beside these.
TEST_CASE("a ball that strikes a hanging cloth ends where the judge solves it, folds and all") {
  SceneFile file = read_scene_file(scenes / "ball_at_cloth.toml", {"method.tolerance=1e-10"});
  pbd::Workspace workspace = file.workspace();
  pbd::State state = file.scene.initial;
  constexpr int judged_step = 32;
  for (int k = 1; k < judged_step; ++k)
    REQUIRE(step(workspace, file.step_s, state).status == pbd::Status::ok);
  const pbd::State begun = state;
  const pbd::Report report = step(workspace, file.step_s, state);
  REQUIRE(report.status == pbd::Status::ok);
  const JudgedClaim judged =
      judge_claim("cone_interior_point", claim_of(file.scene, workspace, begun, state, file.step_s, report));
  CHECK(judged.reference.status == "ok");
  CHECK(judged.nearest.of_scale <= 1e-8);  // a hundred times the tolerance, as `judged_frames` asks
}

TEST_CASE("a soft block that is pressed into a box, and overhangs it, keeps its dampers' state") {
  CHECK(worst_of(R"([[rigid_body]]
name = "base"
shape = "box"
size_m = [1, 1, 1]
held = "fixed"
[[solid]]
cells = [3, 1, 1]
size_m = [0.4, 0.4, 0.2]
density_kg_m3 = 500
young_pa = 1e6
poisson = 0.3
rotation_rad = [-0.006, -0.044, 0]
translation_m = [0.2, 0, 0.5051]
velocity_m_s = [0.22, -1.3, 0]
angular_velocity_rad_s = [0, 0, 4.5]
contact = { surface = true }
[gravity]
[contact]
friction = 1
stiffness_n_per_m = 1e6
damping_s = 0.01
thickness_m = 0.01
[step]
step_s = 0.01
steps = 10
[method]
tolerance = 1e-9
relaxation = "direct"
)") <= 1e-7);  // a hundred times the tolerance, as `judged_frames` asks
}

// Its rim turns from a triangle's edge over the triangle, 3e-6 m deep if that is not looked at.
TEST_CASE("a cylinder that lifts a cloth by its cap ends its step where the judge's does") {
  CHECK(worst_of(R"([[rigid_body]]
name = "lift"
shape = "cylinder"
radius_m = 0.12
length_m = 0.1
held = "moving"
position_m = [0.02, 0.01, -0.0551]
velocity_m_s = [0, 0, 1]
angular_velocity_rad_s = [0, 0, 6]
[[cloth]]
cells = [6, 6]
size_m = [1, 1]
area_density_kg_m2 = 0.3
translation_m = [-0.5, -0.5, 0]
[[cloth.strain]]
young_pa = 2e4
poisson = 0.3
thickness_m = 0.001
[[cloth.bending]]
compliance_rad_per_n_m = 100
[[cloth.contact]]
surface = true
[[cloth.fixed]]
corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
[contact]
friction = 0.5
thickness_m = 0.01
[step]
step_s = 0.01
steps = 1
[method]
tolerance = 1e-9
)") <= 1e-6);
}

TEST_CASE("boxes that slide and turn on each other flush end where the judge's do") {
  CHECK(worst_of(R"([[rigid_body]]
name = "ground"
shape = "half_space"
held = "fixed"
[[rigid_body]]
name = "b0"
shape = "box"
size_m = [0.4, 0.4, 0.4]
mass_kg = 1
position_m = [0, 0, 0.2]
velocity_m_s = [0, -0.69, 0]
angular_velocity_rad_s = [0, 0, -3.5]
[[rigid_body]]
name = "b1"
shape = "box"
size_m = [0.4, 0.4, 0.4]
mass_kg = 1
position_m = [0, 0, 0.6]
rotation_rad = [0, 0, 0.3]
velocity_m_s = [1.8, 0, 0]
[[rigid_body]]
name = "b2"
shape = "box"
size_m = [0.4, 0.4, 0.4]
mass_kg = 1
position_m = [0.11, 0, 1]
velocity_m_s = [-2.07, 0.01, 0]
[gravity]
[contact]
friction = 1
[step]
step_s = 0.02
steps = 6
[method]
tolerance = 1e-9
relaxation = "direct"
)") <= 1e-7);
}

TEST_CASE("a contact force that is another is told with step, number and bound") {
  pbd::Workspace workspace(column(2), method_of("direct"));
  pbd::State state = workspace.scene().initial;
  StepChecks checks;
  constexpr double h = 0.01;
  for (int number = 1; number <= 3; ++number) {
    const pbd::State start = state;
    const auto report = pbd::step(workspace, h, state);
    auto claim = claim_of(workspace.scene(), workspace, start, state, h, report);
    if (number == 2) claim.contacts.front().force *= 1.01;
    checks.add(number, claim, report.status, false);
  }
  CHECK(checks.judged() == 3);
  CHECK(checks.refuted_steps() == 1);
  REQUIRE_FALSE(checks.refuted().empty());
  CHECK(checks.refuted().front().step == 2);
  CHECK_THAT(checks.text(), Catch::StartsWith("refuted: 1 of 3 steps, the first at step 2: momentum off by"));
}

TEST_CASE("a step that moves what is fixed is far from every solution, by any integrator") {
  const std::string integrator = GENERATE("implicit_euler", "newmark", "bdf2");
  pbd::Scene scene = column(2);
  pbd::Method method = method_of("direct");
  method.integrator = integrator;
  pbd::Workspace workspace(scene, method);
  pbd::State state = scene.initial;
  const pbd::State start = state;
  constexpr double h = 0.01;
  const auto report = pbd::step(workspace, h, state);
  pbd::reference::IntegratorMemory memory(method);
  const auto judged = [&] {
    const auto claim = claim_of(scene, workspace, start, state, h, report);
    const auto map = memory.map_of(claim);
    return judge_claim("cone_interior_point", claim, map ? &*map : nullptr);
  };
  CHECK(judged().nearest.of_scale <= 1e-6);
  state.v(0, 0) = 1e-9;  // the ground's
  CHECK(judged().nearest.of_scale == pbd::infinity);
  CHECK_FALSE(judged().solves_as_it_is());
  state.v(0, 0) = std::nan("");
  CHECK(judged().nearest.of_scale == pbd::infinity);
}

TEST_CASE("a step that missed its tolerance claims nothing") {
  pbd::Method method = method_of("gauss_seidel");
  method.max_outer = method.max_sweeps = 1;
  pbd::Workspace workspace(column(4), method);
  pbd::State state = workspace.scene().initial;
  const pbd::State start = state;
  const auto report = pbd::step(workspace, 0.01, state);
  REQUIRE(report.status == pbd::Status::not_converged);
  StepChecks checks;
  checks.add(1, claim_of(workspace.scene(), workspace, start, state, 0.01, report), report.status, false);
  CHECK(checks.judged() == 0);
  CHECK(checks.text() == "checked: 0 steps by 0 numbers, none refuted (1 missed their tolerance)");
}
