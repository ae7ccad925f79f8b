// Contact problems from files: what was written is read, in every form, and mistakes are named.
#include "cones/cone_file.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "cone_interior_point.h"
#include "mistakes.h"
#include "planted_family.h"
#include "program.h"
#include "siconos_text.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using namespace pbd::reference;

namespace {

void check_same(const ConeProblem& read, const ConeProblem& written) {
  CHECK((MatrixXd(read.delassus) - MatrixXd(written.delassus)).norm() < 1e-15 * written.delassus.norm());
  CHECK(read.free_velocity == written.free_velocity);
  CHECK(read.friction == written.friction);
}

}  // namespace

TEST_CASE("a problem survives writing and reading in each form") {
  const TemporaryFolder folder;
  const PlantedCone p = stack_problem();
  const MatrixXd w = p.problem.delassus;
  ConeSolution solution;
  solution.impulse = p.impulse, solution.velocity = p.velocity;
  write_cone_file(folder.path / "p.hdf5", p.problem, solution);
  check_same(read_cone_file(folder.path / "p.hdf5").problem, p.problem);
  check_same(
      read_cone_file(folder.write("d.dat", dense(w, p.problem.free_velocity, p.problem.friction))).problem,
      p.problem);
  for (const bool by_rows : {false, true}) {
    const auto file = read_cone_file(
        folder.write("b.dat", blocks(w, p.problem.free_velocity, p.problem.friction, by_rows)));
    check_same(file.problem, p.problem);
    CHECK_THAT(file.form, Catch::EndsWith(by_rows ? "row by row" : "column by column"));
  }
}

TEST_CASE("Siconos' sparse matrices are read in the six digits that it prints, in which W is semidefinite") {
  const auto problems = experiments_folder / "problems";
  ConeProblem cube = read_cone_file(problems / "sliding_cube.dat").problem;
  cube.delassus /= 3;  // what Siconos wrote is of 3 kg
  for (const bool by_columns : {false, true}) {
    const auto written = problems / (by_columns ? "sliding_cube_columns.dat" : "sliding_cube_triplets.dat");
    CHECK_THAT(read_text(written), Catch::StartsWith(sparse_head(cube.delassus, by_columns)));
    const ConeFile file = read_cone_file(written);
    const MatrixXd error = MatrixXd(file.problem.delassus) - MatrixXd(cube.delassus);
    CHECK((error.array().abs() <= 5e-6 * MatrixXd(cube.delassus).array().abs()).all());
    CHECK(file.problem.free_velocity == cube.free_velocity);
    CHECK(file.problem.friction == cube.friction);
    CHECK(file.semidefinite);
    CHECK(file.rounding == 5e-6);
  }
}

TEST_CASE("W of any rank is semidefinite in six digits, but not with an eigenvalue below their rounding") {
  const TemporaryFolder folder;
  for (int seed = 1; seed <= planted_seeds; ++seed) {
    const ConeProblem singular = draw_planted("redundant", FrictionLaw::cone, seed).problem;
    const VectorXd &q = singular.free_velocity, &mu = singular.friction;
    const MatrixXd w = singular.delassus;
    CHECK(read_cone_file(folder.write("w.dat", sparse(w, q, mu, false))).semidefinite);
    const double rounding = 5e-6 * w.cwiseAbs().rowwise().sum().maxCoeff();
    MatrixXd saddle = w;
    saddle.diagonal().array() -= 3 * rounding;  // of the numbers, of what is allowed, and as much again
    CHECK_FALSE(read_cone_file(folder.write("w.dat", sparse(saddle, q, mu, false))).semidefinite);
  }
}

TEST_CASE("Siconos' large blocks are read, and what may stand behind mu") {
  const TemporaryFolder folder;
  const PlantedCone p = stack_problem();
  const MatrixXd w = p.problem.delassus;
  const VectorXd &q = p.problem.free_velocity, &mu = p.problem.friction;
  REQUIRE(mu.size() % 2 == 0);
  check_same(read_cone_file(folder.write("b.dat", blocks(w, q, mu, false, 6))).problem, p.problem);
  const std::string solution = text(p.impulse), twice = solution + solution;
  for (const std::string& tail : {std::string("0\n"), "1\n" + solution, solution, twice, "1\n" + twice})
    check_same(read_cone_file(folder.write("t.dat", dense(w, q, mu) + tail)).problem, p.problem);
}

TEST_CASE("mistakes in problem files are named, with exit code 2") {
  const TemporaryFolder folder;
  const MatrixXd w = MatrixXd::Identity(3, 3);
  const VectorXd q = VectorXd::Ones(3), mu = VectorXd::Ones(1);
  MatrixXd indefinite = w;
  indefinite(2, 2) = -1e-3;
  const std::string good = dense(w, q, mu);
  const std::vector<Mistake> mistakes{
      {"", {"end of the file", "dimension"}},
      {"scene = 1", {"`scene`", "a number"}},
      {"2\n1\n0\n2\n2\n", {"dimension = 2"}},
      {"\x80\xfe\n", {"got `??` for the dimension"}},
      {"3\n1\n3\n3\n3\n", {"storage", "from 0 to 2"}},
      {"3\n1\n2\n3\n3\n1\nCSparse nnz: 1\n0 3 : 1\n", {"bad.dat:8", "a column = 3"}},
      {"3\n1\n2\n3\n3\n1\nCSparse nnz: 2\n0 2 : 1\n0 2 : 5\n",
       {"bad.dat:9", "another entry 5 in row 0 and column 2", "allowed: one"}},
      {"3\n1\n2\n3\n3\n2\nCSparse nnz: 2, 1-norm: 6\ncol 0 : locations 0 to 1\n2 : 1\n2 : 5\n",
       {"bad.dat:10", "another entry 5 in row 2 and column 0", "allowed: one"}},
      {"3\n1\n0\n3\n3\n1 0 0\n", {"bad.dat:6", "the number of rows, again = 1"}},
      {"3\n1\n0\n3\n4\n", {"columns = 4", "allowed: 3"}},
      {"3\n1000000000\n0\n3\n3\n", {"contacts = 1"}},
      {good.substr(0, good.size() / 2), {"end of the file", "W"}},
      {good + " 7", {"1 numbers behind mu", "a flag 0 or 1", "or a flag and a solution"}},
      {good + " 1 2", {"2 numbers behind mu"}},
      {"3\n1\n\n0\n3\nthree\n", {"bad.dat:6: got `three` for the number of columns"}},
      {good.substr(0, good.find_last_of('1')) + "0." + std::string(3, '\0'), {"for mu", "a number"}},
      {"3\n1000\n0\n3000\n3000\n1", {"bad.dat:2: got the number of contacts = 1000 in a file of"}},
      {"3\n4\n0\n12\n12\n12 12\n1 2 3\n", {"bad.dat:6: got 12 x 12 numbers of W in a file of 24 characters"}},
      {dense(w, q, -mu), {"mu = -1 at contact 0", "from 0 to 1e+07"}},
      {dense(w, q, mu * 1e20), {"mu = ", "from 0 to 1e+07"}},
      {dense(w, q * 1e101, mu), {"bad.dat:8", "for q", "at most 1e+100"}},
      {dense(w, VectorXd::Constant(3, std::nan("")), mu), {"bad.dat:8", "`nan` for q"}},
      {dense(w * std::nan(""), q, mu), {"bad.dat:7", "nan` for W"}},
  };
  for (const auto& mistake : mistakes) {
    INFO(mistake.text);
    const auto file = folder.write("bad.dat", mistake.text);
    auto parts = mistake.message;
    parts.insert(parts.end(), {"bad.dat:", ": got "});
    check_refused(run_program({"cone", file.string()}), parts);
  }
  check_refused(run_program({"cone", (folder.path / "none").string()}), {"none: got no file"});
  const auto fine = folder.write("good.dat", good).string();
  const auto saddle = folder.write("saddle.dat", dense(indefinite, q, mu)).string();
  check_refused(run_program({"cone", saddle, "--law", "cone"}), {"saddle.dat", "not positive semidefinite"});
  CHECK_THAT(run_program({"cone", saddle}).err,
             Catch::Contains("warning") && Catch::Contains("semidefinite"));
  check_refused(run_program({"cone", fine, "--law", "disc"}), {"cone, coulomb, box"});
  check_refused(run_program({"cone", fine, "--law", "box"}), {"box", "one of coulomb, cone"});
  check_refused(run_program({"cone", fine, "-o", fine}), {"another file than the problem"});
  const auto link = folder.path / "link";
  std::filesystem::create_symlink("/dev/null", link);  // a device, safe from being replaced
  check_refused(run_program({"cone", fine, "-o", link.string()}), {"cannot be written"});
  check_refused(run_program({"cone", fine, "--relaxation", "cone_ipop"}), {"did you mean `cone_ipopt`"});
  check_refused(run_program({"cone", fine, "--tolerance", "0"}), {"--tolerance", "a number > 0"});
  check_refused(run_program({"cone", fine, "-o", folder.path.string()}), {"cannot be written"});
}

TEST_CASE("numbers whose squares vanish are measured all the same") {
  const ConeProblem problem{MatrixXd::Identity(3, 3).sparseView(), Eigen::Vector3d(-1e-165, 1e-165, 0),
                            VectorXd::Ones(1)};
  CHECK(std::abs(measure_cone(problem, FrictionLaw::cone, Eigen::Vector3d::Zero()).natural_residual - 1) <
        1e-12);
}

TEST_CASE("one contact that separates is left alone, however much friction there is") {
  const ConeProblem problem{MatrixXd::Identity(3, 3).sparseView(), Eigen::Vector3d(1, 1, 0),
                            VectorXd::Constant(1, 1e4)};
  const ConeSolution found = cone_interior_point(problem, FrictionLaw::coulomb, 1e-8);
  CHECK(found.outcome == Outcome::ok);
  CHECK(found.impulse.isZero(0));
}

TEST_CASE("HDF5 files cut short anywhere are refused, never a crash") {
  const TemporaryFolder folder;
  const PlantedCone p = stack_problem();
  ConeSolution solution;
  solution.impulse = p.impulse, solution.velocity = p.velocity;
  write_cone_file(folder.path / "p.hdf5", p.problem, solution);
  const std::string whole = read_text(folder.path / "p.hdf5");
  for (int part = 1; part < 16; ++part) {
    const auto cut =
        folder.write("cut.hdf5", whole.substr(0, whole.size() * static_cast<std::size_t>(part) / 16));
    CHECK_THROWS_WITH(read_cone_file(cut), Catch::Contains("cut.hdf5: got "));
  }
}
