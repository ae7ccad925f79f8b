// What the program leaves behind when a simulation fails, a signal ends it, or nothing can be written.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results.h"
#include "scenes/scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

/// A particle under the largest acceleration a scene may state, its energy written down.
constexpr const char* falling_particle =
    "[gravity]\nacceleration_m_s2 = [0, 0, -1e100]\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n"
    "[step]\nstep_s = 1\nsteps = 4\n[[probe]]\nkind = \"energy\"\n";

std::vector<std::string> partial_files(const std::filesystem::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".partial") found.push_back(entry.path().filename().string());
  return found;
}

/// Runs what follows and signals it `signals` times, half a second apart.
std::string signalled(int signals) {
  std::string script = "\"$0\" \"$@\" & p=$!; ";
  for (int i = 0; i < signals; ++i) script += "sleep 0.5; kill -TERM $p; ";
  return "sh -c '" + script + "wait $p'";
}

}  // namespace

TEST_CASE("a simulation that loses its state is recorded as failed, and writes no number that is none") {
  const TemporaryFolder folder;
  const auto scene = folder.write("fly.toml", falling_particle);
  for (const auto& [setting, reason] : std::vector<std::pair<std::string, std::string>>{
           {"step.step_s=1e54", "step 2 diverged: gravity_energy_j is not finite"},
           {"step.step_s=1e53", ""},
           {"step.step_s=1e100", "step 1 diverged, in parts, too: not finite"}}) {
    INFO(setting);
    const auto ran = run_program({"simulate", scene, "--set", setting, "-o", folder.path});
    const auto record = record_of(folder.path);
    CHECK(ran.exit_code == (reason.empty() ? 0 : 1));
    CHECK(record["status"] == (reason.empty() ? "complete" : "failed"));
    CHECK(record.value("reason", "") == reason);
    CHECK_THAT(ran.err, !Catch::Contains("with nan") && !Catch::Contains("with -nan"));
    CHECK_THAT(read_text(folder.path / "probes.csv"), !Catch::Contains("inf") && !Catch::Contains("nan"));
  }
}

TEST_CASE("a step that diverges is made in parts, and the simulation says so") {
  const TemporaryFolder folder;
  // The square of the whole step's change of velocity, 2e154 m/s, is not finite; that of half a step's is.
  const auto scene = folder.write(
      "fly.toml",
      "[gravity]\nacceleration_m_s2 = [0, 0, -1e100]\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n"
      "[step]\nstep_s = 2e54\nsteps = 1\n");
  const auto ran = run_program({"simulate", scene, "-o", folder.path});
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.err, Catch::Contains("step 1 diverged and was made in 2 parts"));
  const auto report = record_of(folder.path)["report"];
  CHECK(report["steps_by_status"]["ok"] == 1);
  CHECK(report["steps_in_parts"] == 1);
  CHECK(report["most_parts"] == 2);
}

TEST_CASE("no row of compare is ok without a finite error") {
  const TemporaryFolder folder;
  const auto scene = folder.write("fly.toml", falling_particle);
  for (const auto* step : {"2", "1e27", "1e54", "1e100"}) {
    INFO(step);
    const auto ran = run_program({"compare", scene, "--set", std::string("step.step_s=") + step, "--method",
                                  "relaxation=direct", "-o", folder.path});
    bool all_ok = true;
    const auto rows = rows_of(folder.path / "compare.csv");
    REQUIRE(rows.size() >= 3);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (rows[i][11] == "ok") CHECK(std::isfinite(std::stod(rows[i][10])));
      all_ok = all_ok && rows[i][11] == "ok";
    }
    CHECK(ran.exit_code == (all_ok ? 0 : 1));
  }
}

TEST_CASE(
    "a signal stops a long step at its next iterate, and a second one stops what is deaf to the first") {
  const TemporaryFolder folder;
  const std::vector<std::string> chain{"simulate", scenes / "chain.toml",
                                       "--set",    "method.relaxation=jacobi",
                                       "--set",    "method.tolerance=0",
                                       "--set",    "method.max_outer=2000000000",
                                       "-o",       folder.path};
  auto long_step = chain, long_iterate = chain;
  for (const auto* word : {"--set", "method.max_sweeps=1", "--set", "chain.0.links=2000"})
    long_step.emplace_back(word);
  const auto stopped = run_program(long_step, signalled(1));
  CHECK(stopped.exit_code == 3);
  CHECK(record_of(folder.path)["status"] == "interrupted");
  CHECK(record_of(folder.path)["report"]["steps"] == 0);

  // What a simulation begins with is to remove the results of an earlier one.
  for (const auto* word : {"--set", "method.max_sweeps=2000000000", "--set", "method.inner_tolerance=0",
                           "--set", "chain.0.links=2000"})
    long_iterate.emplace_back(word);
  const auto killed = run_program(long_iterate, signalled(2));
  CHECK(killed.exit_code == 3);
  CHECK(files_in(folder.path).empty());
}

TEST_CASE("a result that cannot be written is one error with its path, exit code 2, and no partial file") {
  for (const auto* name : {"run.json", "probes.csv", "frames", "simulation.pvd"}) {
    INFO(name);
    const TemporaryFolder folder;
    if (std::string(name) == "frames")
      folder.write(name, "a file");
    else
      std::filesystem::create_directories(folder.path / name / "inside");
    const auto ran = run_program({"simulate", scenes / "pendulum.toml", "--set", "step.duration_s=0.1",
                                  "--export", "vtk", "-o", folder.path});
    CHECK(ran.exit_code == 2);
    CHECK_THAT(ran.err, Catch::StartsWith("error: ") && Catch::Contains((folder.path / name).string()));
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    CHECK(partial_files(folder.path).empty());
  }
  for (const auto& [duration, name] : {std::pair{"0.01", "run.json"}, std::pair{"2", "probes.csv"}}) {
    INFO("no file longer than 512 bytes: " << name);
    const TemporaryFolder folder;
    const std::string limited = "sh -c 'trap \"\" XFSZ; ulimit -f 1; exec \"$0\" \"$@\"'";
    const auto ran = run_program({"simulate", scenes / "pendulum.toml", "--set",
                                  std::string("step.duration_s=") + duration, "-o", folder.path},
                                 limited);
    CHECK(ran.exit_code == 2);
    CHECK_THAT(ran.err, Catch::Contains((folder.path / name).string()) && Catch::Contains("too large"));
    CHECK(partial_files(folder.path).empty());
  }
}

TEST_CASE("a file that is there already under a partial file's name stays as it is") {
  const TemporaryFolder folder;
  const auto own = folder.write("run.json.partial", "mine"), victim = folder.write("victim", "theirs");
  std::filesystem::create_symlink(victim, folder.path / "probes.csv.partial");
  CHECK(run_program({"simulate", scenes / "pendulum.toml", "-o", folder.path}).exit_code == 0);
  CHECK(read_text(own) == "mine");
  CHECK(read_text(victim) == "theirs");
  CHECK(record_of(folder.path)["status"] == "complete");
}

TEST_CASE("messages that nobody takes do not end the program, lost output is an error") {
  const TemporaryFolder folder;
  const std::string deaf = "sh -c '\"$0\" \"$@\" 2>/dev/full'", mute = "sh -c '\"$0\" \"$@\" >/dev/full'";
  CHECK(run_program({"simulate", scenes / "pendulum.toml", "-o", folder.path}, deaf).exit_code == 0);
  CHECK(run_program({"simulate", "none.toml"}, deaf).exit_code == 2);
  for (const auto* word : {"list", "--help"}) CHECK(run_program({word}, mute).exit_code == 2);
}
