// Siconos' solvers of one step's contact problem by Signorini's and Coulomb's laws (acary2018solving).
#pragma once

#include <array>
#include <string_view>

#include <Eigen/SparseCore>

namespace pbd::rivals {

/// u = W r + q; contact i owns rows 3 i .. 3 i + 2: normal and two tangents.
struct ContactProblem {
  const Eigen::SparseMatrix<double>& delassus;  // W, 1/kg; symmetric for admm
  const Eigen::VectorXd& free_velocity;         // q, m/s
  const Eigen::VectorXd& friction;              // of each contact
};

struct ContactSolution {
  Eigen::VectorXd impulse;  // r, N s; whoever asks has to look what it is worth
  int iterations = 0;
  double seconds = 0;  // of the solver alone: the matrix is in its own form before
};

/// nsgs   block Gauss-Seidel, each contact by Newton's method
/// nsn_ac semismooth Newton on Alart and Curnier's function, sparse LU
/// admm   alternating directions on the convex law, the shift mu |u_T| moved in between
inline constexpr std::array<std::string_view, 3> siconos_names{"siconos_nsgs", "siconos_nsn_ac",
                                                               "siconos_admm"};

/// False where Siconos' assertions would end the program: of each contact W_NN and W_TT have to be positive,
/// and all of W between 1e-12 and 1e12 1/kg.
bool siconos_takes(const ContactProblem& problem);

/// Until Siconos' own measure, |r - P_K(r - u - mu |u_T| e_N)| / |q|, is within the tolerance, or for so many
/// iterations, of Newton's method 1000 at most. What it cannot take it does not solve: the impulses are zero.
/// Not to be interrupted.
ContactSolution siconos(std::string_view name, const ContactProblem& problem, double tolerance,
                        int most_iterations);

}  // namespace pbd::rivals
