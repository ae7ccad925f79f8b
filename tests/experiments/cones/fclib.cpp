// FCLIB's files against its own library: what that writes is read in every storage, and it reads what is
// written.
extern "C" {
#include <fclib.h>
}

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "cones/cone_file.h"
#include "planted_family.h"
#include "program.h"

using namespace pbdcheck;
using namespace pbdcheck::test;
using namespace pbd::reference;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

enum class Storage { triplets, triplets_of_csparse, columns, rows };

/// A matrix as the library has it, with the arrays it points to.
struct Stored {
  std::vector<int> p, i;
  std::vector<double> x;
  fclib_matrix matrix{};

  Stored(const MatrixXd& full, Storage storage) {
    const bool by_rows = storage == Storage::rows;
    const auto outer = by_rows ? full.rows() : full.cols(), inner = by_rows ? full.cols() : full.rows();
    for (Eigen::Index k = 0; k < outer; ++k) {
      if (storage == Storage::columns || by_rows) p.push_back(static_cast<int>(x.size()));
      for (Eigen::Index l = 0; l < inner; ++l) {
        const double value = by_rows ? full(k, l) : full(l, k);
        if (value == 0) continue;
        x.push_back(value);
        const auto row = static_cast<int>(l), column = static_cast<int>(k);
        i.push_back(storage == Storage::triplets ? column : row);
        if (storage == Storage::triplets) p.push_back(row);
        if (storage == Storage::triplets_of_csparse) p.push_back(column);
      }
    }
    if (storage == Storage::columns || by_rows) p.push_back(static_cast<int>(x.size()));
    matrix.nzmax = static_cast<int>(x.size());
    matrix.m = static_cast<int>(full.rows());
    matrix.n = static_cast<int>(full.cols());
    matrix.nz = by_rows ? -2 : storage == Storage::columns ? -1 : matrix.nzmax;
    matrix.p = p.data();
    matrix.i = i.data();
    matrix.x = x.data();
  }
};

void check_close(const MatrixXd& found, const MatrixXd& expected) {
  REQUIRE(found.rows() == expected.rows());
  CHECK((found - expected).norm() <= 1e-14 * expected.norm());
}

}  // namespace

TEST_CASE("local problems that FCLIB writes are read in every storage") {
  const TemporaryFolder folder;
  const PlantedCone p = stack_problem();
  MatrixXd w = p.problem.delassus;
  w(0, 1) *= 1 + 1e-3;  // so that rows are no columns
  VectorXd q = p.problem.free_velocity, mu = p.problem.friction;
  for (const Storage storage : {Storage::triplets_of_csparse, Storage::columns, Storage::rows}) {
    Stored stored(w, storage);
    fclib_local problem{};
    problem.W = &stored.matrix;
    problem.q = q.data();
    problem.mu = mu.data();
    problem.spacedim = 3;
    const auto path = folder.path / "local.hdf5";
    std::filesystem::remove(path);
    REQUIRE(fclib_write_local(&problem, path.c_str()) == 1);
    const ConeFile file = read_cone_file(path);
    check_close(file.problem.delassus, w);
    CHECK(file.problem.free_velocity == q);
    CHECK(file.problem.friction == mu);
  }
}

TEST_CASE("global problems that FCLIB writes are condensed, whichever way H is stored") {
  const TemporaryFolder folder;
  constexpr int unknowns = 12, rows = 6;
  MatrixXd m = MatrixXd::Identity(unknowns, unknowns), h(unknowns, rows);
  VectorXd f(unknowns), w(rows), mu = VectorXd::Constant(rows / 3, 0.4);
  for (int i = 0; i < unknowns; ++i) {
    m(i, i) = 2 + i % 3;
    f(i) = std::sin(i);
    for (int j = 0; j < rows; ++j) h(i, j) = std::cos(3 * i + 7 * j);
  }
  for (int j = 0; j < rows; ++j) w(j) = 0.1 * j;
  const MatrixXd inverse = m.inverse();
  for (const Storage storage :
       {Storage::triplets, Storage::triplets_of_csparse, Storage::columns, Storage::rows}) {
    Stored stored_m(m, Storage::columns), stored_h(h, storage);
    fclib_global problem{};
    problem.M = &stored_m.matrix;
    problem.H = &stored_h.matrix;
    problem.f = f.data();
    problem.w = w.data();
    problem.mu = mu.data();
    problem.spacedim = 3;
    const auto path = folder.path / "global.hdf5";
    std::filesystem::remove(path);
    REQUIRE(fclib_write_global(&problem, path.c_str()) == 1);
    const ConeFile file = read_cone_file(path);
    check_close(file.problem.delassus, h.transpose() * inverse * h);
    check_close(file.problem.free_velocity, w + h.transpose() * inverse * f);
  }
}

TEST_CASE("FCLIB reads what is written") {
  const TemporaryFolder folder;
  const PlantedCone p = stack_problem();
  ConeSolution solution;
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
