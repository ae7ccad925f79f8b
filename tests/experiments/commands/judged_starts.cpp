// Where a motion begins anew within a scene, at a limit or where a motor jumps, the judge takes the solver's
// step for what it is.
#include <algorithm>
#include <catch2/catch.hpp>

#include "results.h"

using namespace pbdcheck::test;

namespace {

const std::string begin =
    "[[rigid_body]]\nname = \"body\"\nshape = \"box\"\nmass_kg = 1\nposition_m = [1, 0, 0]\n";
const std::string end = "[step]\nstep_s = 0.01\nsteps = 40\n[method]\ntolerance = 1e-10\n";
const std::string turned =
    "[[joint]]\nkind = \"angle\"\nbodies = [\"world\", \"body\"]\naxis = [0, 0, 1]\n"
    "stiffness_n_m_per_rad = 20\n";

const std::string swinging =
    begin + "size_m = [1, 0.1, 0.1]\nangular_velocity_rad_s = [0, 0, 1]\n" + turned + end;
const std::string motor = begin + "size_m = [1, 0.1, 0.1]\n" + turned +
                          "damping_s = 0.05\nrate_rad_s = 1\nover_time = [[0.1, 0], [0.100001, 1]]\n" + end;
const std::string caught =
    begin + "size_m = [0.2, 0.1, 0.1]\nvelocity_m_s = [1, 2, 0.3]\nangular_velocity_rad_s = [1, 2, 3]\n" +
    R"(
[[joint]]
kind = "distance"
bodies = ["world", "body"]
points_m = [[0, 0, 0], [0.9, 0.05, 0.05]]
stiffness_n_per_m = 100
damping_s = 0.05
[[joint]]
kind = "distance"
bodies = ["world", "body"]
points_m = [[0, -1, 0], [1.1, 0.05, 0.05]]
max_length_m = 1.6
compliance_m_per_n = 1e-4
damping_s = 0.001
)" + end;

}  // namespace

TEST_CASE("steps about a stop, a jump and of a spring end where the judge's do, under every integrator") {
  const std::string scene = GENERATE(as<std::string>(), swinging, caught, motor);
  for (const std::string integrator : {"newmark", "bdf2", "generalised_alpha", "midpoint"}) {
    // Of a damped motor bdf2 takes the change of its rate between steps for a motion (integrators.h).
    if (scene == motor && integrator == "bdf2") continue;
    const TemporaryFolder folder;
    const auto out = folder.path / "out";
    const auto ran = run_program({"simulate", folder.write("scene.toml", scene), "--set",
                                  "method.integrator=" + integrator, "--judge", "every=1", "-o", out});
    REQUIRE(ran.exit_code == 0);
    const auto judged = rows_of(out / "judged.csv");
    REQUIRE(judged.size() > 30);
    const auto column = static_cast<std::size_t>(
        std::find(judged[0].begin(), judged[0].end(), "nearest_error_of_scale") - judged[0].begin());
    for (std::size_t i = 1; i < judged.size(); ++i) {
      INFO(integrator << ", step " << i << "\n" << scene);
      CHECK(std::stod(judged[i][column]) <= 1e-6);
    }
  }
}
