#include "outer/lbfgs.h"

#include <algorithm>

#include "rows/mass_norm.h"

namespace pbd {

void Lbfgs::learn(const Points& step, const Points& change) {
  const double curvature = dot(step, change);
  constexpr double least = 1e-12;  // of the product of lengths: no curvature is known below
  if (memory_ == 0 || !(curvature > least * step.norm() * change.norm())) return;
  const auto slot = static_cast<std::size_t>(count_ % memory_);
  if (steps_.size() <= slot) {
    steps_.resize(slot + 1);
    changes_.resize(slot + 1);
    curvature_.resize(slot + 1);
  }
  steps_[slot] = step;
  changes_[slot] = change;
  curvature_[slot] = curvature;
  ++count_;
}

void Lbfgs::direction(const Points& gradient, Metric& metric, Points& result) {
  const int used = std::min(count_, memory_);
  alpha_.resize(used);
  q_ = -gradient;
  for (int k = 0; k < used; ++k) {  // newest first
    const int slot = (count_ - 1 - k) % memory_;
    alpha_[k] = dot(steps_[slot], q_) / curvature_[slot];
    q_ -= alpha_[k] * changes_[slot];
  }
  metric.solve(q_, result);
  for (int k = used - 1; k >= 0; --k) {
    const int slot = (count_ - 1 - k) % memory_;
    const double beta = dot(changes_[slot], result) / curvature_[slot];
    result += (alpha_[k] - beta) * steps_[slot];
  }
}

}  // namespace pbd
