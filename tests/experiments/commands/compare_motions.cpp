// `pbdcheck compare --until`, as a user runs it: whole motions beside formulas of what each integrator makes
// of them.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <map>

#include "mistakes.h"
#include "results.h"

using namespace pbdcheck::test;

namespace {

using Row = std::map<std::string, std::string>;

/// compare.csv, cells by column: the reference's row first. Texts with a comma, as truths are, come last.
std::vector<Row> motions_of(const std::filesystem::path& folder) {
  const auto rows = rows_of(folder / "compare.csv");
  std::vector<Row> found;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    found.emplace_back();
    for (std::size_t k = 0; k < rows[0].size(); ++k) found.back()[rows[0][k]] = rows[i][k];
  }
  return found;
}

double number(const Row& row, const std::string& column) {
  return std::stod(row.at(column));
}

std::vector<Row> compared(const TemporaryFolder& folder, const std::filesystem::path& scene,
                          const std::string& until, const std::vector<std::string>& methods,
                          std::vector<std::string> more = {}, int exit_code = 0) {
  std::vector<std::string> line{"compare", scene, "--until", until, "-o", folder.path};
  for (const auto& method : methods) line.insert(line.end(), {"--method", method});
  line.insert(line.end(), more.begin(), more.end());
  const auto ran = run_program(line);
  INFO(ran.err);
  CHECK(ran.exit_code == exit_code);
  return motions_of(folder.path);
}

constexpr double rate = 10;  // rad/s, of spring.toml, whose mass goes by cos(rate t)

/// Of the place at 1 s, relative, if it is at `end` of the amplitude.
double spring_error(double end) {
  return std::abs(end - std::cos(rate)) / std::abs(std::cos(rate) - 1);
}

/// Implicit Euler divides z = cos + i sin of the phase by 1 - i rate h in each step.
double implicit_euler_error(int steps) {
  return spring_error(std::real(std::pow(std::complex(1.0, -rate / steps), -steps)));
}

/// The midpoint rule turns z by 2 atan(rate h / 2).
double midpoint_error(int steps) {
  return spring_error(std::cos(2 * steps * std::atan(rate / steps / 2)));
}

const auto spring = scenes / "spring.toml";

}  // namespace

TEST_CASE("motions of a spring by several integrators and steps have the errors of their formulas") {
  const TemporaryFolder folder;
  const auto rows = compared(
      folder, spring, "1",
      {"integrator=implicit_euler tolerance=1e-12", "integrator=midpoint tolerance=1e-12",
       "integrator=bdf2 tolerance=1e-12", "integrator=implicit_euler tolerance=1e-12 step_s=0.0005",
       "integrator=midpoint tolerance=1e-12 step_s=0.0005", "integrator=bdf2 tolerance=1e-12 step_s=0.0005"});
  REQUIRE(rows.size() == 7);
  const Row& reference = rows[0];
  CHECK(reference.at("outer") == "reference");
  CHECK(reference.at("relaxation") == "ode");
  CHECK(reference.at("error") == reference.at("error_bar"));
  CHECK(number(reference, "error_bar") < 1e-9);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    INFO(rows[i].at("method"));
    CHECK(rows[i].at("status") == "ok");
    CHECK(rows[i].at("error_bar") == reference.at("error_bar"));
    CHECK(number(rows[i], "wall_s") > 0);
    CHECK(number(rows[i], "bytes") > 0);
    CHECK(number(rows[i], "missed_steps") == 0);
    CHECK(number(rows[i], "step_s") == Approx(i <= 3 ? 0.001 : 0.0005));
  }
  for (const auto& [euler, midpoint, steps] : {std::tuple{1, 2, 1000}, {4, 5, 2000}}) {
    CHECK(number(rows[euler], "error") == Approx(implicit_euler_error(steps)).epsilon(1e-6));
    CHECK(number(rows[midpoint], "error") == Approx(midpoint_error(steps)).epsilon(1e-4));
    const double h = 1.0 / steps, left = std::pow(1 + rate * rate * h * h, -steps);
    CHECK(number(rows[euler], "energy_error") == Approx(1 - left).epsilon(1e-6));
    CHECK(number(rows[midpoint], "energy_error") < 1e-9);
  }
  CHECK(number(rows[3], "error") / number(rows[6], "error") == Approx(4).epsilon(0.1));
  const auto record = record_of(folder.path);
  CHECK(record["status"] == "complete");
  CHECK(record["settings"]["until_s"] == 1);
  CHECK(record["settings"]["reference"] == "ode");
  CHECK(std::filesystem::exists(folder.path / "figures" / "compare_seconds.svg"));
}

TEST_CASE("finer steps as a reference are as far from the true end as their error bar says") {
  const TemporaryFolder folder;
  const auto rows = compared(folder, spring, "1", {"outer=auto", "outer=auto step_s=0.002"},
                             {"--reference", "finer_steps"});
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("relaxation") == "finer_steps");
  CHECK_THAT(rows[0].at("truth"), Catch::Contains("8000 steps by "));
  const double bar = number(rows[0], "error_bar");
  CHECK(bar > 0);
  CHECK(bar < 1e-4);
  CHECK(std::abs(number(rows[1], "error") - implicit_euler_error(1000)) < bar);
  CHECK(std::abs(number(rows[2], "error") - implicit_euler_error(500)) < bar);
}

// While it slips the crate has the acceleration mu g from rest: implicit Euler is mu g t h / 2 ahead, of a
// way of mu g t^2 / 2.
TEST_CASE("motions with contact are compared with finer steps, as all that have no ODE") {
  const TemporaryFolder folder;
  const auto rows =
      compared(folder, scenes / "conveyor.toml", "0.1", {"outer=auto", "outer=auto step_s=0.005"});
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("relaxation") == "finer_steps");
  for (const auto& [row, h] : {std::pair{1, 0.01}, {2, 0.005}}) {
    CHECK(rows[row].at("friction") == "coulomb");
    CHECK(std::abs(number(rows[row], "error") - h / 0.1) < 3 * number(rows[0], "error_bar"));
  }
  CHECK(number(rows[0], "error_bar") < 1e-3);
}

TEST_CASE("motions of bodies that turn on the spot have an error, which falls at the integrator's order") {
  const TemporaryFolder folder;
  const auto rotor = folder.write(
      "rotor.toml",
      "[[rigid_body]]\nname = \"rotor\"\nmass_kg = 2\ninertia_kg_m2 = [0.01, 0.02, 0.025]\n"
      "angular_velocity_rad_s = [1, 2, 0.5]\n[gyroscopic]\n[step]\nstep_s = 0.01\nsteps = 100\n");
  const auto rows = compared(folder, rotor, "1", {"outer=auto", "outer=auto step_s=0.005"});
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].at("relaxation") == "ode");
  CHECK(number(rows[0], "error_bar") < 1e-9);
  CHECK(number(rows[1], "error") > 1e-4);
  CHECK(number(rows[1], "error") / number(rows[2], "error") == Approx(2).epsilon(0.1));
}

TEST_CASE("a motion whose steps miss their tolerance is made to its end, with its error, and exit code 1") {
  const TemporaryFolder folder;
  const auto rows =
      compared(folder, scenes / "chain.toml", "0.1",
               {"outer=frozen relaxation=gauss_seidel max_sweeps=1", "relaxation=direct"}, {}, 1);
  REQUIRE(rows.size() == 3);
  CHECK(rows[1].at("status") == "not_converged");
  CHECK(number(rows[1], "missed_steps") > 0);
  CHECK(number(rows[1], "error") > number(rows[2], "error"));
  CHECK(rows[2].at("status") == "ok");
}

TEST_CASE("where finer steps find no end, motions are skipped with the reason") {
  const TemporaryFolder folder;
  const auto torn = folder.write(
      "torn.toml",
      "[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n[[particle]]\nposition_m = [1, 0, 0]\nmass_kg = "
      "1\n[[distance]]\nnodes = [0, 1]\nrest_length_m = 1\n[[distance]]\nnodes = [0, 1]\nrest_length_m = "
      "2\n[step]\nstep_s = 0.01\nsteps = 1\n");
  const auto rows = compared(folder, torn, "0.01", {"relaxation=direct"}, {}, 1);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].at("status") == "not_converged");
  CHECK(rows[1].at("status") == "skipped");
  CHECK(rows[1].at("error") == "nan");
  CHECK_THAT(rows[1].at("reason"), Catch::Contains("reference finer_steps"));
  CHECK(record_of(folder.path)["status"] == "failed");
}

TEST_CASE("an interrupted comparison of motions exits with 3 and leaves whole files") {
  const TemporaryFolder folder;
  const auto ran = run_program({"compare", scenes / "pendulum.toml", "--set", "step.duration_s=1e6",
                                "--until", "1e6", "--method", "outer=auto", "-o", folder.path},
                               "timeout --preserve-status -s INT 3");
  CHECK(ran.exit_code == 3);
  CHECK(record_of(folder.path)["status"] == "interrupted");
  CHECK(files_in(folder.path) == std::vector<std::string>{"compare.csv", "run.json"});
}

TEST_CASE("what no motion can be compared by is refused with what is allowed") {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> refused{
      {{"--until", "2"}, {"--until: got 2", "the scene lasts 1 s"}},
      {{"--until", "0"}, {"--until: got `0`"}},
      {{"--until", "0.0015"}, {"--until: got 0.0015 s in steps of 0.001 s", "step_s=VALUE"}},
      {{"--until", "1", "--at-step", "3"}, {"--at-step", "--until"}},
      {{"--until", "1", "--reference", "ipopt"},
       {"--reference: got `ipopt` with --until", "ode, finer_steps"}},
      {{"--until", "1", "--method", "step_s=0.3"}, {"--method step_s: got 1 s in steps of 0.3 s"}},
      {{"--until", "1", "--method", "step_s=fast"}, {"--method step_s: got `fast`", "a number above 0"}},
      {{"--until", "1", "--method", "rival=newton"}, {"--method rival: got `rival=newton` with --until"}},
      {{"--until", "1", "--method", "outer=auto step_s=0.001"}, {"the same as `outer=auto`"}},
      {{"--method", "outer=auto step_s=0.001"}, {"--method step_s", "with --until"}},
      {{"--method", "integrator=bdf2"}, {"each integrator has its own answer to one step; --until T"}},
      {{"--reference", "ode"}, {"--reference: got `ode`", "with --until"}}};
  for (const auto& [more, message] : refused) {
    INFO(message[0]);
    std::vector<std::string> line{"compare", spring, "--method", "outer=auto", "-o", out};
    line.insert(line.end(), more.begin(), more.end());
    check_refused(run_program(line), message);
    CHECK_FALSE(std::filesystem::exists(out));
  }
  check_refused(run_program({"compare", scenes / "conveyor.toml", "--until", "0.1", "--reference", "ode",
                             "--method", "outer=auto"}),
                {"--reference ode: "});
}
