#include "linear/natural_residual.h"

#include <cmath>

#include "rows/laws.h"
#include "rows/velocity_system.h"

namespace pbd {

double natural_residual(const Rows& rows, const Points& v) {
  double squared = 0;
  each_constraint(rows, [&](const auto& block, std::size_t i, Eigen::Index) {
    squared += squared_residual(block, i, block.residual(v, i, block.impulse[i]));
  });
  return std::sqrt(squared);
}

}  // namespace pbd
