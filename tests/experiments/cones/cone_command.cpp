// The command cone: what it solves, prints and writes.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cones/cone_file.h"
#include "linear/linear_names.h"
#include "planted_family.h"
#include "program.h"
#include "siconos_text.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using namespace pbd::reference;

namespace {

VectorXd impulse_of(const nlohmann::json& answer) {
  const auto all = answer["impulse"].get<std::vector<double>>();
  return Eigen::Map<const VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace

TEST_CASE("an unsymmetric W is solved as it is under Coulomb's law, and not certified under the convex one") {
  const TemporaryFolder folder;
  const PlantedCone p = stack_problem();
  MatrixXd w = p.problem.delassus;
  const double part = GENERATE(1e-3, 0.1);
  w.diagonal().array() += w(0, 0);  // the planted one is singular: the rest would make it indefinite
  w(0, 3) += part * w(0, 0);
  const ConeProblem given{w.sparseView(), p.problem.free_velocity, p.problem.friction};
  const auto path = folder.write("w.dat", dense(w, p.problem.free_velocity, p.problem.friction)).string();
  const ConeFile file = read_cone_file(path);
  CHECK(MatrixXd(file.problem.delassus) == w);
  CHECK(file.asymmetry == Approx(part * w(0, 0) * std::sqrt(2) / w.norm()));
  for (const auto* law : {"coulomb", "cone"}) {
    const bool convex = law == std::string("cone");
    const auto solved = folder.path / law;
    const auto ran = run_program({"cone", path, "--law", law, "--json", "-o", solved.string()});
    const auto json = nlohmann::json::parse(ran.out);
    const VectorXd r = impulse_of(json);
    const auto of = convex ? FrictionLaw::cone : FrictionLaw::coulomb;
    const double residual = measure_cone(given, of, r).natural_residual;
    const double symmetric_residual = measure_cone(symmetric(given), of, r).natural_residual;
    CHECK(json["asymmetry"].get<double>() == Approx(file.asymmetry));
    CHECK(json["natural_residual"].get<double>() == Approx(residual).margin(1e-12));
    CHECK(json["natural_residual_symmetric"].get<double>() == Approx(symmetric_residual).margin(1e-12));
    CHECK((convex ? symmetric_residual : residual) <= 1e-8);
    const std::string how = convex ? "solved with its symmetric part" : "solved as it is";
    CHECK_THAT(ran.err, Catch::Contains(how));
    CHECK_THAT(json["warnings"].at(0).get<std::string>(), Catch::EndsWith(how));
    CHECK(ran.exit_code == (convex ? 1 : 0));
    CHECK(json["status"] == (convex ? "not_converged" : "ok"));
    CHECK(json["reason"].get<std::string>().starts_with("W is unsymmetric by ") == convex);
    CHECK(std::filesystem::exists(solved) != convex);
    if (!convex) CHECK(MatrixXd(read_cone_file(solved).problem.delassus) == w);
  }
}

TEST_CASE(
    "the convex law's answer to an unsymmetric W is ok, and written with W as given, where it is near "
    "enough") {
  const TemporaryFolder folder;
  const Eigen::Vector3d q(-1, 0.5, 0.2);
  const VectorXd mu = VectorXd::Ones(1);
  MatrixXd w = 2 * MatrixXd::Identity(3, 3);
  w(0, 1) = 1, w(1, 0) = 1.00001;  // the sixth digit, and what it rounds to
  const auto solved = (folder.path / "solved.hdf5").string();
  const auto exact = folder.write("exact.dat", dense(w, q, mu)).string();
  const auto digits = folder.write("digits.dat", sparse(w, q, mu, true)).string();
  const auto strict = run_program({"cone", exact, "--law", "cone"});
  CHECK(strict.exit_code == 1);
  CHECK_THAT(strict.err, Catch::Contains("W is unsymmetric by 3."));
  for (const auto& [path, tolerance] : {std::pair(exact, "1e-5"), {digits, "1e-8"}}) {
    const auto ran =
        run_program({"cone", path, "--law", "cone", "--json", "--tolerance", tolerance, "-o", solved});
    CHECK(ran.exit_code == 0);
    CHECK_THAT(ran.err, Catch::Contains("warning: ") && Catch::Contains("solved with its symmetric part"));
    CHECK(nlohmann::json::parse(ran.out)["natural_residual"].get<double>() > 1e-8);
    CHECK(MatrixXd(read_cone_file(solved).problem.delassus) == w);
  }
}

TEST_CASE("cone prints one JSON object and writes what it solved") {
  const TemporaryFolder folder;
  const PlantedCone p = stack_problem();
  ConeSolution nothing;
  nothing.impulse = nothing.velocity = VectorXd::Zero(p.impulse.size());
  write_cone_file(folder.path / "p.hdf5", p.problem, nothing);
  const auto solved = (folder.path / "solved.hdf5").string();
  const auto ran = run_program({"cone", (folder.path / "p.hdf5").string(), "--json", "-o", solved});
  CHECK(ran.exit_code == 0);
  CHECK(ran.err.empty());
  const auto json = nlohmann::ordered_json::parse(ran.out);
  std::string keys;
  for (const auto& [key, value] : json.items()) keys += key + " ";
  CHECK(keys ==
        "status reason form warnings law relaxation contacts natural_residual natural_residual_symmetric "
        "asymmetry "
        "gap "
        "feasibility objective sweeps wall_s velocity impulse ");
  CHECK(json["status"] == "ok");
  CHECK(json["law"] == "coulomb");
  CHECK(measure_cone(p.problem, FrictionLaw::coulomb, impulse_of(json)).natural_residual <= 1e-8);
  CHECK(MatrixXd(read_cone_file(solved).problem.delassus) == MatrixXd(p.problem.delassus));
}

TEST_CASE("cone fails with exit code 1 where no impulse is within the tolerance") {
  const TemporaryFolder folder;
  const auto fixed =
      folder.write("fixed.dat", dense(MatrixXd::Zero(3, 3), Eigen::Vector3d(-1, 0, 0), VectorXd::Ones(1)));
  const auto ran = run_program({"cone", fixed.string()});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Catch::Contains("fixed.dat: ") && Catch::Contains("asked for 1e-08"));
}

TEST_CASE("each of the solver's relaxations solves a problem from a file") {
  const auto cube = (experiments_folder / "problems" / "sliding_cube.dat").string();
  for (const auto relaxation : pbd::general_solver_names())
    for (const auto* law : {"cone", "coulomb", "box"}) {
      const auto ran =
          run_program({"cone", cube, "--law", law, "--relaxation", std::string(relaxation), "--json"});
      CHECK(ran.exit_code == 0);
      const auto json = nlohmann::json::parse(ran.out);
      CHECK(json["relaxation"] == std::string(relaxation));
      CHECK(json["natural_residual"].get<double>() <= 1e-8);
      CHECK(json["sweeps"].get<int>() > 0);
    }
}

TEST_CASE("the problems that come with the program are solved by the judges' laws") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(experiments_folder / "problems"))
    if (entry.path().extension() != ".md")
      for (const auto* law : {"cone", "coulomb"}) {
        ++files;
        CHECK(run_program({"cone", entry.path().string(), "--law", law}).exit_code == 0);
      }
  CHECK(files == 10);
}

// Newton's method ends in minima of the residual that are no solutions; a path of smoothed laws leads past
// them.
TEST_CASE("direct solves the contacts of a cloth that slides on a ball") {
  const auto cloth = experiments_folder / "problems" / "sliding_cloth.dat";
  const auto ran = run_program({"cone", cloth.string(), "--relaxation", "direct", "--tolerance", "1e-12"});
  CHECK(ran.exit_code == 0);
}
