// FCLIB's files against its own library: what that writes is read, and it reads what is written.
extern "C" {
#include <fclib.h>
}

#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cones/cone_file.h"
#include "dense.h"
#include "planted_family.h"
#include "program.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Triplets as CSparse has them, p the columns, or as fclib.h says, p the rows.
enum class Storage { triplets_of_csparse, triplets_of_header, columns, rows };

/// A matrix as the library has it, with the arrays it points to.
struct Stored {
  std::vector<int> p, i;
  std::vector<double> x;
  fclib_matrix matrix{};

  Stored(const MatrixXd& full, Storage storage) {
    const bool by_rows = storage == Storage::rows, compressed = by_rows || storage == Storage::columns;
    const MatrixXd lines = by_rows ? MatrixXd(full.transpose()) : full;  // its columns are what is compressed
    for (int line = 0; line < lines.cols(); ++line) {
      if (compressed) p.push_back(static_cast<int>(x.size()));
      for (int place = 0; place < lines.rows(); ++place) {
        if (lines(place, line) == 0) continue;
        x.push_back(lines(place, line));
        i.push_back(storage == Storage::triplets_of_header ? line : place);
        if (!compressed) p.push_back(storage == Storage::triplets_of_header ? place : line);
      }
    }
    if (compressed) p.push_back(static_cast<int>(x.size()));
    matrix.nzmax = static_cast<int>(x.size());
    matrix.m = static_cast<int>(full.rows());
    matrix.n = static_cast<int>(full.cols());
    matrix.nz = by_rows ? -2 : compressed ? -1 : matrix.nzmax;
    matrix.p = p.data();
    matrix.i = i.data();
    matrix.x = x.data();
  }
};

fclib_local local_problem(Stored& w, VectorXd& q, VectorXd& mu) {
  fclib_local problem{};
  problem.W = &w.matrix;
  problem.q = q.data();
  problem.mu = mu.data();
  problem.spacedim = 3;
  return problem;
}

/// What is read of a problem that the library writes.
template <class Problem>
ConeFile through_fclib(Problem& problem, int (*write)(Problem*, const char*)) {
  const TemporaryFolder folder;
  const auto path = folder.path / "p.hdf5";
  REQUIRE(write(&problem, path.c_str()) == 1);
  return read_cone_file(path);
}

void check_close(const MatrixXd& found, const MatrixXd& expected) {
  REQUIRE(found.rows() == expected.rows());
  CHECK((found - expected).norm() <= 1e-14 * expected.norm());
}

}  // namespace

TEST_CASE("local problems that FCLIB writes are read by columns, by rows and as CSparse's triplets") {
  const auto p = stack_problem();
  MatrixXd w = p.problem.delassus;
  w(0, 1) *= 1 + 1e-3;  // so that rows are no columns
  VectorXd q = p.problem.free_velocity, mu = p.problem.friction;
  for (const Storage storage : {Storage::triplets_of_csparse, Storage::columns, Storage::rows}) {
    Stored stored(w, storage);
    fclib_local problem = local_problem(stored, q, mu);
    const ConeFile file = through_fclib(problem, fclib_write_local);
    check_close(file.problem.delassus, w);
    CHECK(file.problem.free_velocity == q);
    CHECK(file.problem.friction == mu);
    const bool triplets = storage == Storage::triplets_of_csparse;
    CHECK(file.form ==
          std::string("FCLIB local") + (triplets ? ", triplets of /fclib_local/W with p as columns" : ""));
    CHECK(file.warnings.size() == (triplets ? 1 : 0));
  }
}

TEST_CASE("a square W of triplets in the header's order is read transposed, of which a warning tells") {
  const TemporaryFolder folder;
  const auto p = stack_problem();
  VectorXd q = p.problem.free_velocity, mu = p.problem.friction;
  MatrixXd w = p.problem.delassus;
  Stored symmetric(w, Storage::triplets_of_header);
  fclib_local problem = local_problem(symmetric, q, mu);
  const ConeFile same = through_fclib(problem, fclib_write_local);
  check_close(same.problem.delassus, w);
  CHECK(same.warnings.empty());
  w(0, 1) += 1e-3;
  Stored unsymmetric(w, Storage::triplets_of_header);
  problem = local_problem(unsymmetric, q, mu);
  check_close(through_fclib(problem, fclib_write_local).problem.delassus, w.transpose());
  const auto path = (folder.path / "p.hdf5").string();
  REQUIRE(fclib_write_local(&problem, path.c_str()) == 1);
  const auto ran = run_program({"cone", path, "--json"});
  const std::string told = "the triplets of /fclib_local/W fit as CSparse has them, p the columns, and as";
  CHECK_THAT(ran.err, Catch::Contains("warning: " + path + ": " + told));
  const auto json = nlohmann::json::parse(ran.out);
  CHECK_THAT(json["warnings"].at(0).get<std::string>(), Catch::StartsWith(told));
  CHECK(json["form"] == "FCLIB local, triplets of /fclib_local/W with p as columns");
}

TEST_CASE("global problems that FCLIB writes are condensed, whichever way H is stored") {
  constexpr int unknowns = 12, rows = 6;
  MatrixXd m = MatrixXd::Identity(unknowns, unknowns), h(unknowns, rows);
  VectorXd f(unknowns), w(rows), mu = VectorXd::Constant(rows / 3, 0.4);
  for (int i = 0; i < unknowns; ++i) {
    m(i, i) = 2 + i % 3;
    f(i) = std::sin(i);
    for (int j = 0; j < rows; ++j) h(i, j) = std::cos(3 * i + 7 * j);
  }
  for (int j = 0; j < rows; ++j) w(j) = 0.1 * j;
  const MatrixXd inverse = m.diagonal().cwiseInverse().asDiagonal();
  for (const Storage storage :
       {Storage::triplets_of_csparse, Storage::triplets_of_header, Storage::columns, Storage::rows}) {
    Stored stored_m(m, Storage::columns), stored_h(h, storage);
    fclib_global problem{};
    problem.M = &stored_m.matrix;
    problem.H = &stored_h.matrix;
    problem.f = f.data();
    problem.w = w.data();
    problem.mu = mu.data();
    problem.spacedim = 3;
    const ConeFile file = through_fclib(problem, fclib_write_global);
    check_close(file.problem.delassus, pbd::reference::congruence(inverse, h));
    check_close(file.problem.free_velocity, w + h.transpose() * (inverse * f));
    CHECK(file.warnings.empty());  // no other way fits
  }
}

TEST_CASE("FCLIB reads what is written") {
  const TemporaryFolder folder;
  const auto p = stack_problem();
  pbd::reference::ConeSolution solution;
  solution.impulse = p.impulse, solution.velocity = p.velocity;
  const auto path = folder.path / "p.hdf5";
  write_cone_file(path, p.problem, solution);
  fclib_local* problem = fclib_read_local(path.c_str());
  fclib_solution* stored = fclib_read_solution(path.c_str());
  REQUIRE(problem != nullptr);
  REQUIRE(stored != nullptr);
  const auto rows = p.impulse.size();
  REQUIRE(problem->W->nz == -1);
  REQUIRE(problem->W->m == rows);
  MatrixXd w = MatrixXd::Zero(rows, rows);
  for (int j = 0; j < rows; ++j)
    for (int k = problem->W->p[j]; k < problem->W->p[j + 1]; ++k) w(problem->W->i[k], j) = problem->W->x[k];
  check_close(w, p.problem.delassus);
  CHECK(Eigen::Map<VectorXd>(problem->q, rows) == p.problem.free_velocity);
  CHECK(Eigen::Map<VectorXd>(problem->mu, rows / 3) == p.problem.friction);
  CHECK(Eigen::Map<VectorXd>(stored->r, rows) == p.impulse);
  CHECK(Eigen::Map<VectorXd>(stored->u, rows) == p.velocity);
  fclib_delete_local(problem);
  std::free(problem);  // that deletes what it holds
  fclib_delete_solutions(stored, 1);
}
