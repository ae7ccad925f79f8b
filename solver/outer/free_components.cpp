#include "outer/free_components.h"

#include <algorithm>

namespace pbd {

FreeComponents::FreeComponents(const StepSystem& system) {
  component_.assign(system.problem.inverse_mass.size(), -1);
  if (system.rows.contacts) return;
  Components connected;
  connected.find(system.rows, system.problem.inverse_mass);
  momentum_.resize(connected.count());
  for (int node = 0; node < system.problem.bodies.nodes(); ++node) {  // rotations have no linear momentum
    const int component = connected.of_column[node];
    if (component >= 0 && !connected.held[component]) component_[node] = component;
  }
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
