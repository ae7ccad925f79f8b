#include "cones/velocity_share.h"

#include <limits>

#include "dense.h"

namespace pbdcheck {

double velocity_share(const pbd::reference::ConeProblem& problem, const pbd::reference::ConeSolution& a,
                      const pbd::reference::ConeSolution& b, double residuals) {
  const double stiffest = pbd::reference::symmetric_eigen(problem.delassus).values.maxCoeff(),
               size = problem.free_velocity.norm();
  const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(a.impulse.size()) *
                          (stiffest * a.impulse.norm() + size);
  const double dr = (a.impulse - b.impulse).norm(), du = (a.velocity - b.velocity).norm();
  return du == 0 ? 0.0 : du * du / (stiffest * (residuals * size + rounding) * (dr + du));
}

}  // namespace pbdcheck
