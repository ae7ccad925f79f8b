#include "outer/free_components.h"

#include <algorithm>
#include <numeric>

namespace pbd {

FreeComponents::FreeComponents(const StepSystem& system) {
  const std::size_t nodes = system.problem.inverse_mass.size();
  component_.assign(nodes, -1);
  if (system.rows.contacts) return;
  std::iota(component_.begin(), component_.end(), 0);
  const auto root = [&](int node) {
    while (component_[node] != node) {
      auto& parent = component_[node];
      parent = component_[parent];
      node = parent;
    }
    return node;
  };
  std::vector<bool> held(nodes, false);
  for_each_block(system.rows.blocks, [&]<class Block>(const Block& block) {
    for (const auto& own : block.node) {
      for (const int node : own) component_[root(node)] = root(own[0]);
      if (Block::nodes == 1) held[own[0]] = true;
    }
  });
  std::vector<int> index(nodes, 0);  // of each root: -1 where something outside holds the component
  for (std::size_t node = 0; node < nodes; ++node)
    if (held[node] || !(system.problem.inverse_mass[node] > 0)) index[root(static_cast<int>(node))] = -1;
  int count = 0;
  for (std::size_t node = 0; node < nodes; ++node)
    if (component_[node] == static_cast<int>(node) && index[node] == 0) index[node] = count++;
  std::vector<int> of_node(nodes);
  for (std::size_t node = 0; node < nodes; ++node) of_node[node] = index[root(static_cast<int>(node))];
  std::fill(of_node.begin() + system.problem.bodies.nodes(), of_node.end(),
            -1);  // rotations have no linear momentum
  component_ = of_node;
  momentum_.resize(count);
}

void FreeComponents::restore_momentum(StepSystem& system) {
  const Problem& problem = system.problem;
  std::fill(momentum_.begin(), momentum_.end(), Eigen::Vector4d::Zero());
  const auto free_nodes = [&](auto&& f) {
    for (std::size_t node = 0; node < component_.size(); ++node)
      if (component_[node] >= 0) f(momentum_[component_[node]], static_cast<Eigen::Index>(node));
  };
  free_nodes([&](Eigen::Vector4d& sum, Eigen::Index node) {
    const double mass = 1 / problem.inverse_mass[node];
    sum.head<3>() += mass * (problem.map.v_free.col(node) - system.at.v.col(node));
    sum[3] += mass;
  });
  free_nodes([&](const Eigen::Vector4d& sum, Eigen::Index node) {
    system.at.v.col(node) += sum.head<3>() / sum[3];
    system.at.x.col(node) += problem.map.d * sum.head<3>() / sum[3];
  });
}

}  // namespace pbd
