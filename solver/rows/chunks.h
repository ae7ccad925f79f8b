// How loops over a block's constraints are divided. Constraints that follow each other make a chunk. Chunks
// of one colour share no column that moves, so that what they add to columns may be added at once, each by
// its own thread, without atomics or copies. Loops that add to columns go colour by colour, in this order on
// one thread, too: nothing depends on how many there are. A block of a single chunk goes in its own order.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "threads/threads.h"

// What is done for a constraint is flattened, all it calls inlined, which GCC does not do of itself with so
// many kinds of rows; not so with sanitizers, whose checks would make that too long to compile.
#ifdef NDEBUG
#define PBD_FLATTEN __attribute__((flatten))
#define PBD_KERNEL __attribute__((noinline, flatten))
#else
#define PBD_FLATTEN
#define PBD_KERNEL __attribute__((noinline))
#endif

namespace pbd {

struct Chunks {
  int threads = 1;
  std::vector<int> order;            // the chunks, colour by colour; empty where there is only one
  std::vector<int> colour;           // the first place of each colour in `order`, and its end
  std::vector<std::uint64_t> taken;  // scratch: of each column the colours of its chunks
  std::vector<int> colour_of;        // scratch: of each chunk
};

inline constexpr std::size_t most_chunks = 128;

/// Constraints of a chunk, of so many of so many bytes: 64 kB of rows, which take longer than to begin a
/// task, or 8 kB of contacts with friction, each of which takes longer than other rows. Of many constraints
/// so many that there are 128 chunks: memory is read the faster the longer it goes on, and longer chunks have
/// fewer neighbours.
std::size_t chunk_length(std::size_t constraints, std::size_t bytes, bool friction);

/// Divides constraints, `length` of them a chunk, each with so many of the columns. Each chunk takes the
/// first colour that none of its columns has, those that cannot move left out if they are shared; beyond 63
/// colours one of its own.
void divide(std::span<const int> columns, int columns_of_each, std::size_t length,
            const std::vector<double>& inverse_mass, bool fixed_are_shared, Chunks& chunks);

/// f(i, sum) for every constraint: f adds to the columns of constraint i, and reads what is no column's that
/// other constraints add to, or reads its own columns alone.
template <class Block, class Sum, class F>
void add_scattered(Block& block, Sum& total, F&& f) {
  const Chunks& chunks = block.chunks;
  const auto range = [&](std::size_t first, std::size_t last, Sum& sum) PBD_KERNEL {
    Sum own = sum;  // in a register
    for (std::size_t i = first; i < last; ++i) f(i, own);
    sum = own;
  };
  if (chunks.order.empty()) return range(0, block.size(), total);
  const std::size_t length = block.chunk_length();
  assert(chunks.order.size() <= most_chunks);
  std::array<Sum, most_chunks> part{};
  each_of_groups(chunks.threads, chunks.colour, [&](std::size_t k) {
    const std::size_t first = static_cast<std::size_t>(chunks.order[k]) * length;
    range(first, std::min(first + length, block.size()), part[k]);
  });
  for (std::size_t k = 0; k < chunks.order.size(); ++k) total += part[k];
}

/// f(i, sum) for every constraint: f changes nothing but what is the constraint's own.
template <class Block, class Sum, class F>
void add_each(Block& block, Sum& total, F&& f) {
  const std::size_t length = block.chunk_length(), count = (block.size() + length - 1) / length;
  const auto range = [&](std::size_t first, std::size_t last, Sum& sum) PBD_KERNEL {
    Sum own = sum;
    for (std::size_t i = first * length; i < std::min(last * length, block.size()); ++i) f(i, own);
    sum = own;
  };
  add_parts(block.chunks.threads, count, total, range);
}

/// add_scattered of f(i), which has no sum.
template <class Block, class F>
void each_scattered(Block& block, F&& f) {
  Nothing nothing;
  add_scattered(block, nothing, [&](std::size_t i, Nothing&) { f(i); });
}

/// add_each of f(i), which has no sum.
template <class Block, class F>
void each_own(Block& block, F&& f) {
  Nothing nothing;
  add_each(block, nothing, [&](std::size_t i, Nothing&) { f(i); });
}

}  // namespace pbd
