// What sources do with one constraint of a block once its value and Jacobian are known, whatever the effect:
// compiled once for each shape of block, R rows by K columns.
#pragma once

#include "rows/dense.h"
#include "rows/laws.h"
#include "rows/source.h"

namespace pbd {

template <int R, int K>
struct RowOperations {
  using Block = RowBlock<R, K>;
  using Value = typename Block::Value;
  using Square = typename Block::Square;
  using Jacobian = typename Block::Jacobian;
  using Stiffness = Eigen::Matrix<double, 3 * K, 3 * K>;

  /// Sets what stands for N_ii^-1 of constraint i, with its J; true if N_ii is singular.
  static bool invert_diagonal(Block& block, const std::vector<double>& inverse_mass, std::size_t i,
                              const Jacobian& jacobian);

  /// Of each row of J_i, the sum of squares over the columns that move: what is fixed rounds nothing, however
  /// far from its centre a row acts on it.
  static Value moving_squares(const Block& block, std::size_t i, const std::vector<double>& inverse_mass,
                              const Jacobian& jacobian);

  /// Sets bias and N_ii^-1 by the value c (less its offset), J and Sigma that the block has, and adds to
  /// `sums`. `size` (m) is the constraint's largest coordinate.
  static void linearise(const RowPlace& place, const Value& value, double size, Block& block, std::size_t i,
                        RowResidual& sums);

  /// True if limit i, `open` (R) before it and with the value rising (`upwards`) or falling as it opens, is
  /// met in the step by the speed at which it closes, not for what forces bring alone, nor for the rounding
  /// of places. `size` (m) is the constraint's largest coordinate.
  static bool meets(const StepBegin& begin, double open, bool upwards, double size, const Block& block,
                    std::size_t i) requires(R == 1);

  /// Source::perturb of constraint i with the turned value (less its offset) and Jacobian.
  static void perturb(const RowError& error, const Value& value, const Jacobian& jacobian, Block& block,
                      std::size_t i, Points& push);

  /// Appends J^T stiffness J + `more` of constraint i by pairs of nodes; `one_number`: the mean of its
  /// diagonal.
  static void append_metric(const Block& block, std::size_t i, const Jacobian& jacobian,
                            const Stiffness& more, bool one_number, std::vector<MetricEntry>& entries);
};

/// Refreshes N_ii^-1 for other inverse masses than the rows were linearised with.
void refresh_inverse_diagonal(Rows& rows);

}  // namespace pbd
