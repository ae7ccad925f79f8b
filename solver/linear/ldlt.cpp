#include "linear/ldlt.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rows/dense.h"
#include "rows/laws.h"

namespace pbd {
namespace {

/// A constraint keeps its rows where its compliance is below this part of J W J^T: eliminating it would
/// square the stiffness ratio into the conditioning. Not so in a block with more rows than there are
/// velocities: but for their compliance its rows are redundant.
constexpr double eliminated_above = 1e-10;
/// Shift of kept rows' diagonal, as part of J W J^T. Rounding errors grow by its inverse, and a refinement
/// reduces the error by shift/(shift + smallest eigenvalue of D^-1 N): a value between the two.
constexpr double relative_shift = 1e-10;

template <class Block>
double trace_of_delassus(const Block& block, const std::vector<double>& inverse_mass, std::size_t i) {
  double trace = 0;
  const typename Block::Jacobian& jacobian = block.jacobian[i];
  for (int a = 0; a < Block::nodes; ++a)
    trace += inverse_mass[block.node[i][a]] * jacobian.template middleCols<3>(3 * a).squaredNorm();
  return trace;
}

}  // namespace

template <class Put>
void Ldlt::assemble(const Rows& rows, Put&& put) const {
  for (std::size_t node = 0; node < system_.column.size(); ++node)
    for (int axis = 0; axis < 3 && system_.column[node] >= 0; ++axis)
      put(system_.column[node] + axis, system_.column[node] + axis, 1 / rows.inverse_mass[node]);

  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    std::visit(
        [&]<class Block>(const Block& block) {
          for (std::size_t i = 0; i < block.size(); ++i) {
            const typename Block::Jacobian& jacobian = block.jacobian[i];
            const int impulse = impulse_column_[b][i];
            std::array<int, Block::nodes * 3> column;
            for (std::size_t a = 0; a < Block::nodes; ++a)
              for (std::size_t axis = 0; axis < 3; ++axis) {
                const int first = system_.column[block.node[i][a]];
                column[3 * a + axis] = first < 0 ? -1 : first + static_cast<int>(axis);
              }
            if (impulse < 0) {
              typename Block::Jacobian solved = jacobian;
              solve_definite_in_place(typename Block::Square(block.compliance[i]), solved);
              const Eigen::Matrix<double, 3 * Block::nodes, 3 * Block::nodes> stiffness =
                  jacobian.transpose() * solved;
              for (std::size_t r = 0; r < column.size(); ++r)
                for (std::size_t c = 0; c < column.size(); ++c)
                  if (column[c] >= 0 && column[r] >= column[c])
                    put(column[r], column[c], stiffness(static_cast<int>(r), static_cast<int>(c)));
            } else {
              const double shift =
                  relative_shift * trace_of_delassus(block, rows.inverse_mass, i) / Block::rows;
              const bool movable = block.inverse_diagonal[i].trace() > 0;
              const bool held = !movable || (block.bounded() && held_[b][i]);  // dp = 0
              for (int r = 0; r < Block::rows; ++r) {
                for (std::size_t c = 0; c < column.size(); ++c)
                  if (column[c] >= 0)
                    put(impulse + r, column[c], held ? 0.0 : jacobian(r, static_cast<int>(c)));
                for (int c = 0; c <= r; ++c)
                  put(impulse + r, impulse + c,
                      held ? -1.0 : -block.compliance[i](r, c) - (r == c ? shift : 0.0));
              }
            }
          }
        },
        rows.blocks[b]);
}

void Ldlt::analyse(const Rows& rows) {
  slot_.clear();
  impulse_column_.clear();
  held_.clear();
  system_.begin(rows);
  system_.entries.clear();  // the slots below take their place
  const int velocities = system_.size;
  int unknowns = velocities;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    const bool redundant = block.size() * Block::rows > static_cast<std::size_t>(velocities);
    auto& columns = impulse_column_.emplace_back();
    held_.emplace_back(block.bounded() ? block.size() : 0, false);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const double least = redundant ? 0 : eliminated_above * trace_of_delassus(block, rows.inverse_mass, i);
      const bool eliminated = block.compliance[i].trace() > least && !block.bounded();
      columns.push_back(eliminated ? -1 : unknowns);
      if (!eliminated) unknowns += Block::rows;
    }
  });

  std::vector<Eigen::Triplet<double>> entries;
  assemble(rows, [&](int row, int column, double) { entries.emplace_back(row, column, 0.0); });
  pbd::assemble(unknowns, entries, matrix_);
  for (const auto& entry : entries) {
    const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[entry.col()];
    const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[entry.col() + 1];
    slot_.push_back(static_cast<int>(std::lower_bound(first, last, entry.row()) - matrix_.innerIndexPtr()));
  }
  factor_.analyse(matrix_);
}

void Ldlt::begin(Rows& rows, const Points&, bool) {
  if (slot_.empty() || generation_ != rows.generation) analyse(rows);
  generation_ = rows.generation;
  factorise(rows);
}

void Ldlt::factorise(const Rows& rows) {
  matrix_.coeffs().setZero();
  std::size_t next = 0;
  assemble(rows, [&](int, int, double value) { matrix_.valuePtr()[slot_[next++]] += value; });
  factored_ = factor_.factorise(matrix_);
  last_residual_ = infinity;
}

/// Takes impulses to the bound that a sweep of Gauss-Seidel leaves them at; true if the set of such has
/// changed.
bool Ldlt::find_held(Rows& rows, Points& v) {
  bool changed = false;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    std::visit(
        [&]<class Block>(Block& block) {
          for (std::size_t i = 0; block.bounded() && i < block.size(); ++i) {
            const typename Block::Value full =
                -block.by_inverse_diagonal(i, block.residual(v, i, block.impulse[i]));
            const typename Block::Value change = allowed(block, i, block.impulse[i], full);
            // Not by `change`: that is less than `full` by rounding of the impulse, too.
            const bool held = !keeps(block, i, block.impulse[i] + full);
            changed |= held != held_[b][i];
            held_[b][i] = held;
            if (!held) continue;
            block.impulse[i] += change;
            block.apply(rows.inverse_mass, i, change, v);
          }
        },
        rows.blocks[b]);
  return changed;
}

double Ldlt::right_hand_side(const Rows& rows, const Points& v) {
  right_.setZero(matrix_.rows());
  double squared = 0;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    std::visit(
        [&]<class Block>(const Block& block) {
          for (std::size_t i = 0; i < block.size(); ++i) {
            const typename Block::Value r = -block.residual(v, i, block.impulse[i]);
            const bool movable = block.inverse_diagonal[i].trace() > 0;
            if (!movable || (block.bounded() && held_[b][i])) continue;
            squared += r.dot(block.by_inverse_diagonal(i, r));
            if (impulse_column_[b][i] >= 0) {
              right_.template segment<Block::rows>(impulse_column_[b][i]) = r;
              continue;
            }
            system_.push(block, i, solve_definite(block.compliance[i], r), right_);
          }
        },
        rows.blocks[b]);
  return std::sqrt(squared);
}

void Ldlt::correct(Rows& rows, const Points& v) {
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    std::visit(
        [&]<class Block>(Block& block) {
          for (std::size_t i = 0; i < block.size(); ++i) {
            typename Block::Value change;
            if (impulse_column_[b][i] >= 0) {
              change = -solution_.template segment<Block::rows>(impulse_column_[b][i]);
            } else {
              const typename Block::Value missed =
                  -block.residual(v, i, block.impulse[i]) - system_.along(block, i, solution_);
              change = solve_definite(block.compliance[i], missed);
            }
            block.impulse[i] += change;
            block.apply(rows.inverse_mass, i, change, changed_);
          }
        },
        rows.blocks[b]);
}

Sweep Ldlt::sweep(Rows& rows, Points& v, BlockSeconds) {
  if (find_held(rows, v)) factorise(rows);
  const double residual = right_hand_side(rows, v);
  constexpr double worthwhile = 0.5;
  if (!factored_ || !(residual < worthwhile * last_residual_)) return {residual, true};
  last_residual_ = residual;
  solution_ = factor_.solve(right_);
  changed_ = v;
  correct(rows, v);
  v.swap(changed_);
  return {residual};
}

}  // namespace pbd
