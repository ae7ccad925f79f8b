// The momentum of components that nothing outside holds. A proximal term moves momentum from one iterate to
// the next, and a metric's factor rounds it, which vanishes as they converge; left before that, a step would
// lose or gain some.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "outer/components.h"
#include "outer/step_system.h"

namespace pbd {

class FreeComponents {
 public:
  /// Of nodes connected by rows; none where rows come and go, which another step connects otherwise.
  explicit FreeComponents(const StepSystem& system);

  /// Gives every component the linear momentum of v_free again, by a shift of v and x.
  void restore_momentum(StepSystem& system);

 private:
  std::vector<int> component_;             // of each node; -1 if held from outside
  std::vector<Eigen::Vector4d> momentum_;  // missing of each component (N s), and its mass (kg)
};

}  // namespace pbd
