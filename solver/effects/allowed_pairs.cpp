#include "effects/allowed_pairs.h"

#include <algorithm>

namespace pbd {

AllowedPairs::AllowedPairs(const Scene& scene, const Contact& effect) : apart_(effect.apart) {
  const bool nodes = effect.nodes_touch || (!effect.node.empty() && !effect.triangle.empty());
  const auto link = [&](const auto& elements) {
    for (const auto& nodes : elements)
      for (const int a : nodes)
        for (const int b : nodes) linked_.push_back({a, b});
  };
  for (const Effect& other : scene.effects)
    std::visit(
        [&]<class E>(const E& joint) {
          if constexpr (requires { joint.body[0][1]; })
            apart_.insert(apart_.end(), joint.body.begin(), joint.body.end());
          if constexpr (requires { joint.node[0][1]; })
            if (nodes) link(joint.node);
          if constexpr (std::same_as<E, Attachment>)
            for (std::size_t i = 0; i < joint.node.size(); ++i)
              attached_.push_back({joint.node[i], joint.body[i]});
        },
        other);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    attached_.push_back({scene.bodies[body].node, static_cast<int>(body)});
  for (auto& pair : apart_)
    if (pair[0] > pair[1]) std::swap(pair[0], pair[1]);
  std::sort(apart_.begin(), apart_.end());
  std::sort(attached_.begin(), attached_.end());
  std::sort(linked_.begin(), linked_.end());
}

bool AllowedPairs::bodies(int first, int second) const {
  const std::array<int, 2> pair{std::min(first, second), std::max(first, second)};
  return !std::binary_search(apart_.begin(), apart_.end(), pair);
}

bool AllowedPairs::nodes(int first, int second) const {
  return first != second && !std::binary_search(linked_.begin(), linked_.end(), std::array{first, second});
}

std::vector<int> AllowedPairs::linked_to(int node) const {
  std::vector<int> nodes;
  auto pair = std::lower_bound(linked_.begin(), linked_.end(), std::array{node, -1});
  for (; pair != linked_.end() && (*pair)[0] == node; ++pair) nodes.push_back((*pair)[1]);
  return nodes;
}

bool AllowedPairs::node_and_body(int node, int body) const {
  return !std::binary_search(attached_.begin(), attached_.end(), std::array{node, body});
}

}  // namespace pbd
