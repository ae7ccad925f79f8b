// One reader for each format of mesh files: nodes and elements as they stand in the file.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <unordered_map>
#include <vector>

#include "scenes/lines.h"

namespace pbdcheck {

/// What a file holds: nodes, and elements of K nodes (3 triangles, 4 tetrahedra) by the nodes' places in `x`.
template <std::size_t K>
class Elements {
 public:
  std::vector<std::array<double, 3>> x;
  std::vector<std::array<int, K>> nodes;

  void add_node(const Lines& lines, std::int64_t number, const std::array<double, 3>& position) {
    if (!index_of_.emplace(number, static_cast<int>(x.size())).second)
      lines.refuse(fmt::format("node {} twice", number), "each node once");
    x.push_back(position);
  }

  /// An element of the nodes with these numbers in the file.
  void add(const Lines& lines, const std::array<std::int64_t, K>& numbers) {
    std::array<int, K> element{};
    for (std::size_t i = 0; i < K; ++i) {
      const auto entry = index_of_.find(numbers[i]);
      if (entry == index_of_.end()) lines.refuse(fmt::format("node {}", numbers[i]), "a node of this file");
      element[i] = entry->second;
      if (std::find(element.begin(), element.begin() + i, element[i]) != element.begin() + i)
        lines.refuse(fmt::format("node {} twice in an element", numbers[i]), "different nodes");
    }
    nodes.push_back(element);
    std::sort(element.begin(), element.end());
    if (!known_.insert(element).second)
      lines.refuse("an element of the same nodes as one before", "each element once");
  }

  /// An element of the nodes that the words from `first` on name.
  void add(const Lines& lines, std::size_t first) {
    std::array<std::int64_t, K> numbers{};
    for (std::size_t i = 0; i < K; ++i) numbers[i] = lines.integer(first + i);
    add(lines, numbers);
  }

 private:
  std::unordered_map<std::int64_t, int> index_of_;  // of a node's number in the file
  std::set<std::array<int, K>> known_;              // sorted nodes of each element
};

/// Gmsh's elements of K nodes.
template <std::size_t K>
Elements<K> read_msh(const std::filesystem::path& file);

Elements<4> read_tetgen(std::filesystem::path file);
Elements<3> read_obj(const std::filesystem::path& file);
Elements<3> read_off(const std::filesystem::path& file);

}  // namespace pbdcheck
