// Relaxations improve impulses p and velocities v of linear rows, keeping v - W J^T p as it is:
//   J v + b + Sigma p = 0  (unit of the rows per second).
// They see rows only. `begin` is called after each linearisation, `sweep` visits every row once and returns
// the residual sqrt(sum_i r_i^T N_ii^-1 r_i) (sqrt(J)) it met, each r_i taken when its constraint was
// visited. What else it does are its `further_sweeps`: power iterations, Gauss-Seidel's, factorisations.
#pragma once

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "rows.h"
#include "semismooth.h"

namespace pbd {

/// Seconds spent on each block; a null pointer takes no time.
using BlockSeconds = std::vector<double>*;

/// Block Gauss-Seidel in the scene's order: dp_i = -N_ii^-1 r_i, v updated at once.
struct GaussSeidel {
  static constexpr std::string_view name = "gauss_seidel";
  void begin(Rows&, const Points&, bool) {}
  double sweep(Rows& rows, Points& v, BlockSeconds seconds);
};

/// Upper estimate of the largest eigenvalue of D^-1 N, D = blockdiag(N_ii): the smaller of the proven bound,
/// the largest number of constraints at a node (N <= sum_a n_a J_a W_a J_a^T + Sigma), and 1.05 times a power
/// iteration whose vector is kept from one linearisation to the next.
class SpectralBound {
 public:
  double update(const Rows& rows, const Points& like);

  /// Takes note of a Rayleigh quotient of D^-1 N that was met: the eigenvalue is no smaller.
  void met(double quotient) { least_ = std::max(least_, quotient); }

  std::int64_t sweeps() const { return sweeps_; }  // of power iteration, in the last update

 private:
  double power_step(const Rows& rows);
  std::vector<double> vector_;  // one entry a row
  Points velocity_;
  int generation_ = 0;  // of the rows
  double constraints_at_a_node_ = 0;
  double least_ = 1;
  std::int64_t sweeps_ = 0;
};

/// Damped block Jacobi: dp_i = -omega N_ii^-1 r_i with omega = min(1, 2/bound). The residual cannot grow
/// while omega <= 2/(largest eigenvalue): where it does, the bound was too low and omega is reduced by a
/// tenth, at most to half of itself: under Coulomb's law it may grow with any omega. Where it grows tenfold,
/// all of these are halved for the rest of the step.
class Jacobi {
 public:
  static constexpr std::string_view name = "jacobi";
  void begin(Rows& rows, const Points& v, bool fresh);
  double sweep(Rows& rows, Points& v, BlockSeconds seconds);
  double factor() const { return omega_; }  // omega of the last linearisation
  std::int64_t further_sweeps() const { return bound_.sweeps(); }

 private:
  SpectralBound bound_;
  double omega_ = 1, least_omega_ = 0;
  double caution_ = 1;  // factor of omega, for the rest of the step
  double last_residual_ = 0, lowest_residual_ = 0;
  Points next_;
};

/// Nesterov's acceleration of block Jacobi with step 1/bound and restart by the gradient test (Nesterov 1983;
/// O'Donoghue, Candes 2015). The momentum is kept from one linearisation of a step to the next. Every change
/// of the impulses gives a Rayleigh quotient; where it exceeds the bound, the bound is raised and the
/// momentum begins anew (the backtracking of Beck, Teboulle 2009).
class NesterovJacobi {
 public:
  static constexpr std::string_view name = "nesterov_jacobi";
  void begin(Rows& rows, const Points& v, bool fresh);
  double sweep(Rows& rows, Points& v, BlockSeconds seconds);
  std::int64_t further_sweeps() const { return bound_.sweeps(); }

 private:
  bool bound_holds(const Rows& rows, const Points& v, double residual_squared, double compliant);
  void restart() { theta_ = 1, beta_ = 0; }

  SpectralBound bound_;
  double omega_ = 1;
  double theta_ = 1;
  double beta_ = 0;
  std::vector<double> previous_;  // impulses one sweep ago, one entry a row
  Points previous_v_;             // velocities one sweep ago
  Points extrapolated_;           // velocities at the extrapolated impulses
};

/// Conjugate gradients on the dual problem N p = -(b + J v_free), preconditioned by D = blockdiag(N_ii)
/// (Hestenes, Stiefel 1952; Polak, Ribiere 1969). With the direction s and its velocities u = W J^T s kept
/// together, s^T N s = |u|_M^2 + s^T Sigma s needs no further pass: a sweep costs as much as Jacobi's. The
/// residual is taken anew each sweep. Impulses with bounds: those that a step of block Jacobi would leave at
/// a bound take no part; where their set changes, or the step along s is cut at a bound, the next direction
/// begins anew (active sets, as in Polyak 1969). Of a sliding contact the normal impulse alone takes part;
/// the others, and an opening one's, are first moved as its law asks: half way between a step of block Jacobi
/// and what the contact alone would do, which by itself may go in circles.
class ConjugateGradients {
 public:
  static constexpr std::string_view name = "conjugate_gradients";
  void begin(Rows& rows, const Points& v, bool fresh);
  double sweep(Rows& rows, Points& v, BlockSeconds seconds);

 private:
  bool find_free(Rows& rows, Points& v, double& squared);

  std::vector<double> direction_, last_;  // s, and the last D^-1 r; one entry a row
  Points velocity_, push_;                // u, and W J^T of the new part of s
  double last_product_ = 0;               // r^T D^-1 r of the last sweep
  double square_ = 0;                     // s^T D s
  enum class Free : std::uint8_t { none, first, all };
  std::vector<Free> free_;  // rows of each constraint with bounds that take part, at its first row's place
};

/// Sparse factorisation, exact up to rounding; each sweep is one step of iterative refinement. Compliant
/// constraints are eliminated into the primal normal equations M + J^T Sigma^-1 J, those with (nearly) no
/// compliance keep their rows, unless their block has more rows than there are unknown velocities:
///   [M + J_c^T Sigma_c^-1 J_c   J_d^T           ] [dv   ]   [J_c^T Sigma_c^-1 r_c]
///   [J_d                        -Sigma_d - shift] [-dp_d] = [r_d                 ]
/// The matrix is quasi-definite, so LDL^T needs no pivoting; the shift, 1e-10 of J W J^T, keeps redundant
/// rows solvable and is removed by the refinement. Rows whose impulse has bounds are kept; those that a step
/// of block Jacobi would leave at a bound are held there, and each sweep with another set of them begins with
/// another factorisation (the primal-dual active sets of Hintermueller, Ito, Kunisch 2003). Where there are
/// contacts, a sweep is an iteration of a semismooth Newton method instead (semismooth.h).
class Direct {
 public:
  static constexpr std::string_view name = "direct";
  void begin(Rows& rows, const Points& v, bool fresh);
  double sweep(Rows& rows, Points& v, BlockSeconds seconds);
  std::int64_t further_sweeps() const { return newton_.further_sweeps(); }

 private:
  template <class Put>
  void assemble(const Rows& rows, Put&& put) const;
  void analyse(const Rows& rows);
  double right_hand_side(const Rows& rows, const Points& v);
  void correct(Rows& rows, const Points& v);
  bool find_held(Rows& rows, Points& v);
  void factorise(const Rows& rows);

  std::vector<int> velocity_column_;              // first unknown of each node, -1 for infinite mass
  std::vector<std::vector<int>> impulse_column_;  // per block and constraint, -1 if eliminated
  std::vector<int> slot_;                         // of each assembled entry in the matrix
  Eigen::SparseMatrix<double> matrix_;            // lower triangle
  using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;
  std::unique_ptr<Factor> factor_ = std::make_unique<Factor>();
  Eigen::VectorXd right_, solution_;
  Points changed_;
  double last_residual_ = 0;
  SemismoothNewton newton_;              // in the place of all this where there are contacts
  std::vector<std::vector<bool>> held_;  // at a bound, per block with bounds and constraint
};

using Relaxation = std::variant<GaussSeidel, Jacobi, NesterovJacobi, ConjugateGradients, Direct>;

/// When to end the sweeps: residual <= max(absolute, relative * that of the first sweep), or after
/// max_sweeps, further ones not counted.
struct InnerBudget {
  int max_sweeps = 1;
  double relative = 0;
  double absolute = 0;  // sqrt(J)
};

/// Sweeps until the budget's end; returns the number of sweeps, further ones (power iteration, what `direct`
/// does where Newton's step fails) included. Adds the first sweep's seconds of each block to `first_sweep`
/// unless it is null.
std::int64_t relax(Relaxation& relaxation, Rows& rows, Points& v, bool fresh, const InnerBudget& budget,
                   BlockSeconds first_sweep);

/// Names of all relaxations, and a fresh one by name (SetupError if unknown).
std::vector<std::string_view> relaxation_names();
Relaxation make_relaxation(std::string_view name);

}  // namespace pbd
