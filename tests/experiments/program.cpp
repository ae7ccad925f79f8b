// The program as a user runs it: what it writes and its exit codes.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

const std::filesystem::path scenes = PBDCHECK_SCENES;

std::vector<std::vector<std::string>> rows_of(const std::filesystem::path& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(read_text(csv));
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

nlohmann::json record_of(const std::filesystem::path& directory) {
  return nlohmann::json::parse(read_text(directory / "run.json"));
}

}  // namespace

TEST_CASE("every scene that comes with the program is read, and says what it shows") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    INFO(entry.path());
    CHECK_FALSE(read_scene_file(entry.path()).description.empty());
    ++count;
  }
  CHECK(count >= 7);
}

TEST_CASE("simulate writes a row of probes a step and a record of the run") {
  const TemporaryFolder folder;
  const auto ran =
      run_program({"simulate", scenes / "net.toml", "--set", "step.duration_s=0.1", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto rows = rows_of(folder.path / "probes.csv");
  REQUIRE(rows.size() == 1 + 21);
  CHECK(rows[0][0] == "step");
  CHECK(rows[0][1] == "time_s");
  CHECK(rows[0][4] == "momentum_z_kg_m_s");
  // Constraints between particles do not change the momentum; gravity takes 6 kg x 9.81 m/s^2 x 0.1 s of it.
  CHECK(std::stod(rows[21][4]) == Approx(12 - 6 * 9.81 * 0.1).epsilon(1e-12));
  const auto record = record_of(folder.path);
  CHECK(record["status"] == "complete");
  CHECK(record["report"]["steps_by_status"]["ok"] == 20);
  CHECK(record["settings"]["set"][0] == "step.duration_s=0.1");
  CHECK(record["commit"].get<std::string>().size() >= 7);
  CHECK_FALSE(std::filesystem::exists(folder.path / "probes.csv.partial"));
}

TEST_CASE("a step that misses its tolerance is counted, warned about, and makes the exit code 1") {
  const TemporaryFolder folder;
  const auto ran = run_program({"simulate", scenes / "chain.toml", "--set", "step.duration_s=0.01", "--set",
                                "method.relaxation=gauss_seidel", "--set", "method.max_outer=1", "--set",
                                "method.max_sweeps=1", "-o", folder.path});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Catch::Contains("warning: 5 of 5 steps missed the tolerance"));
  CHECK(record_of(folder.path)["report"]["steps_by_status"]["not_converged"] == 5);
}

TEST_CASE("an interrupted simulation exits with 3 and leaves complete files of what was done") {
  const TemporaryFolder folder;
  const auto ran =
      run_program({"simulate", scenes / "pendulum.toml", "--set", "step.duration_s=1e6", "-o", folder.path},
                  "timeout --preserve-status -s INT 1");
  CHECK(ran.exit_code == 3);
  const auto record = record_of(folder.path);
  CHECK(record["status"] == "interrupted");
  CHECK(rows_of(folder.path / "probes.csv").size() == record["report"]["steps"].get<std::size_t>() + 2);
}

TEST_CASE("VTK frames hold the scene's cells and the collection names every frame") {
  const TemporaryFolder folder;
  const auto ran = run_program({"simulate", scenes / "cantilever.toml", "--set", "step.duration_s=0.03",
                                "--export", "vtk", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto frame = read_text(folder.path / "frames" / "frame_000003.vtu");
  CHECK_THAT(frame, Catch::Contains("NumberOfPoints=\"81\" NumberOfCells=\"192\""));
  CHECK_THAT(frame, Catch::Contains("Name=\"velocity\""));
  CHECK_THAT(read_text(folder.path / "simulation.pvd"), Catch::Contains("frames/frame_000003.vtu"));
}

TEST_CASE("list prints names, as JSON if asked; --help, --version and completion print to stdout") {
  const auto listed = nlohmann::json::parse(run_program({"list", "relaxations", "--json"}).out);
  CHECK(listed[0]["name"] == "gauss_seidel");
  CHECK(nlohmann::json::parse(run_program({"list", "--json"}).out).size() == 9);
  CHECK_THAT(run_program({"list", "scenes"}).out, Catch::Contains("pendulum.toml"));
  CHECK_THAT(run_program({"--version"}).out, Catch::Contains("pbdcheck ") && Catch::Contains("eigen 3."));
  for (const auto* command : {"list", "simulate", "compare", "run", "completion"}) {
    const auto ran = run_program({command, "--help"});
    CHECK(ran.exit_code == 0);
    CHECK_THAT(ran.out, Catch::Contains("--help"));
  }
  CHECK_THAT(run_program({"completion"}).out, Catch::Contains("complete -F _pbdcheck pbdcheck"));
}

TEST_CASE("compare writes the reference's row and every iterate of every method, with errors that fall") {
  const TemporaryFolder folder;
  const auto ran = run_program({"compare", scenes / "pendulum.toml", "--at-step", "30", "--method",
                                "relaxation=direct", "--method", "relaxation=jacobi max_sweeps=50",
                                "--reference", "primal_newton", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto rows = rows_of(folder.path / "compare.csv");
  CHECK(rows[0] == std::vector<std::string>{"scene", "step_s", "integrator", "outer", "relaxation",
                                            "friction", "outer_iterations", "sweeps", "row_updates", "wall_s",
                                            "error", "status", "reason"});
  CHECK(rows[1][3] == "judge");
  CHECK(rows[1][4] == "primal_newton");
  REQUIRE(rows.size() > 6);
  for (std::size_t i = 2; i < rows.size(); ++i) {
    CHECK(rows[i][11] == "ok");
    const bool last = i + 1 == rows.size() || rows[i + 1][4] != rows[i][4];
    if (last) CHECK(std::stod(rows[i][10]) < 1e-8);
  }
  CHECK(rows[2][4] == "direct");
  CHECK(rows.back()[4] == "jacobi");
}
