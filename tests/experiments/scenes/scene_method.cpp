// Step, method and probes of scene files, and the examples of their description.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <numeric>

#include "read_scene.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

TEST_CASE("step, method and probes are read, and --set wins over the file") {
  const std::string chain = "description = \"a chain\"\n[[chain]]\nlength_m = 1\nmass_kg = 1\n";
  const auto file = read(chain + R"(direction = [1, 0, 0]
[method]
outer = "frozen"
relaxation = "jacobi"
tolerance = 1e-3
max_outer = 7
max_sweeps = 8
inner_tolerance = 0.1
warm_start = false
[[probe]]
kind = "position"
node = 20
name = "tip"
[[probe]]
kind = "velocity"
node = 3
)",
                         {"method.relaxation=nesterov_jacobi", "step.step_s=0.5", "chain.0.tip_mass_kg=100",
                          "chain.0.direction.2=4", "gravity.acceleration_m_s2=[0, 0, -1]", "step.steps=2"});
  CHECK(file.description == "a chain");
  CHECK(file.step_s == 0.5);
  CHECK(file.steps == 2);
  CHECK(file.method.outer == "frozen");
  CHECK(file.method.relaxation == "nesterov_jacobi");
  CHECK(file.method.tolerance == 1e-3);
  CHECK(file.method.max_outer == 7);
  CHECK(file.method.max_sweeps == 8);
  CHECK(file.method.inner_tolerance == 0.1);
  CHECK_FALSE(file.method.warm_start);
  CHECK(file.scene.mass[20] == 100);
  CHECK(file.scene.initial.x.col(20).isApprox(pbd::Vec3(1, 0, 4) / std::sqrt(17.0), 1e-15));
  CHECK(std::holds_alternative<pbd::Gravity>(file.scene.effects.back()));
  REQUIRE(file.probes.size() == 2);
  CHECK(file.probes[0].node == 20);
  CHECK(file.probes[1].name == "node_3");
  CHECK_THROWS_WITH(read(chain, {"chain.0.direction.2=4"}), Catch::Contains("direction"));
}

TEST_CASE("a method survives being written as text and read again") {
  pbd::Method method;
  method.outer = "frozen";
  method.friction = "disc";
  method.tolerance = 0.1 + 0.2;
  method.warm_start = false;
  method.memory = 7;
  method.integrator = "newmark";
  method.beta = 0.3;
  method.gamma = 0.1 + 0.5;
  method.rho = 0.3;
  method.direction_blend = 0.25;
  method.stabilisation = 0.2;
  const auto again = parse_method(method_text(method), {}, "--method");
  CHECK(method_text(again) == method_text(method));
  CHECK(again.tolerance == method.tolerance);
  CHECK(again.memory == 7);
  CHECK(again.friction == "disc");
  CHECK(again.integrator == "newmark");
  CHECK(again.alpha == pbd::Method{}.alpha);
  CHECK(again.beta == method.beta);
  CHECK(again.gamma == method.gamma);
  CHECK(again.rho == 0.3);
  CHECK(again.direction_blend == 0.25);
  CHECK(again.stabilisation == 0.2);
  CHECK(parse_method("alpha=0.5", {}, "--method").alpha == 0.5);
  CHECK_THROWS_WITH(parse_method("memory=1001", {}, "--method"), Catch::Contains("0 to 1000"));
  CHECK(parse_method("max_outer=3", method, "--method").outer == "frozen");
}

TEST_CASE("every example of the format's description is read") {
  const std::string four_particles =
      "[particles]\nposition_m = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]\nmass_kg = 1\n";
  const std::string document = read_text(scenes / "README.md");
  const std::string opening = "```toml\n";
  int count = 0;
  for (auto at = document.find(opening); at != std::string::npos; at = document.find(opening, at + 1)) {
    const auto begin = at + opening.size();
    const std::string example = document.substr(begin, document.find("```", begin) - begin);
    INFO(example);
    const TemporaryFolder folder;
    std::filesystem::create_directory_symlink(scenes / "meshes", folder.path / "meshes");
    const auto whole = example + (example.find("[particles]") == std::string::npos ? four_particles : "") +
                       (example.find("[step]") == std::string::npos ? two_steps : "");
    CHECK_NOTHROW(read_scene_file(folder.write("scene.toml", whole)));
    ++count;
  }
  CHECK(count >= 20);
}

TEST_CASE("a setting takes the place of a key that says the same in other words") {
  const SceneFile by_count = read_scene_file(scenes / "pendulum.toml", {"step.steps=3"});
  CHECK(by_count.steps == 3);
  const SceneFile by_time =
      read_scene_file(scenes / "pendulum.toml", {"step.steps=3", "step.step_s=0.01", "step.duration_s=0.05"});
  CHECK(by_time.steps == 5);
}
