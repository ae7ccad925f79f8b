// What sweeps over the blocks of rows have in common.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>
#include <vector>

#include "rows/rows.h"

namespace pbd {

/// Seconds spent on each block; a null pointer takes no time.
using BlockSeconds = std::vector<double>*;

/// What a sweep met: the residual sqrt(sum_i r_i^T N_ii^-1 r_i) (sqrt(J)), each r_i taken when its constraint
/// was visited; of bounds and laws what they leave of it (`squared_residual` in rows/laws.h). `exhausted`:
/// the solver has nothing left to gain, solved or not.
struct Sweep {
  double residual = 0;
  bool exhausted = false;
};

/// f(block, index of its first row) for every block that has rows, its time added to `seconds`.
template <class F>
void visit_blocks(std::vector<AnyBlock>& blocks, BlockSeconds seconds, F&& f) {
  using Clock = std::chrono::steady_clock;
  std::size_t first_row = 0;
  const auto visit = [&](auto& block, std::size_t b) {
    if (block.size() == 0) return;
    const auto start = seconds ? Clock::now() : Clock::time_point{};
    f(block, first_row);
    if (seconds) (*seconds)[b] += std::chrono::duration<double>(Clock::now() - start).count();
    first_row += block.size() * block.rows;
  };
  for (std::size_t b = 0; b < blocks.size(); ++b)
    std::visit([&](auto& block) { visit(block, b); }, blocks[b]);
}

/// The R entries of constraint i in an array with one entry a row.
template <class Block>
auto entries(std::vector<double>& flat, const Block&, std::size_t first_row, std::size_t i) {
  return Eigen::Map<typename Block::Value>(flat.data() + first_row + i * Block::rows);
}

}  // namespace pbd
