// The program as a user runs it: what it writes and its exit codes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results.h"
#include "scenes/scene_file.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

TEST_CASE("every scene that comes with the program is read, and says what it shows") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    INFO(entry.path());
    CHECK_FALSE(read_scene_file(entry.path()).description.empty());
    ++count;
  }
  CHECK(count >= 12);
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
  CHECK(record["rows"].dump() == "{\"probes\":21}");
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

TEST_CASE("a cable that is pulled apart says which joint cannot be met") {
  const std::string forces = GENERATE("[gravity]\n", "");
  const TemporaryFolder folder;
  std::string text = forces + "[step]\nstep_s = 0.01\nsteps = 20\n";
  const auto body = [&](const std::string& name, double x, const std::string& rest) {
    text += "[[rigid_body]]\nname = \"" + name + "\"\nshape = \"sphere\"\nradius_m = 0.05\nposition_m = [" +
            std::to_string(x) + ", 0, 0]\n" + rest;
  };
  const auto joint = [&](const std::string& name, const std::string& a, const std::string& b, double x) {
    text += "[[joint]]\nname = \"" + name + "\"\nkind = \"ball\"\nbodies = [\"" + a + "\", \"" + b +
            "\"]\npoint_m = [" + std::to_string(x) + ", 0, 0]\n";
  };
  body("first", 0.5, "mass_kg = 1\n");
  body("second", 1.5, "mass_kg = 1\n");
  body("puller", 2, "held = \"moving\"\nvelocity_m_s = [1, 0, 0]\n");
  joint("wall", "world", "first", 0);
  joint("middle", "first", "second", 1);
  joint("pull", "second", "puller", 2);
  const auto scene = folder.write("cable.toml", text);
  const auto ran = run_program({"simulate", scene, "-o", folder.path});
  INFO(ran.err);
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Catch::Contains(", most of it of the point_joint of joint "));
  const auto report = record_of(folder.path)["report"];
  CHECK_THAT(ran.err, !Catch::Contains("not finite"));
  CHECK_THAT(report["worst_constraint"].get<std::string>(), Catch::StartsWith("the point_joint of joint "));
}

TEST_CASE("an interrupted simulation exits with 3 and leaves complete files of what was done") {
  const TemporaryFolder folder;
  const auto ran =
      run_program({"simulate", scenes / "pendulum.toml", "--set", "step.duration_s=1e6", "-o", folder.path},
                  "timeout --preserve-status -s INT 3");
  CHECK(ran.exit_code == 3);
  const auto record = record_of(folder.path);
  CHECK(record["status"] == "interrupted");
  CHECK(rows_of(folder.path / "probes.csv").size() == record["report"]["steps"].get<std::size_t>() + 2);
}

TEST_CASE("VTK frames hold the scene's cells and energies, and the collection names every frame") {
  const TemporaryFolder folder;
  const auto ran = run_program({"simulate", scenes / "cantilever.toml", "--set", "step.duration_s=0.03",
                                "--export", "vtk", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto frame = read_text(folder.path / "frames" / "frame_000003.vtu");
  CHECK_THAT(frame, Catch::Contains("NumberOfPoints=\"81\" NumberOfCells=\"192\""));
  CHECK_THAT(frame, Catch::Contains("Name=\"velocity\""));
  CHECK_THAT(frame, Catch::Contains("<FieldData>"));
  const auto probes = rows_of(folder.path / "probes.csv");
  for (const std::size_t column : {5, 6, 7}) {
    const std::string name = probes[0].at(column);
    CHECK(array_of(frame, name.substr(0, name.size() - 2)) == std::vector{std::stod(probes[4][column])});
  }
  CHECK_THAT(read_text(folder.path / "simulation.pvd"), Catch::Contains("frames/frame_000003.vtu"));
}

TEST_CASE("a simulation leaves nothing of an earlier one beside its record, and what is not its own") {
  const TemporaryFolder folder;
  const auto pendulum = scenes / "pendulum.toml";
  CHECK(run_program({"simulate", pendulum, "--set", "step.duration_s=0.05", "--check", "--export", "vtk",
                     "-o", folder.path})
            .exit_code == 0);
  folder.write("notes.csv", "mine");
  folder.write("frames/mine.vtu", "mine");
  CHECK(run_program({"simulate", pendulum, "--set", "step.duration_s=0.02", "-o", folder.path}).exit_code ==
        0);
  CHECK(files_in(folder.path) == std::vector<std::string>{"frames", "notes.csv", "probes.csv", "run.json"});
  CHECK(files_in(folder.path / "frames") == std::vector<std::string>{"mine.vtu"});
}

TEST_CASE("a simulation whose steps are judged by a reference tells how near they end") {
  const TemporaryFolder folder;
  const auto ran =
      run_program({"simulate", scenes / "incline.toml", "--judge", "every=40", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Catch::StartsWith("judged: 2 steps by cone_interior_point; they end within "));
  const auto judged = rows_of(folder.path / "judged.csv");
  REQUIRE(judged.size() == 3);
  CHECK(judged[0][10] == "nearest_error_of_scale");
  CHECK(judged[0][12] == "status");
  for (const auto* row : {&judged[1], &judged[2]}) {
    CHECK(row->at(12) == "ok");
    CHECK(std::stod(row->at(10)) <= 1e-9);  // the box sticks: nothing moves
  }
  const auto record = nlohmann::json::parse(read_text(folder.path / "run.json"));
  CHECK(record["judged"]["steps"] == 2);
  CHECK(record["rows"]["judged"] == 2);
}

TEST_CASE("methods are compared on a step with contact") {
  const TemporaryFolder folder;
  const auto ran = run_program({"compare", scenes / "stack.toml", "--method", "relaxation=direct",
                                "--at-step", "3", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto compared = rows_of(folder.path / "compare.csv");
  REQUIRE(compared.size() >= 3);
  CHECK(compared[1][4] == "cone_interior_point");
  CHECK(compared.back()[5] == "coulomb");
  CHECK(compared.back()[11] == "ok");
}

TEST_CASE("what met on the way of a step is compared with no judge") {
  const TemporaryFolder folder;
  folder.write(
      "hit.toml",
      "[[rigid_body]]\nname = \"a\"\nshape = \"sphere\"\nradius_m = 0.1\nmass_kg = 1\n"
      "velocity_m_s = [1000, 0, 0]\n[[rigid_body]]\nname = \"b\"\nshape = \"sphere\"\nradius_m = 0.1\n"
      "mass_kg = 1\nposition_m = [2, 0, 0]\n[contact]\ncontinuous = true\n"
      "[step]\nstep_s = 0.01\nduration_s = 0.01\n");
  const auto judged = run_program({"simulate", folder.path / "hit.toml", "--check", "--judge", "every=1",
                                   "-o", folder.path / "simulated"});
  CHECK_THAT(judged.out + judged.err,
             Catch::Contains("does not know, 1 of them") && Catch::Contains("none refuted"));
  const auto compared = run_program(
      {"compare", folder.path / "hit.toml", "--method", "relaxation=direct", "-o", folder.path / "compared"});
  CHECK(compared.exit_code == 1);
  CHECK_THAT(compared.err, Catch::Contains("is not compared: contacts act that met on the way"));
  CHECK(rows_of(folder.path / "compared" / "compare.csv").back()[11] == "skipped");
}

TEST_CASE("list prints names, as JSON if asked, and --help, --version and completion print to stdout") {
  const auto listed = nlohmann::json::parse(run_program({"list", "relaxations", "--json"}).out);
  CHECK(listed[0]["name"] == "gauss_seidel");
  CHECK(nlohmann::json::parse(run_program({"list", "--json"}).out).size() == 10);
  for (const auto* name :
       {"primal_newton  ", "ipopt  ", "cone_ipopt  ", "ode  ", "finer_steps  ", "closed_form  "})
    CHECK_THAT(run_program({"list", "references"}).out, Catch::Contains(name));
  CHECK_THAT(run_program({"completion"}).out,
             Catch::Contains("words=\"primal_newton ipopt cone_interior_point"));
  CHECK_THAT(run_program({"list", "scenes"}).out, Catch::Contains("pendulum.toml"));
  CHECK_THAT(run_program({"--version"}).out, Catch::Contains("pbdcheck ") && Catch::Contains("eigen 3."));
  for (const auto* command : {"list", "simulate", "compare", "run", "completion"}) {
    const auto ran = run_program({command, "--help"});
    CHECK(ran.exit_code == 0);
    CHECK_THAT(ran.out, Catch::Contains("--help"));
  }
  CHECK_THAT(run_program({"completion"}).out, Catch::Contains("complete -F _pbdcheck pbdcheck"));
}

TEST_CASE("what the command line does not allow is refused with option, value and what is allowed") {
  const std::string chain = scenes / "chain.toml";
  std::vector<std::pair<std::vector<std::string>, std::string>> refused{
      {{"run", "--all", "--threads", "2000000000"},
       "--threads: got `2000000000`; allowed: an integer from 1 to 1024"},
      {{"run", "--all", "--threads", "many"}, "--threads: got `many`; allowed: an integer from 1 to 1024"},
      {{"run", "--all", "--resume=7"}, "--resume: got `7`; allowed: only true"},
      {{"compare", chain, "--method", "outer=plain", "--at-step", "-1"},
       "--at-step: got `-1`; allowed: an integer from 0 to 2147483647"},
      {{"compare", chain, "--method", "outer=plain", "--at-step", "1.5"},
       "--at-step: got `1.5`; allowed: an"},
      {{"compare", chain, "--method", "outer=plain", "--reference", ""},
       "--reference: got ``; allowed: one of primal_newton, ipopt"},
      {{"compare", chain, "--method", "outer=plain", "--set", "chain.0.damping_s=0.1", "--reference",
        "primal_newton"},
       "effects[1] damping: got damping; allowed: none: this judge knows elastic forces only"},
      {{"compare", scenes / "incline.toml", "--method", "outer=plain", "--reference", "primal_newton"},
       "--reference primal_newton: got a scene with contact; allowed: cone_interior_point, cone_ipopt: this "
       "reference solves equations"},
      {{"simulate", chain, "--judge", "0"}, "--judge: got `0`; allowed: every=N with N = 1, 2, ..."},
      {{"simulate", chain, "--judge", "every=0"}, "--judge: got `every=0`; allowed: every=N"},
      {{"simulate", chain, "--judge", ""}, "--judge: got ``; allowed: every=N"},
      {{"simulate", chain, "--judge", "every=1000000"},
       "--judge: got every=1000000; allowed: 1 to 500 steps"},
      {{"simulate", chain, "--judge", "every=2x"}, "--judge: got `every=2x`; allowed: every=N"},
      {{"simulate", chain, "--judge", "every=2", "--set", "method.integrator=symplectic_euler"},
       "--judge: method.integrator: got `symplectic_euler`; allowed: implicit_euler, newmark, bdf2, "
       "generalised_alpha, midpoint"},
      {{"simulate", scenes / "incline.toml", "--judge", "every=2", "--set", "method.friction=box"},
       "method.friction: got `box`; allowed: coulomb, cone"},
      {{"compare", scenes / "incline.toml", "--method", "rival=newton", "--reference", "ipopt"},
       "--reference ipopt: got a scene with contact"},
      {{"compare", chain, "--method", "outer=plain", "--at-step", "100000"},
       "--at-step: got 100000; allowed: 0 to 499: the scene has 500 steps"},
      {{"compare", chain, "--method", "outer=plain", "--set", "method.integrator=symplectic_euler"},
       "--set method.integrator: got `symplectic_euler`; allowed: implicit_euler, newmark, bdf2"},
      {{"compare", chain, "--method", "outer=plain integrator=bdf2"},
       "--method integrator: got `bdf2`; allowed: implicit_euler, which leads to the step: each integrator "
       "has"},
      {{"compare", chain, "--method", "outer=plain", "--method", "integrator=implicit_euler", "--set",
        "method.integrator=bdf2"},
       "--method: got `integrator=implicit_euler`; allowed: the integrator of `outer=plain`"},
      {{"compare", chain, "--method", "outer=plain", "--set", "method.integrator=bdf2", "--reference",
        "ipopt"},
       "--reference ipopt: got steps of `bdf2`; allowed: cone_interior_point, cone_ipopt"},
      {{"compare", chain, "--method", "outer=plain", "--method", "outer=plain"},
       "--method: got `outer=plain`, the same as `outer=plain`; allowed: methods that differ"},
      {{"simulate", chain, "-o", ""}, "-o: got ``, no directory"},
      {{"simulate", chain, "--export", ""}, "--export: got ``; allowed: only vtk"},
      {{"list", "--json=abc"}, "--json: got `abc`; allowed: only true"}};
  const std::vector<std::pair<std::string, std::string>> refused_methods{
      {"", ": got ``; allowed: \"KEY=VALUE ...\""},
      {"tolerance=1e-3 tolerance=1e-6",
       " tolerance: got `tolerance=1e-3 tolerance=1e-6`; allowed: each key once"},
      {"relaxation", ": got `relaxation`; allowed: KEY=VALUE, as in relaxation=jacobi"},
      {"rival=newtown", " rival: got `newtown`; allowed: one of newton, vbd, xpbd; did you mean `newton`?"},
      {"rival", " rival: got ``; allowed: one of newton, vbd, xpbd"},
      {"rival=newton relaxation=direct",
       " relaxation: got `relaxation=direct` for a rival; allowed: tolerance, max_outer"},
      {"rival=newton rival=newton", " rival: got"},
      {"rival=newton tolerance=-1", " tolerance: got -1; allowed: "},
      {"rival=newton", " \"rival=newton\": newton: anchor compliance[0]: got 0; allowed: a number > 0"}};
  for (const auto& [method, message] : refused_methods)
    refused.push_back({{"compare", chain, "--method", method}, "--method" + message});
  for (const auto& [arguments, message] : refused) {
    INFO(message);
    const auto ran = run_program(arguments);
    CHECK(ran.exit_code == 2);
    CHECK_THAT(ran.err, Catch::StartsWith("error: " + message));
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
  }
}
