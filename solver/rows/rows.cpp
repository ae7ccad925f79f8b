#include "rows/laws.h"

#include <cmath>

namespace pbd {

BlockList::BlockList() = default;
BlockList::BlockList(const BlockList&) = default;
BlockList::BlockList(BlockList&&) noexcept = default;
BlockList& BlockList::operator=(const BlockList&) = default;
BlockList& BlockList::operator=(BlockList&&) noexcept = default;
BlockList::~BlockList() = default;

template <class Block>
void BlockList::add(Block&& block) {
  push_back(AnyBlock(std::forward<Block>(block)));
}
template void BlockList::add(RowBlock<3, 1>&&);
template void BlockList::add(RowBlock<1, 2>&&);
template void BlockList::add(RowBlock<1, 4>&&);
template void BlockList::add(RowBlock<3, 3>&&);
template void BlockList::add(RowBlock<6, 4>&&);
template void BlockList::add(RowBlock<2, 4>&&);
template void BlockList::add(RowBlock<3, 4>&&);
template void BlockList::add(RowBlock<1, 3>&&);
template void BlockList::add(RowBlock<3, 5>&&);
template void BlockList::add(RowBlock<1, 5>&&);
template void BlockList::add(LocalContacts&&);

double irregular(std::size_t k) {
  return std::sin(12.9898 * static_cast<double>(k));  // no part of a turn
}

std::int64_t row_count(const AnyBlock& any) {
  return std::visit([](const auto& block) { return static_cast<std::int64_t>(block.size()) * block.rows; },
                    any);
}

std::int64_t row_count(const Rows& rows, const std::vector<bool>& without) {
  std::int64_t count = 0;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    if (without.empty() || !without[b]) count += row_count(rows.blocks[b]);
  return count;
}

std::int64_t row_count(std::span<const AnyBlock> blocks) {
  std::int64_t count = 0;
  for (const AnyBlock& block : blocks) count += row_count(block);
  return count;
}

std::int64_t bytes(std::span<const AnyBlock> blocks) {
  std::int64_t sum = 0;
  for_each_block(blocks, [&](const auto& block) { sum += block.bytes(); });
  return sum;
}

void clear_impulses(Rows& rows) {
  for_each_block(rows.blocks, [](auto& block) {
    for (auto& impulse : block.impulse) impulse.setZero();
  });
}

void keep_impulses_and_biases(const Rows& rows, std::vector<double>& kept) {
  kept.clear();
  for_each_block(rows.blocks, [&](const auto& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      kept.insert(kept.end(), block.bias[i].begin(), block.bias[i].end());
      kept.insert(kept.end(), block.impulse[i].begin(), block.impulse[i].end());
    }
  });
}

void restore_impulses_and_biases(const std::vector<double>& kept, Rows& rows) {
  const double* next = kept.data();
  for_each_block(rows.blocks, [&](auto& block) {
    for (std::size_t i = 0; i < block.size(); ++i)
      for (auto* values : {&block.bias[i], &block.impulse[i]})
        for (double& value : *values) value = *next++;
  });
}

void scale_hard_biases(Rows& rows, double factor) {
  for_each_block(rows.blocks, [&](auto& block) {
    for (std::size_t i = 0; i < block.size(); ++i)
      if (block.compliance[i].is_zero() && !opens(block, i)) block.bias[i] *= factor;
  });
}

void apply_impulses(std::span<const AnyBlock> blocks, const std::vector<double>& inverse_mass, Points& v) {
  for_each_block(blocks, [&](const auto& block) {
    each_scattered(block, [&](std::size_t i) { block.apply(inverse_mass, i, block.impulse[i], v); });
  });
}

void divide(Rows& rows, int threads) {
  rows.threads = threads;
  for_each_block(rows.blocks, [&](auto& block) { block.divide(rows.inverse_mass, threads); });
}

void apply_impulses(const Rows& rows, Points& v, const std::vector<bool>& without) {
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    if (without.empty() || !without[b]) apply_impulses({&rows.blocks[b], 1}, rows.inverse_mass, v);
}

}  // namespace pbd
