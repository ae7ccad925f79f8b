// Contacts as a problem of their own, whose velocities answer impulses by a matrix that is given.
#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "rows/row_block.h"

namespace pbd {

/// Contacts of a local problem: a symmetric matrix takes the place of the masses, and an impulse on a node
/// moves others. A contact of fewer nodes has J zero for the rest. It stands among the blocks of the scenes
/// because the linear solvers visit one variant.
struct LocalContacts : RowBlock<3, 5> {
  using Pushed = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // three rows a node

  /// Nodes that follow each other, and what an impulse on one node does to them.
  struct Run {
    int first, count;
    std::size_t begin;  // of 3 count x 3 numbers in `response`, column by column
  };
  std::vector<double> response;        // 1/kg
  std::vector<Run> runs;               // of the first node, then of the next
  std::vector<std::size_t> first_run;  // of each node, and the end

  void clear_response() {
    response.clear();
    runs.clear();
    first_run.assign(1, 0);
  }

  /// Adds a run of the node that `end_node` ends; its numbers are to be set.
  Eigen::Map<Pushed> add_run(int first, int count) {
    runs.push_back({first, count, response.size()});
    response.resize(response.size() + 9 * static_cast<std::size_t>(count), 0.0);
    return {&response[runs.back().begin], 3 * count, 3};
  }
  void end_node() { first_run.push_back(runs.size()); }

  std::span<const Run> runs_of(int node) const {
    return std::span(runs).subspan(first_run[node], first_run[node + 1] - first_run[node]);
  }
  Eigen::Map<const Pushed> response_of(const Run& run) const {
    return {&response[run.begin], 3 * run.count, 3};
  }

  void apply(const std::vector<double>&, std::size_t i, const Value& p, Points& v) const {
    if (p.isZero(0)) return;
    Eigen::Map<Eigen::VectorXd> all(v.data(), v.size());
    add(i, p, all);
  }

  /// What impulses of contact i do to so many nodes, 1/kg.
  void push(std::size_t i, std::size_t count, Pushed& pushed) const {
    pushed.setZero(3 * static_cast<Eigen::Index>(count), 3);
    add(i, Square(Square::Identity()), pushed);
  }

  /// The block of the Delassus matrix between contact i and the one that `pushed` is of, 1/kg.
  Square coupling(std::size_t i, const Pushed& pushed) const {
    Square w = Square::Zero();
    for (int a = 0; a < nodes; ++a)
      w += jacobian[i].middleCols<3>(3 * a) * pushed.middleRows<3>(3 * node[i][a]);
    return w;
  }

  /// The same of contact i with itself.
  Square own_coupling(std::size_t i) const {
    Square w = Square::Zero();
    for (int b = 0; b < nodes; ++b) {
      const auto of_b = jacobian[i].middleCols<3>(3 * b);
      if (of_b.isZero(0)) continue;
      for (const Run& run : runs_of(node[i][b]))
        for (int a = 0; a < nodes; ++a)
          if (const int at = node[i][a] - run.first; at >= 0 && at < run.count)
            w += jacobian[i].middleCols<3>(3 * a) * response_of(run).middleRows<3>(3 * at) * of_b.transpose();
    }
    return w;
  }

 private:
  template <class P, class Sum>
  void add(std::size_t i, const P& p, Sum& sum) const {
    for (int a = 0; a < nodes; ++a) {
      const auto directions = jacobian[i].middleCols<3>(3 * a);
      if (directions.isZero(0)) continue;
      const P push = directions.transpose() * p;
      for (const Run& run : runs_of(node[i][a]))
        sum.middleRows(3 * run.first, 3 * run.count).noalias() += response_of(run) * push;
    }
  }
};

template <class Block>
inline constexpr bool is_local = std::is_same_v<std::remove_const_t<Block>, LocalContacts>;

}  // namespace pbd
