// Rows: all that a relaxation sees of a scene. Find impulses p and velocities v with
//   J v + b + Sigma p = 0,   v = v_free + W J^T p,   W = M^-1 (one inverse mass a node);
// where an impulse has bounds, J v + b + Sigma p >= 0 at the lower one and <= 0 at the upper one do. Rows of
// three with friction are a contact's, normal first, and obey its law instead. What a law lets an impulse be
// is in laws.h; here are data, and the products with J.
// Rows come in blocks of one effect each, and within a block in constraints of R rows and K nodes; arrays are
// contiguous, one entry a constraint; a rigid body counts as two nodes (bodies.h), a local problem's contact
// as up to five. Units: v m/s, p N s for lengths; b, J v in the constraint's unit per second.
//
// `inverse_diagonal` is N_ii^-1 with N_ii = J_i W J_i^T + Sigma_i, or its pseudo-inverse where N_ii is
// singular; with friction one number for the three rows, 3/trace(N_ii), so that projections remain Euclidean.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "friction.h"
#include "rows/chunks.h"
#include "rows/constraint.h"

namespace pbd {

/// What an impulse may be: as its bounds and its law of friction let it, anything, or nothing.
enum class Freedom : std::uint8_t { lawful, free, held };

/// Of an impulse (R = 1), or of a contact's normal one, while it is `lawful`.
struct Bounds {
  double lower = 0, upper = infinity;  // N s
  Freedom freedom = Freedom::lawful;
};

template <int R, int K>
struct RowBlock : ConstraintShape<R, K> {
  using Shape = ConstraintShape<R, K>;
  using Velocities = Eigen::Matrix<double, 3 * K, 1>;

  static constexpr std::size_t row_bytes = sizeof(typename Shape::Jacobian) +
                                           2 * sizeof(typename Shape::Square) +
                                           2 * sizeof(typename Shape::Value);  // of a constraint, about

  std::vector<std::size_t> entries;  // of the effect that are rows; empty if all are
  std::vector<typename Shape::Nodes> node;
  std::vector<typename Shape::Jacobian> jacobian;
  std::vector<typename Shape::Value> bias;
  std::vector<typename Shape::Square> compliance;  // Sigma
  std::vector<typename Shape::Square> inverse_diagonal;
  std::vector<typename Shape::Value> impulse;
  std::vector<typename Shape::Square> stiffness;   // Sigma^-1, kept for quasi_newton alone
  std::vector<typename Shape::Value> offset;       // of c by damping, and c where the step begins: both empty
  std::vector<typename Shape::Value> begin_value;  // where there is none
  std::vector<Bounds> bounds;                      // empty where every impulse is free
  std::vector<double> friction;                    // mu, for R = 3; empty where there is none
  std::vector<typename Shape::Square> delassus;    // N_ii, kept where there is friction
  Friction law = Friction::coulomb;
  Chunks chunks;  // of its constraints; one where it was not divided since they were others

  std::size_t size() const { return node.size(); }
  std::size_t chunk_length() const { return pbd::chunk_length(size(), row_bytes, frictional()); }

  /// Index in the effect of constraint i.
  std::size_t entry(std::size_t i) const { return entries.empty() ? i : entries[i]; }

  /// Contacts: impulses with bounds, and with friction for R = 3.
  void resize_contacts(std::size_t count) {
    resize(count);
    bounds.assign(count, {});
    if constexpr (R == 3) {
      friction.resize(count);
      delassus.resize(count);
    }
  }

  void resize(std::size_t count) {
    node.resize(count);
    jacobian.resize(count);
    bias.resize(count);
    compliance.resize(count);
    inverse_diagonal.resize(count);
    impulse.assign(count, Shape::Value::Zero());
  }

  std::int64_t bytes() const {
    return static_cast<std::int64_t>(
        entries.size() * sizeof(std::size_t) + 2 * offset.size() * sizeof(bias[0]) +
        bounds.size() * sizeof(Bounds) + friction.size() * sizeof(double) +
        (delassus.size() + stiffness.size()) * sizeof(compliance[0]) +
        size() * (sizeof(node[0]) + sizeof(jacobian[0]) + 2 * sizeof(bias[0]) + 2 * sizeof(compliance[0])));
  }

  /// Velocities of constraint i's nodes, three entries a node.
  Velocities gather(const Points& v, std::size_t i) const {
    Velocities local;
    for (int a = 0; a < K; ++a) local.template segment<3>(3 * a) = v.col(node[i][a]);
    return local;
  }

  /// v += W J_i^T p
  void apply(const std::vector<double>& inverse_mass, std::size_t i, const typename Shape::Value& p,
             Points& v) const {
    apply(inverse_mass, i, jacobian[i], p, v);
  }

  /// v += W J^T p with other directions for constraint i
  void apply(const std::vector<double>& inverse_mass, std::size_t i,
             const typename Shape::Jacobian& directions, const typename Shape::Value& p, Points& v) const {
    for (int a = 0; a < K; ++a) {
      const int index = node[i][a];
      if (bounded() && inverse_mass[index] == 0) continue;  // other chunks of its colour may have it, too
      v.col(index) += inverse_mass[index] * (directions.template middleCols<3>(3 * a).transpose() * p);
    }
  }

  /// Divides its constraints in chunks, for so many threads. Many contacts share nothing but what cannot
  /// move: with `fixed_are_shared` these columns keep no chunks apart, and nothing may write to them
  /// (`apply`).
  void divide(const std::vector<double>& inverse_mass, int threads, bool fixed_are_shared = false) {
    chunks.threads = threads;
    pbd::divide({node.empty() ? nullptr : node[0].data(), K * node.size()}, K, chunk_length(), inverse_mass,
                fixed_are_shared, chunks);
  }

  bool bounded() const { return !bounds.empty(); }
  bool frictional() const { return !friction.empty(); }

  /// |W J_i^T p|_M^2 of constraint i's impulse p, J.
  double squared_effect(const std::vector<double>& inverse_mass, std::size_t i) const {
    const Velocities push = jacobian[i].transpose() * impulse[i];
    double sum = 0;
    for (int a = 0; a < K; ++a)
      sum += inverse_mass[node[i][a]] * push.template segment<3>(3 * a).squaredNorm();
    return sum;
  }

  /// J_i v + b_i + Sigma_i p
  typename Shape::Value residual(const Points& v, std::size_t i, const typename Shape::Value& p) const {
    // Node by node: what is gathered in parts would be read as a whole before it is written. Apart from the
    // bias, since what fast nodes do to a row may cancel. A single row has its shortest chain of sums by
    // nodes, several rows by columns.
    typename Shape::Value rate = Shape::Value::Zero();
    for (int a = 0; a < K; ++a) {
      if constexpr (R == 1)
        rate += jacobian[i].template middleCols<3>(3 * a) * v.col(node[i][a]);
      else
        for (int axis = 0; axis < 3; ++axis) rate += jacobian[i].col(3 * a + axis) * v(axis, node[i][a]);
    }
    return bias[i] + compliance[i] * p + rate;
  }
};

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

using AnyBlock = std::variant<RowBlock<3, 1>, RowBlock<1, 2>, RowBlock<1, 4>, RowBlock<3, 3>, RowBlock<6, 4>,
                              RowBlock<2, 4>, RowBlock<3, 4>, RowBlock<1, 3>, RowBlock<3, 5>, RowBlock<1, 5>,
                              LocalContacts>;

/// Filled, copied and destroyed in rows.cpp, not in each file that has rows.
struct BlockList : std::vector<AnyBlock> {
  BlockList();
  BlockList(const BlockList&);
  BlockList(BlockList&&) noexcept;
  BlockList& operator=(const BlockList&);
  BlockList& operator=(BlockList&&) noexcept;
  ~BlockList();

  template <class Block>
  void add(Block&& block);
};

struct Rows {
  std::vector<double> inverse_mass;  // 1/kg, one a column (bodies.h); 0 for infinite mass
  BlockList blocks;                  // in the scene's order; those of contacts may be empty
  bool contacts = false;             // some blocks are those of contacts
  int generation = 0;                // raised with each other set of contacts or compliances
  int threads = 1;                   // that loops are divided among
};

/// Entry k of a start vector that no symmetry of a scene leaves out a mode of; in [-1, 1].
double irregular(std::size_t k);

/// f(block) for every block, in order.
template <class Blocks, class F>
void for_each_block(Blocks&& blocks, F&& f) {
  for (auto& block : blocks) std::visit(f, block);
}

/// Number of scalar rows; those of some blocks may be left out.
std::int64_t row_count(const Rows& rows, const std::vector<bool>& without = {});
std::int64_t row_count(const AnyBlock& block);
std::int64_t row_count(std::span<const AnyBlock> blocks);

/// What the blocks' rows take in memory.
std::int64_t bytes(std::span<const AnyBlock> blocks);

void clear_impulses(Rows& rows);

/// The impulses and biases of all rows, to be put back later.
void keep_impulses_and_biases(const Rows& rows, std::vector<double>& kept);
void restore_impulses_and_biases(const std::vector<double>& kept, Rows& rows);

/// Multiplies the biases of rows without compliance.
void scale_hard_biases(Rows& rows, double factor);

/// v += W J^T p with the impulses stored in the blocks.
void apply_impulses(std::span<const AnyBlock> blocks, const std::vector<double>& inverse_mass, Points& v);

/// Divides the constraints of all blocks, and what else loops over rows, among so many threads.
void divide(Rows& rows, int threads);

/// The same of all rows; those of some blocks may be left out.
void apply_impulses(const Rows& rows, Points& v, const std::vector<bool>& without = {});

}  // namespace pbd
