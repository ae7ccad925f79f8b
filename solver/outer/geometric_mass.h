// The effects' geometric bounds as masses: D = d B/2 a column (kg), B a bound of -sum_i p_i d2c_i. `proximal`
// adds D to M; 2 D/M bounds what `plain` multiplies an error by.
#pragma once

#include "outer/step_system.h"

namespace pbd {

class GeometricMass {
 public:
  /// Fills `kg` by the bounds at the iterate, of the impulses (sign 1: what stiffens) or their opposites (-1:
  /// what softens). Returns the bound of plain's contraction that they give together; each effect's alone
  /// goes into its cost, the larger one of both signs if 1 was asked for first.
  double update(StepSystem& system, int sign);

  const std::vector<double>& kg() const { return kg_; }

 private:
  std::vector<double> kg_, own_;  // of all effects, and of one
};

}  // namespace pbd
