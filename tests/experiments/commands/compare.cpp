// `pbdcheck compare`, as a user runs it.
#include <catch2/catch.hpp>

#include "mistakes.h"
#include "results.h"

using namespace pbdcheck::test;

TEST_CASE("compare writes the reference's row and every iterate of every method, with errors that fall") {
  const TemporaryFolder folder;
  const auto ran = run_program({"compare", scenes / "pendulum.toml", "--at-step", "30", "--method",
                                "relaxation=direct", "--method", "relaxation=jacobi max_sweeps=50",
                                "--reference", "primal_newton", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto rows = rows_of(folder.path / "compare.csv");
  CHECK(rows[0] == std::vector<std::string>{"scene", "step_s", "integrator", "outer", "relaxation",
                                            "friction", "outer_iterations", "sweeps", "row_updates", "wall_s",
                                            "error", "status", "reason", "method"});
  CHECK(rows[1][3] == "judge");
  CHECK(rows[1][4] == "primal_newton");
  REQUIRE(rows.size() > 6);
  CHECK(record_of(folder.path)["rows"]["compare"] == rows.size() - 1);
  CHECK(rows[1][13] == "primal_newton");
  CHECK(rows[2][13] == "relaxation=direct");
  CHECK(rows.back()[13] == "relaxation=jacobi max_sweeps=50");
  for (std::size_t i = 2; i < rows.size(); ++i) {
    CHECK(rows[i][11] == "ok");
    const bool last = i + 1 == rows.size() || rows[i + 1][4] != rows[i][4];
    if (last) CHECK(std::stod(rows[i][10]) < 1e-8);
  }
  CHECK(rows[2][4] == "direct");
  CHECK(rows.back()[4] == "jacobi");
}

// The rotor's places move, its centre does not: an iterate differs from the reference in orientation alone.
TEST_CASE("compare sees the orientation of bodies") {
  const TemporaryFolder folder;
  const auto rotor = folder.write(
      "rotor.toml",
      "[[rigid_body]]\nname = \"rotor\"\nmass_kg = 2\ninertia_kg_m2 = [0.01, 0.02, 0.025]\n"
      "angular_velocity_rad_s = [10, 20, 5]\n[gyroscopic]\n[[joint]]\nkind = \"angle\"\nbodies = "
      "[\"world\", \"rotor\"]\naxis = [0, 0, 1]\nstiffness_n_m_per_rad = 50\n[step]\nstep_s = 0.02\nsteps "
      "= 3\n");
  CHECK(run_program({"compare", rotor, "--method", "outer=plain", "-o", folder.path}).exit_code == 0);
  const auto rows = rows_of(folder.path / "compare.csv");
  REQUIRE(rows.size() > 4);
  CHECK(std::stod(rows[2][10]) > 1e-3);
  CHECK(std::stod(rows.back()[10]) < 1e-8);
  CHECK(std::stod(rows.back()[10]) > 0);
}

// A chain is hard; the blocks are damped and touch; joints have limits.
TEST_CASE("compare takes each integrator's step, by what it carries from the steps before") {
  const TemporaryFolder folder;
  for (const std::string scene : {"chain.toml", "soft_cubes.toml", "ragdoll.toml"})
    for (const std::string integrator : {"newmark", "bdf2", "generalised_alpha", "midpoint"}) {
      if (integrator == "midpoint" && scene != "chain.toml") continue;  // it allows no contact
      INFO(scene << " " << integrator);
      const auto ran = run_program({"compare", scenes / scene, "--set", "method.integrator=" + integrator,
                                    "--set", "method.tolerance=1e-10", "--at-step", "5", "--method",
                                    "outer=auto", "--method", "outer=proximal", "-o", folder.path});
      CHECK(ran.exit_code == 0);
      const auto rows = rows_of(folder.path / "compare.csv");
      REQUIRE(rows.size() > 2);
      CHECK(rows[1][2] == integrator);
      for (std::size_t i = 2; i < rows.size(); ++i)
        if (i + 1 == rows.size() || rows[i + 1][13] != rows[i][13]) CHECK(std::stod(rows[i][10]) < 1e-8);
    }
}

TEST_CASE("compare measures a rival as it does a method") {
  const TemporaryFolder folder;
  const auto spring = folder.write(
      "spring.toml",
      "[gravity]\n[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = inf\n[[particle]]\nposition_m = [1, 0, 0]\n"
      "mass_kg = 1\n[[distance]]\nnodes = [0, 1]\nstiffness_n_per_m = 100\n[step]\nstep_s = 0.05\nsteps = "
      "9\n");
  const auto ran = run_program({"compare", spring, "--at-step", "5", "--method", "outer=quasi_newton",
                                "--method", "rival=newton tolerance=1e-10 max_outer=50", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto rows = rows_of(folder.path / "compare.csv");
  REQUIRE(rows.size() > 4);
  CHECK(rows.back()[3] == "rival");
  CHECK(rows.back()[4] == "newton");
  CHECK(rows.back()[11] == "ok");
  CHECK(std::stod(rows.back()[10]) < 1e-8);
  CHECK(std::stod(rows.back()[9]) > 0);
  const auto spent = run_program(
      {"compare", spring, "--at-step", "5", "--method", "rival=newton max_outer=1", "-o", folder.path});
  CHECK(spent.exit_code == 1);
  CHECK(rows_of(folder.path / "compare.csv").back()[12] == "iterations spent");
}

TEST_CASE("compare skips its methods with a reason where the reference fails, and records what it did") {
  const TemporaryFolder folder;
  const auto scene = folder.write(
      "torn.toml",
      "[[particle]]\nposition_m = [0, 0, 0]\nmass_kg = 1\n[[particle]]\nposition_m = [1, 0, 0]\nmass_kg = "
      "1\n[[distance]]\nnodes = [0, 1]\nrest_length_m = 1\n[[distance]]\nnodes = [0, 1]\nrest_length_m = "
      "2\n[step]\nstep_s = 0.01\nsteps = 1\n");
  const auto failed = run_program({"compare", scene, "--method", "relaxation=direct", "--method",
                                   "relaxation=jacobi", "-o", folder.path});
  CHECK(failed.exit_code == 1);
  const auto rows = rows_of(folder.path / "compare.csv");
  REQUIRE(rows.size() == 1 + 3);
  CHECK(rows[1][10] == "nan");
  CHECK(rows[1][11] == "not_converged");
  for (const int i : {2, 3}) {
    CHECK(rows[static_cast<std::size_t>(i)][10] == "nan");
    CHECK(rows[static_cast<std::size_t>(i)][11] == "skipped");
    CHECK_THAT(rows[static_cast<std::size_t>(i)][12], Catch::Contains("reference primal_newton"));
  }
  CHECK(record_of(folder.path)["status"] == "failed");

  CHECK(run_program({"compare", scenes / "pendulum.toml", "--method", "relaxation=direct", "-o", folder.path})
            .exit_code == 0);
  const auto record = record_of(folder.path);
  CHECK(record["status"] == "complete");
  CHECK(record["settings"]["compared"][0] == "relaxation=direct");
  CHECK(record["settings"]["reference"] == "primal_newton");
  CHECK_FALSE(record.contains("reason"));
}

TEST_CASE("compare says where a scene states what its references do not solve") {
  const TemporaryFolder folder;
  const auto scene =
      folder.write("limits.toml",
                   "[step]\nstep_s = 0.01\nsteps = 2\n[method]\nintegrator = \"symplectic_euler\"\n"
                   "[[rigid_body]]\nname = \"arm\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n"
                   "[[joint]]\nkind = \"angle\"\nbodies = [\"world\", \"arm\"]\naxis = [0, 0, 1]\n");
  check_refused(run_program({"compare", scene, "--method", "outer=plain"}),
                {"error: " + scene.string() + ":5: method.integrator: got `symplectic_euler`"});
  check_refused(run_program({"compare", scene, "--method", "outer=plain", "--reference", "primal_newton",
                             "--set", "joint.0.max_angle_rad=1"}),
                {"error: " + scene.string() + ":10: joint.0: got a limit or a limited force"});
}
