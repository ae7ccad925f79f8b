// `pbdcheck advise`, as a user runs it.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <cmath>
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
#if !defined(__SANITIZE_ADDRESS__)  // whose allocator tells nothing
  CHECK(advice["memory_mb"] > 0);
#endif
  CHECK(advice["duration_s"] == 1);
  REQUIRE(run_program(simulate_as_advised(spring, advice, folder.path)).exit_code == 0);
  const auto rows = rows_of(folder.path / "probes.csv");
  const double time = std::stod(rows.back()[1]), x = std::stod(rows.back()[2]);
  const double exact = 1 + 0.1 * std::cos(10 * time), moved = std::abs(exact - 1.1);
  CHECK(time == Approx(1));
  CHECK(std::abs(x - exact) / moved <= std::stod(asked));
}

TEST_CASE("advice on a scene at rest is relative to a thousandth of the size of what may move") {
  const auto scene = scenes / "stack.toml";
  const auto ran = run_program({"advise", scene, "--error", "0.01", "--seconds", "5", "--json"});
  REQUIRE(ran.exit_code == 0);
  const auto advice = nlohmann::json::parse(ran.out);
  CHECK(advice["error"] <= 0.01);
  CHECK(advice["duration_s"] == 1);
  CHECK(advice["before_contact"] == false);
  // Boxes of 0.2 m from 0.1 to 0.7 m above the ground, not held, reach at least so far, and at most to the
  // corners.
  CHECK(advice["error_scale_m"] > 1e-3 * 0.6);
  CHECK(advice["error_scale_m"] < 1e-3 * std::hypot(0.21, 0.21, 0.8));
}

TEST_CASE("advice that ends before anything touches says that it is for free motion alone") {
  const TemporaryFolder folder;
  const auto drop = [&](double height) {
    return folder.write(
        fmt::format("drop_{}.toml", height),
        fmt::format("[gravity]\n[contact]\n[[rigid_body]]\nname = \"ground\"\nshape = \"half_space\"\n"
                    "[[rigid_body]]\nname = \"ball\"\nshape = \"sphere\"\nradius_m = 0.1\nmass_kg = 1\n"
                    "position_m = [0, 0, {}]\n[step]\nstep_s = 1e-5\nduration_s = 100\n",
                    height));
  };
  // It lands after 10 s, 1e6 steps, or after 1e-3 s, 100 steps, each more than a microsecond.
  const auto high = drop(0.1 + 0.5 * 9.81 * 100), low = drop(0.1 + 0.5 * 9.81 * 1e-6);
  const auto advise = [](const auto& scene, const auto&... more) {
    return run_program({"advise", scene, "--error", "0.1", "--seconds", "1", more...});
  };
  const auto falling = nlohmann::json::parse(advise(high, "--json").out);
  CHECK(falling["duration_s"] < 10);
  CHECK(falling["before_contact"] == true);
  CHECK_THAT(advise(high).out, Catch::StartsWith("Nothing touches in the first"));
  const auto landed = nlohmann::json::parse(advise(low, "--json").out);
  CHECK(landed["duration_s"] > 1e-3);
  CHECK(landed["before_contact"] == false);
}

TEST_CASE("a pilot takes the time it is given, no more, and goes past the first contact") {
  const SceneFile boxes = read_scene_file(scenes / "boxes_on_ground.toml", {"rigid_body.1.copies=[2,2,2]"});
  const double seconds = 4;
  const Pilot found = pilot(boxes, 0.01, seconds);
  CHECK(found.duration < 10);  // boxes that collide go separate ways
  CHECK(found.truth.touched);
  CHECK_FALSE(found.met.empty());
  CHECK(found.spent_s > 0.7 * seconds);
  CHECK(found.spent_s < 1.2 * seconds);
}

TEST_CASE("where there is no time for a truth, what is needed is told in that time") {
  const auto cards = scenes / "house_of_soft_cards.toml";
  const auto ran = run_program({"advise", cards, "--error", "0.01", "--seconds", "1", "--json"});
  CHECK(ran.exit_code == 1);
  const auto advice = nlohmann::json::parse(ran.out);
  CHECK(advice["settings"].is_null());
  CHECK(advice["memory_mb"].is_null());
  CHECK(advice["tried"] == 0);
  CHECK(advice["spent_s"] < 10);  // an iteration of the probe and one of the truth above the second
  REQUIRE(advice["needed_s"].is_number());
  CHECK(advice["needed_s"] > 1);
  CHECK_THAT(advice["reason"].get<std::string>(),
             Catch::Contains("no true end") && Catch::Contains("--seconds"));
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
  CHECK_THAT(told.out, Catch::StartsWith("No setting of ") && Catch::Contains("the nearest has") &&
                           Catch::Contains(" MB\n"));
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

TEST_CASE(
    "errors at the end are relative to the farthest way, or to a thousandth of the size if that is more") {
  const TemporaryFolder folder;
  const SceneFile pair = read_scene_file(
      folder.write("pair.toml",
                   "[[particle]]\nposition_m = [1, 0, 0]\nmass_kg = 1\n[[particle]]\nposition_m = [1, 3, 4]\n"
                   "mass_kg = 1\n[step]\nstep_s = 0.1\nsteps = 1\n"));
  const auto shifted = [&](double by) {
    pbd::State state = pair.scene.initial;
    state.x(2, 1) += by;
    return state;
  };
  CHECK(error_scale(pair.scene, shifted(0)) == Approx(5e-3));
  CHECK(error_scale(pair.scene, shifted(1e-3)) == Approx(5e-3));
  CHECK(error_scale(pair.scene, shifted(0.1)) == Approx(0.1));
  CHECK(end_error(pair.scene, {.end = shifted(1e-4)}, shifted(0)) == Approx(1e-4 / 5e-3));
  CHECK(end_error(pair.scene, {.end = shifted(0.1)}, shifted(0.2)) == Approx(0.5));
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
