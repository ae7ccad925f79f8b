// Where the Cholesky factor of a sparse symmetric matrix of blocks is not zero.
//
// Nodes are ordered by nested dissection (METIS: karypis1998fast), the columns by a postorder of the
// elimination tree. Neighbouring columns that have blocks in the same rows make a panel, which is stored and
// multiplied as one dense matrix; panels of few columns take in the next one where that stores few zeros.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "rows/source.h"

namespace pbd {

struct FactorPattern {
  std::vector<int> column;                // of each node in L, -1 for infinite mass
  std::vector<std::array<int, 2>> pairs;  // of nodes, that the matrix's blocks were of

  /// Panel s has the columns from first[s] to first[s + 1]: L is lower triangular in the rows of their own
  /// numbers, and full in row[start[s]] to row[start[s + 1]], ascending, all below. Its blocks are a matrix
  /// of height(s) rows from place[s] on, counted in blocks.
  std::vector<int> first, start, row;
  std::vector<std::size_t> place;
  std::vector<int> panel;  // of each column

  int columns() const { return static_cast<int>(panel.size()); }
  int panels() const { return static_cast<int>(place.size()) - 1; }
  int width(int s) const { return first[s + 1] - first[s]; }
  int height(int s) const { return width(s) + start[s + 1] - start[s]; }
  /// The row of L that row k of a panel's matrix is of; both counted in blocks.
  int row_at(int s, int k) const {
    const int below = k - width(s);
    return below < 0 ? first[s] + k : row[start[s] + below];
  }
  /// The row of a panel's matrix that row i of L, which it has, is in it.
  int row_in(int s, int i) const;

  bool is_of(const std::vector<double>& inverse_mass, const std::vector<MetricEntry>& entries) const;
  /// Multiplications of blocks that the factorisation takes.
  double products() const;
};

/// The numbers of all panels. Where they begin is aligned, since products are rounded by where their rows
/// lie.
template <class Real>
using PanelNumbers = std::vector<Real, Eigen::aligned_allocator<Real>>;

/// The matrix of panel s, of B x B blocks, in the numbers of all panels.
template <int B, class Numbers>
auto panel_of(const FactorPattern& pattern, Numbers& number, int s) {
  using Panel = Eigen::Matrix<typename Numbers::value_type, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<std::conditional_t<std::is_const_v<Numbers>, const Panel, Panel>>(
      number.data() + pattern.place[s] * B * B, B * pattern.height(s), B * pattern.width(s));
}

/// From the blocks of a matrix. Throws std::bad_alloc where METIS finds no memory.
FactorPattern analyse(const std::vector<double>& inverse_mass, const std::vector<MetricEntry>& entries);

}  // namespace pbd
