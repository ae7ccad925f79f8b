#include "rows.h"

#include <cmath>

namespace pbd {

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
      if (block.compliance[i].isZero(0) && !block.opens(i)) block.bias[i] *= factor;
  });
}

void apply_impulses(const Rows& rows, Points& v, const std::vector<bool>& without) {
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    if (without.empty() || !without[b])
      std::visit(
          [&](const auto& block) {
            for (std::size_t i = 0; i < block.size(); ++i)
              block.apply(rows.inverse_mass, i, block.impulse[i], v);
          },
          rows.blocks[b]);
}

}  // namespace pbd
