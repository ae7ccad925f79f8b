// The momentum of components that nothing outside holds.
#include <numeric>

#include "step_data.h"

namespace pbd {

void StepData::restore_momentum() {
  if (!heavier) return;
  std::fill(momentum.begin(), momentum.end(), Eigen::Vector4d::Zero());
  const auto free_nodes = [this](auto&& f) {
    for (std::size_t node = 0; node < component.size(); ++node)
      if (component[node] >= 0)
        f(momentum[static_cast<std::size_t>(component[node])], static_cast<Eigen::Index>(node),
          1 / inverse_mass[node]);
  };
  free_nodes([this](Eigen::Vector4d& sum, Eigen::Index node, double mass) {
    sum.head<3>() += mass * (map.v_free.col(node) - v.col(node));
    sum[3] += mass;
  });
  free_nodes([this](const Eigen::Vector4d& sum, Eigen::Index node, double) {
    v.col(node) += sum.head<3>() / sum[3];
    x.col(node) += map.d * sum.head<3>() / sum[3];
  });
}

void StepData::find_free_components() {
  const std::size_t nodes = inverse_mass.size();
  component.assign(nodes, -1);
  if (contacts.listed()) return;  // whatever touches, another step connects otherwise
  std::iota(component.begin(), component.end(), 0);
  const auto root = [this](int node) {
    while (component[static_cast<std::size_t>(node)] != node) {
      auto& parent = component[static_cast<std::size_t>(node)];
      parent = component[static_cast<std::size_t>(parent)];
      node = parent;
    }
    return node;
  };
  std::vector<bool> held(nodes, false);
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (const auto& own : block.node) {
      for (const int node : own) component[static_cast<std::size_t>(root(node))] = root(own[0]);
      if (Block::nodes == 1) held[static_cast<std::size_t>(own[0])] = true;
    }
  });
  std::vector<int> index(nodes, 0);  // of each root: -1 where something outside holds the component
  for (std::size_t node = 0; node < nodes; ++node)
    if (held[node] || !(inverse_mass[node] > 0))
      index[static_cast<std::size_t>(root(static_cast<int>(node)))] = -1;
  int count = 0;
  for (std::size_t node = 0; node < nodes; ++node)
    if (component[node] == static_cast<int>(node) && index[node] == 0) index[node] = count++;
  std::vector<int> of_node(nodes);
  for (std::size_t node = 0; node < nodes; ++node)
    of_node[node] = index[static_cast<std::size_t>(root(static_cast<int>(node)))];
  std::fill(of_node.begin() + bodies.nodes(), of_node.end(), -1);  // rotations have no linear momentum
  component = of_node;
  momentum.resize(static_cast<std::size_t>(count));
}

}  // namespace pbd
