// What probes and checks of steps tell, against formulas.
#include "harness/probes.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "harness/step_checks.h"
#include "residual.h"
#include "scenes/contacts.h"
#include "studies/robustness/gates.h"

using namespace pbdcheck;

namespace {

std::vector<double> probed(const SceneFile& file) {
  std::vector<Cell> row;
  append_probes(file, file.scene.initial, nullptr, row);
  std::vector<double> values;
  for (const Cell& cell : row) values.push_back(std::get<double>(cell));
  return values;
}

}  // namespace

TEST_CASE("probes of momentum and of a body's point are those of the formulas") {
  SceneFile file;
  // 2 kg at (1, 0, 0) with (0, 3, 0) m/s, and a body turned by a quarter about z that turns about its own z
  // with 5 rad/s: its point (1, 0, 0) is at (0, 1, 0) from its centre, which moves with (0, 0, 4) m/s.
  pbd::add_node(file.scene, {1, 0, 0}, 2, {0, 3, 0});
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::acos(0.0), pbd::Vec3::UnitZ()));
  const int body = pbd::add_body(file.scene, {0, 0, 7}, 1, {1, 1, 3}, quarter, {0, 0, 4}, {0, 0, 5});
  file.probes = {{.kind = "momentum", .name = ""},
                 {.kind = "position", .name = "", .body = body, .point = {1, 0, 0}},
                 {.kind = "velocity", .name = "", .body = body, .point = {1, 0, 0}},
                 {.kind = "angular_velocity", .name = "", .body = body}};
  const std::vector<double> expected{0, 6, 4, 0, 0, 6 + 15, 0, 1, 7, -5, 0, 4, 0, 0, 5};
  const auto found = probed(file);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    INFO(probe_columns(file)[i]);
    CHECK(found[i] == Approx(expected[i]).margin(1e-14));
  }
}

TEST_CASE("a step is judged by the method's own tolerance") {
  for (const double tolerance : {1e-4, 1e-9}) {
    pbd::Method method;
    method.relaxation = "direct";
    method.tolerance = tolerance;
    pbd::Workspace workspace(column(2), method);
    pbd::State state = workspace.scene().initial;
    const pbd::State start = state;
    const auto report = pbd::step(workspace, 0.01, state);
    const auto claim = claim_of(workspace.scene(), workspace, start, state, 0.01, report);
    CHECK(claim.tolerance == tolerance);
    CHECK(claim.scale == report.scale);
  }
}

// Status ok allows each of two residuals the tolerance: together sqrt(2) of it, and no more than that passes.
TEST_CASE("the gate of claims asks for what the status says") {
  HardCase each{"chain", chain(4), 0.01, 1};
  pbd::Method method;
  method.relaxation = "gauss_seidel";
  method.tolerance = 1e-3;
  const auto simulated = simulate(each, method, each.h, {1, 1, 1});
  REQUIRE(simulated.steps_ok == 1);
  const auto judged = pbd::reference::residual_of(each.scene, each.scene.initial, each.h, simulated.end);
  const auto claims = std::find_if(simulated.gates.begin(), simulated.gates.end(),
                                   [](const Gate& gate) { return gate.name == "claims"; });
  REQUIRE(claims != simulated.gates.end());
  const double allowed =
      std::sqrt(2.0) * std::max(method.tolerance * judged.scale, judged.rounding) + judged.own;
  CHECK(claims->measured == Approx(judged.residual / allowed).epsilon(1e-12));
  CHECK(claims->measured > 0);
  CHECK(claims->bound == 1);
}

// Implicit Euler takes energy from what moves: what a step has is less than it began with and was given.
TEST_CASE("the gate of energy tells a gain, and a loss as none") {
  HardCase each{"chain", chain(4), 0.01, 1};
  const auto simulated = simulate(each, pbd::Method{}, each.h, {20, 20, 1});
  const auto energy = std::find_if(simulated.gates.begin(), simulated.gates.end(),
                                   [](const Gate& gate) { return gate.name == "energy"; });
  REQUIRE(energy != simulated.gates.end());
  CHECK(energy->measured == 0);
}
