#include "rows/chunks.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace pbd {

std::size_t chunk_length(std::size_t constraints, std::size_t bytes, bool friction) {
  constexpr std::size_t least_bytes = 65536, least_with_friction = 8192;
  return std::max((friction ? least_with_friction : least_bytes) / bytes,
                  (constraints + most_chunks - 1) / most_chunks);
}

void divide(std::span<const int> columns, int columns_of_each, std::size_t length,
            const std::vector<double>& inverse_mass, bool fixed_are_shared, Chunks& chunks) {
  const std::size_t stride = length * static_cast<std::size_t>(columns_of_each);
  const std::size_t count = (columns.size() + stride - 1) / stride;
  chunks.order.clear();
  chunks.colour.clear();
  if (count <= 1) return;
  constexpr int shared_colours = 63;
  std::vector<int>& colour_of = chunks.colour_of;
  chunks.taken.assign(inverse_mass.size(), 0);
  colour_of.resize(count);
  int alone = shared_colours;
  for (std::size_t k = 0; k < count; ++k) {
    const auto own = columns.subspan(k * stride, std::min(stride, columns.size() - k * stride));
    std::uint64_t others = 0;
    for (const int column : own) others |= chunks.taken[static_cast<std::size_t>(column)];
    const int first = std::countr_one(others);
    colour_of[k] = first < shared_colours ? first : alone++;
    const std::uint64_t bit = std::uint64_t{1} << std::min(first, shared_colours);
    for (const int column : own)
      if (!fixed_are_shared || inverse_mass[static_cast<std::size_t>(column)] > 0)
        chunks.taken[static_cast<std::size_t>(column)] |= bit;
  }
  chunks.order.resize(count);
  std::iota(chunks.order.begin(), chunks.order.end(), 0);
  std::sort(chunks.order.begin(), chunks.order.end(),
            [&](int a, int b) { return std::pair(colour_of[a], a) < std::pair(colour_of[b], b); });
  for (std::size_t k = 0; k < count; ++k)
    if (k == 0 || colour_of[chunks.order[k]] != colour_of[chunks.order[k - 1]])
      chunks.colour.push_back(static_cast<int>(k));
  chunks.colour.push_back(static_cast<int>(count));
}

}  // namespace pbd
