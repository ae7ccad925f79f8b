// Newton's method for linear rows whose impulses obey bounds and laws of friction: with w =
// `inverse_diagonal` and P what the law makes of a step (rows/laws.h), the rows hold where p = P(p, -w r),
// r = J v + b + Sigma p. Each iteration solves the linear system of (dv, dp)
//   M dv - J^T dp = 0,  (1 - P_p) dp / w + P_step (J dv + Sigma dp) = (P(p, -w r) - p) / w
// (rows without a law: J dv + Sigma dp = -r) by sparse LU, and takes the longest of four steps that reduces
// the residual. Redundant rows make the system singular: Sigma is taken larger by a part of J W J^T, 1e-8 at
// least, a proximal term, which the iteration removes. Where there are more rows than velocities, impulses
// are eliminated (not those of local problems). Where no step reduces the residual the part grows, and
// shrinks again where steps succeed (levenberg1944method). (Semismooth Newton: qi1993nonsmooth; for friction
// alart1991mixed.) It converges from near a solution; from afar it may be exhausted without one. Where
// redundant rows contradict each other impulses must change for long, and the residual does not, until one
// of them ends: a round of the proximal point method (rockafellar1976augmented) changes them by much at once.
// Coulomb's law is not monotone, and the residual has minima that are no solutions: a path of smoothed laws
// (chen1993noninterior), from where no bounded impulse acts, may lead past them, or end where it turns back.
#pragma once

#include "linear/sparse_factor.h"
#include "linear/sweeps.h"
#include "rows/velocity_system.h"

namespace pbd {

/// own dp + by_step J dv = right, constraint i's row of the linear system.
template <class Block>
struct LinearLaw {
  typename Block::Square own, by_step;
  typename Block::Value right;
};

class SemismoothNewton {
 public:
  static constexpr std::string_view name = "semismooth_newton";
  static constexpr bool solves_any_rows = false;
  static constexpr double enough_fall = 0.9;  // of the residual, to count as a gain

  void begin(Rows&, const Points&, bool) {
    trust();
    part_of_round_ = first_part;
    anchor_.resize(0);
  }

  /// One iteration.
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);

  /// One iteration of so many attempts from where the natural residual is `residual`; false, and nothing
  /// changed, where none reduces it.
  bool improve(Rows& rows, Points& v, double residual, int attempts);

  struct Round {
    int factorisations;
    bool solved;  // else the impulses are anywhere
  };

  /// A round of the proximal point method: solves the rows with Sigma, of what the impulses change by alone,
  /// larger by a part of J W J^T. The next round's part is smaller, or larger where Newton's method fails.
  Round advance(Rows& rows, Points& v);

  /// Solves the rows with smoothed laws (smoothed_law.h), less and less smoothed, from where all bounded
  /// impulses are zero. `solved` where the natural residual ends below that before; else nothing is changed.
  Round follow_path(Rows& rows, Points& v, double residual_before);

  /// Takes the least shift again.
  void trust() { shift_ = least_shift; }

 private:
  static constexpr double least_shift = 1e-8, most_shift = 1e-2;  // of Sigma, as a part of J W J^T
  static constexpr double first_part = 1e-3;                      // the same of a round

  template <class Block>
  LinearLaw<Block> law_of(const Block& block, std::size_t i, Eigen::Index first, const Points& v) const;
  template <class Block>
  typename Block::Value missed(const Block& block, std::size_t i, Eigen::Index first, const Points& v) const;
  void assemble(const Rows& rows, const Points& v);
  void find_step(const Rows& rows, const Points& v);
  bool find_newton_step(const Rows& rows, const Points& v);
  void take_step(Rows& rows, Points& v, double length) const;
  bool search(Rows& rows, Points& v, double& left, double& length);
  bool descend(Rows& rows, Points& v, double below);
  double residual(const Rows& rows, const Points& v) const;

  VelocitySystem system_;
  bool keeps_impulses_ = true;  // as unknowns
  SparseMatrix matrix_;
  SparseLu factor_;
  Eigen::VectorXd right_, solution_, step_;
  Eigen::VectorXd anchor_;  // N s, where a round begins, one entry a row; empty outside of rounds
  LocalContacts::Pushed pushed_;
  std::vector<double> kept_;       // impulses and biases, and
  Points start_;                   // velocities where the iteration begins
  std::vector<double> path_kept_;  // likewise before a path
  Points path_start_;
  double shift_ = least_shift, part_of_round_ = first_part;
  double smoothing_ = 0;  // sqrt(J), of the laws of friction
};

}  // namespace pbd
