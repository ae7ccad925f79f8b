#include "rivals/siconos.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include <siconos/numerics/FrictionContactProblem.h>
#include <siconos/numerics/Friction_cst.h>
#include <siconos/numerics/NonSmoothDrivers.h>
#include <siconos/numerics/NumericsMatrix.h>
#include <siconos/numerics/NumericsSparseMatrix.h>
#include <siconos/numerics/NumericsVerbose.h>
#include <siconos/numerics/SolverOptions.h>
#include <siconos/numerics/SparseBlockMatrix.h>

#include "rivals/stopwatch.h"

namespace pbd::rivals {
namespace {

constexpr std::array<int, 3> ids{SICONOS_FRICTION_3D_NSGS, SICONOS_FRICTION_3D_NSN_AC,
                                 SICONOS_FRICTION_3D_ADMM};
constexpr int most_newton_iterations = 1000;

struct ClearMatrix {
  void operator()(NumericsMatrix* matrix) const {
    NM_clear(matrix);
    std::free(matrix);  // Siconos took it by malloc
  }
};
struct DeleteOptions {
  void operator()(SolverOptions* options) const {
    solver_options_delete(options);  // what it points to alone
    std::free(options);
  }
};
using MatrixHolder = std::unique_ptr<NumericsMatrix, ClearMatrix>;

MatrixHolder triplets_of(const Eigen::SparseMatrix<double>& matrix) {
  MatrixHolder made(NM_create(NM_SPARSE, static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols())));
  NM_triplet_alloc(made.get(), matrix.nonZeros());
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
      NM_entry(made.get(), static_cast<int>(entry.row()), static_cast<int>(entry.col()), entry.value());
  return made;
}

/// The form that Gauss-Seidel's block rows are quick in.
MatrixHolder blocks_of(NumericsMatrix& triplets) {
  MatrixHolder made(NM_create(NM_SPARSE_BLOCK, triplets.size0, triplets.size1));
  SBM_from_csparse(3, NM_csc(&triplets), made->matrix1);
  return made;
}

}  // namespace

bool siconos_takes(const ContactProblem& problem) {
  constexpr double least = 1e-12, most = 1e12;  // 1/kg
  const Eigen::VectorXd diagonal = problem.delassus.diagonal();
  const double largest =
      problem.delassus.coeffs().size() > 0 ? problem.delassus.coeffs().abs().maxCoeff() : 0;
  return (diagonal.array() >= least).all() && largest <= most;
}

ContactSolution siconos(std::string_view name, const ContactProblem& problem, double tolerance,
                        int most_iterations) {
  ContactSolution found;
  found.impulse.setZero(problem.free_velocity.size());
  if (found.impulse.size() == 0 || !siconos_takes(problem)) return found;
  const int id = ids[std::find(siconos_names.begin(), siconos_names.end(), name) - siconos_names.begin()];
  MatrixHolder matrix = triplets_of(problem.delassus);
  if (id == SICONOS_FRICTION_3D_NSGS) matrix = blocks_of(*matrix);
  Eigen::VectorXd q = problem.free_velocity, mu = problem.friction, velocity = found.impulse;
  FrictionContactProblem stated{3, static_cast<int>(mu.size()), matrix.get(), q.data(), mu.data()};
  const std::unique_ptr<SolverOptions, DeleteOptions> options(solver_options_create(id));
  options->dparam[SICONOS_DPARAM_TOL] = tolerance;
  options->iparam[SICONOS_IPARAM_MAX_ITER] =
      id == SICONOS_FRICTION_3D_NSN_AC ? std::min(most_iterations, most_newton_iterations) : most_iterations;
  numerics_set_verbose(0);
  timed(found.seconds, [&] { fc3d_driver(&stated, found.impulse.data(), velocity.data(), options.get()); });
  found.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  return found;
}

}  // namespace pbd::rivals
