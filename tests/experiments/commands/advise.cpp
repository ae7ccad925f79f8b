// `pbdcheck advise`, as a user runs it.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "harness/pilot.h"
#include "mistakes.h"
#include "ode.h"
#include "results.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

/// The arguments that `advise` recommends, on top of `simulate SCENE`.
std::vector<std::string> simulate_as_advised(const std::filesystem::path& scene, const nlohmann::json& advice,
                                             const std::filesystem::path& output) {
  std::vector<std::string> arguments{"simulate", scene, "-o", output};
  for (const auto& [key, value] : advice["settings"].items()) {
    arguments.emplace_back("--set");
    arguments.push_back(key + "=" + value.get<std::string>());
  }
  return arguments;
}

}  // namespace

TEST_CASE("the settings that are advised bring a spring to the error asked of its closed form") {
  const TemporaryFolder folder;
  const auto spring = scenes / "spring.toml";
  const auto asked = GENERATE("0.1", "0.001");
  const auto ran = run_program({"advise", spring, "--error", asked, "--seconds", "5", "--json"});
  REQUIRE(ran.exit_code == 0);
  const auto advice = nlohmann::json::parse(ran.out);
  CHECK(advice["found"] == true);
  CHECK(advice["error"] <= std::stod(asked));
  CHECK(advice["ms_per_s"] > 0);
  CHECK(advice["margin"] >= 1);
  CHECK(advice["duration_s"] == 1);
  REQUIRE(run_program(simulate_as_advised(spring, advice, folder.path)).exit_code == 0);
  const auto rows = rows_of(folder.path / "probes.csv");
  const double time = std::stod(rows.back()[1]), x = std::stod(rows.back()[2]);
  const double exact = 1 + 0.1 * std::cos(10 * time), moved = std::abs(exact - 1.1);
  CHECK(time == Approx(1));
  CHECK(std::abs(x - exact) / moved <= std::stod(asked));
}

TEST_CASE("where no setting meets the error, the nearest is told and the exit code is 1") {
  const auto ran =
      run_program({"advise", scenes / "spring.toml", "--error", "1e-13", "--seconds", "0.5", "--json"});
  CHECK(ran.exit_code == 1);
  const auto advice = nlohmann::json::parse(ran.out);
  CHECK(advice["found"] == false);
  CHECK(advice["error"] > 1e-13);
  CHECK(advice["settings"]["method.outer"].is_string());
  CHECK(advice["cannot_tell"].size() >= 2);
  const auto told = run_program({"advise", scenes / "spring.toml", "--error", "1e-13", "--seconds", "0.5"});
  CHECK(told.exit_code == 1);
  CHECK_THAT(told.out, Catch::StartsWith("No setting of ") && Catch::Contains("the nearest has"));
}

TEST_CASE("advice states steps by count where the scene does, and keeps its law of friction") {
  const TemporaryFolder folder;
  const auto scene = folder.write(
      "slide.toml",
      "[gravity]\n[contact]\n[[rigid_body]]\nname = \"ground\"\nshape = \"half_space\"\n[[rigid_body]]\n"
      "name = \"box\"\nshape = \"box\"\nsize_m = [0.2, 0.2, 0.1]\nmass_kg = 1\nposition_m = [0, 0, 0.05]\n"
      "velocity_m_s = [1, 0, 0]\n[step]\nstep_s = 0.01\nsteps = 10\n[method]\nfriction = \"cone\"\n");
  const auto ran = run_program({"advise", scene, "--error", "0.05", "--seconds", "5", "--json"});
  REQUIRE(ran.exit_code == 0);
  const auto settings = nlohmann::json::parse(ran.out)["settings"];
  CHECK(std::stod(settings["step.step_s"].get<std::string>()) *
            std::stod(settings["step.steps"].get<std::string>()) ==
        Approx(0.1));
  CHECK_FALSE(settings.contains("method.friction"));
}

TEST_CASE("advise refuses what it cannot use, in one line that says what is allowed") {
  const std::string spring = scenes / "spring.toml";
  check_refused(run_program({"advise", spring, "--error", "0"}), {"--error: got `0`", "a number above 0"});
  check_refused(run_program({"advise", spring, "--error", "nan"}), {"--error: got `nan`"});
  check_refused(run_program({"advise", spring, "--error", "2"}), {"--error: got `2`", "at most 1"});
  check_refused(run_program({"advise", spring, "--error", "0.1", "--seconds", "-1"}),
                {"--seconds: got `-1`"});
  check_refused(run_program({"advise", spring}), {"--error is required"});
  check_refused(run_program({"advise", spring, "--error", "0.1", "--set", "method.outer=x"}),
                {"method.outer"});
}

TEST_CASE("truths are as sharp as their bars say, and not those of an integrator that ends elsewhere") {
  const SceneFile spring = read_scene_file(scenes / "spring.toml");
  const Setting finest{.method = {}, .steps = 200};
  const auto coarse = agreed_truth(spring, 1, finest, {"implicit_euler"});
  const auto fine = agreed_truth(spring, 1, finest, {"implicit_euler", "generalised_alpha"});
  const auto exact = pbd::reference::ode(spring.scene, {1}).samples[0];
  for (const auto& truth : {coarse, fine}) {
    const double error = end_error(spring.scene, {.end = truth.end}, exact);
    CHECK(error > 0);
    CHECK(error < 3 * truth.error_bar);
  }
  CHECK(fine.error_bar < coarse.error_bar / 10);
  CHECK(coarse.told(0) == 3 * coarse.error_bar);
  CHECK(std::isnan(coarse.told(std::nan(""))));

  // Newmark gives back a part of the speed of an impact.
  const TemporaryFolder folder;
  const SceneFile fall = read_scene_file(folder.write(
      "fall.toml",
      "[gravity]\n[contact]\n[[rigid_body]]\nname = \"ground\"\nshape = \"half_space\"\n[[rigid_body]]\n"
      "name = \"ball\"\nshape = \"sphere\"\nradius_m = 0.1\nmass_kg = 1\nposition_m = [0, 0, 0.15]\n"
      "[step]\nstep_s = 0.01\nsteps = 20\n"));
  const auto landed = agreed_truth(fall, 0.2, finest, {"implicit_euler", "newmark"});
  CHECK(landed.end.x(2, 1) == Approx(0.1).margin(1e-6));
  CHECK_THAT(landed.method, Catch::Contains("implicit_euler"));
}
