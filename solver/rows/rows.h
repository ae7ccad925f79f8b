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

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "rows/local_contacts.h"
#include "rows/row_block.h"

namespace pbd {

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
  BlockList blocks;                  // in the scene's order; those of contacts and limits may be empty
  bool contacts = false;             // some blocks are those of contacts
  int generation = 0;                // raised with each other set of constraints or compliances
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
