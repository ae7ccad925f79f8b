#include "outer/acceleration.h"

namespace pbd {

bool Acceleration::refuted(StepSystem& system, const Progress& progress, double too_much) {
  const double residual = progress.residual();
  const bool refuted = accelerated_ && residual > too_much * last_residual_;
  if (refuted) reject(system);
  last_residual_ = residual;
  return refuted;
}

}  // namespace pbd
