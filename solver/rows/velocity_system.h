// Linear systems whose unknowns are the velocities of the nodes that have a finite mass, three a node.
// What is declared alone is compiled once, for every kind of block.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "rows/rows.h"

namespace pbd {

/// f(block, i, number of its first row) for every constraint.
template <class AnyRows, class F>
void each_constraint(AnyRows& rows, F&& f) {
  Eigen::Index row = 0;
  for_each_block(rows.blocks, [&](auto& block) {
    for (std::size_t i = 0; i < block.size(); ++i, row += block.rows) f(block, i, row);
  });
}

struct VelocitySystem {
  std::vector<int> column;                      // first unknown of each node, -1 for infinite mass
  int size = 0;                                 // number of unknowns
  std::vector<Eigen::Triplet<double>> entries;  // of the matrix

  /// The matrix M.
  void begin(const Rows& rows) {
    column.assign(rows.inverse_mass.size(), -1);
    entries.clear();
    size = 0;
    for (std::size_t node = 0; node < column.size(); ++node)
      if (rows.inverse_mass[node] > 0) {
        column[node] = size;
        for (int axis = 0; axis < 3; ++axis, ++size)
          entries.emplace_back(size, size, 1 / rows.inverse_mass[node]);
      }
  }

  /// f(first unknown, number of the node in the constraint) for nodes of finite mass.
  template <class Block, class F>
  void each_node(const Block& block, std::size_t i, F&& f) const {
    for (int a = 0; a < Block::nodes; ++a) {
      const int first = column[block.node[i][a]];
      if (first >= 0) f(first, a);
    }
  }

  /// Adds J_i^T stiffness J_i.
  template <class Block>
  void add(const Block& block, std::size_t i, const typename Block::Square& stiffness);

  /// to += J_i^T p
  template <class Block>
  void push(const Block& block, std::size_t i, const typename Block::Value& p, Eigen::VectorXd& to) const;

  /// J_i of that solution.
  template <class Block>
  typename Block::Value along(const Block& block, std::size_t i, const Eigen::VectorXd& solution) const;
};

}  // namespace pbd
