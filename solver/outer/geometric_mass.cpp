#include "outer/geometric_mass.h"

#include <algorithm>

namespace pbd {

double GeometricMass::update(StepSystem& system, int sign) {
  const Problem& problem = system.problem;
  const Configuration here{system.at.x, system.at.poses, problem.x_time};
  const auto bound_of = [&](const std::vector<double>& kg) {
    double largest = 0;
    for (std::size_t node = 0; node < kg.size(); ++node)
      largest = std::max(largest, 2 * kg[node] * problem.inverse_mass[node]);
    return largest;
  };
  kg_.assign(problem.inverse_mass.size(), 0.0);
  for (Slot& slot : system.slots) {
    if (slot.count == 0) continue;
    own_.assign(kg_.size(), 0.0);
    slot.source->add_geometric_mass(problem.map, here, sign * problem.direction_blend, slot.view(system.rows),
                                    own_);
    slot.cost.contraction = std::max(sign < 0 ? slot.cost.contraction : 0.0, bound_of(own_));
    for (std::size_t node = 0; node < kg_.size(); ++node) kg_[node] += own_[node];
  }
  double bound = bound_of(kg_);
  if (problem.bodies.count() > 0)
    bound +=
        problem.bodies.contraction(system.at.v, problem.map.d, problem.map.s, problem.implicit_gyroscopic);
  return bound;
}

}  // namespace pbd
