// The scenes of rigid bodies that come with the program, against their formulas.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <numbers>

#include "harness/probes.h"
#include "program.h"
#include "scenes/scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using pbd::Vec3;

// With the crank at the angle 4 rad/s t, the pin is where circles of 1 m about the crank's end and the
// rocker's pivot meet above the line between them.
TEST_CASE("the linkage goes through the places of a four-bar chain") {
  const auto file = read_scene_file(scenes / "linkage.toml");
  pbd::Workspace workspace(file.scene, file.method);
  auto state = file.scene.initial;
  const auto& probe = file.probes.at(0);
  REQUIRE(probe.name == "pin");
  for (std::int64_t k = 0; k < file.steps; ++k) {
    REQUIRE(pbd::step(workspace, file.step_s, state).status == pbd::Status::ok);
    const Vec3 end(0.3 * std::cos(4 * state.time), 0, 0.3 * std::sin(4 * state.time)), pivot(1.5, 0, 0);
    const Vec3 gap = pivot - end, across = Vec3(-gap.z(), 0, gap.x()).normalized();
    const Vec3 pin = (end + pivot) / 2 + std::sqrt(1 - gap.squaredNorm() / 4) * across;
    std::vector<Cell> row;
    append_probes(file, state, &workspace, row);
    const Vec3 found(std::get<double>(row[0]), std::get<double>(row[1]), std::get<double>(row[2]));
    REQUIRE((found - pin).norm() < 1e-9);
  }
}

// m g l = I3 s W - I1 W^2 cos(tilt): the axis goes round the vertical at W. The integrator is of order 2.
TEST_CASE("the top precesses at the rate of its spin, to the order of its integrator") {
  std::vector<double> errors;
  for (const auto* step : {"0.004", "0.002"}) {
    const auto file = read_scene_file(scenes / "top.toml", {std::string("step.step_s=") + step});
    const double m = 0.5, l = 0.1, r = 0.1, tilt = std::numbers::pi / 6, rate = 5;
    const double own = m * r * r / 2, across = m * (3 * r * r + 0.02 * 0.02) / 12 + m * l * l;
    const double spin = file.scene.initial.spin(2, 0);
    CHECK(own * spin * rate - across * rate * rate * std::cos(tilt) == Approx(m * 9.81 * l));
    pbd::Workspace workspace(file.scene, file.method);
    auto state = file.scene.initial;
    for (std::int64_t k = 0; k < file.steps; ++k)
      REQUIRE(pbd::step(workspace, file.step_s, state).status == pbd::Status::ok);
    const Vec3 expected = l * Vec3(std::sin(tilt) * std::cos(rate * state.time),
                                   std::sin(tilt) * std::sin(rate * state.time), std::cos(tilt));
    errors.push_back((state.x.col(0) - expected).norm());
  }
  CHECK(errors[0] / errors[1] == Approx(4).margin(0.4));
  CHECK(errors[1] < 0.02 * 0.1 * 0.5);  // of the circle's radius
}

TEST_CASE("VTK frames of rigid bodies hold their surfaces") {
  const TemporaryFolder folder;
  const auto ran = run_program({"simulate", scenes / "top.toml", "--set", "step.duration_s=0.003", "--export",
                                "vtk", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto frame = read_text(folder.path / "frames" / "bodies_000003.vtu");
  CHECK_THAT(frame, Catch::Contains("NumberOfPoints=\"66\" NumberOfCells=\"128\""));  // 2 x 32 + 2, 4 x 32
  CHECK_THAT(read_text(folder.path / "bodies.pvd"), Catch::Contains("frames/bodies_000003.vtu"));
}
