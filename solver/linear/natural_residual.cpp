#include "linear/natural_residual.h"

namespace pbd {

double natural_residual(const Rows& rows, const Points& v) {
  return natural_residual_of(rows, [&](const auto& block, std::size_t i, Eigen::Index) {
    return block.residual(v, i, block.impulse[i]);
  });
}

}  // namespace pbd
