// Which one-sided limits stop something in a step, as far as it is known: there integrators that carry
// something on begin anew (step/integrators.h).
//
// A limit is idle where it has no impulse, or no more of it than is rounding of what would close it. One
// stops what comes where it is idle as the step begins, or was as the last one began, and is met in the step:
// a step that meets a limit ends on it, still on its way. One that gives way stops, too, since steps may be
// too long to tell it from a hard one. And so does one that is idle as the step begins and has an impulse at
// its end, foreseen or not.
#pragma once

#include <vector>

#include "rows/row_operations.h"

namespace pbd {

class LimitStops {
 public:
  /// Looks at all limits of a step that begins; those without rows are idle. at(i) sets J of constraint i
  /// there and returns its value and its largest coordinate (m); hard(i) is true if it gives no way.
  template <int K, class At, class Hard>
  void find(const StepBegin& begin, const std::vector<ForceBounds>& bounds, RowBlock<1, K>& block, At&& at,
            Hard&& hard) {
    stops_ = false;
    was_idle_.swap(idle_);
    was_idle_.resize(bounds.size(), true);
    idle_.assign(bounds.size(), true);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::size_t entry = block.entry(i);
      const auto& [lower, upper] = bounds[entry];
      if ((lower == 0) == (upper == 0)) {
        idle_[entry] = false;
        continue;
      }
      idle_[entry] = !holds(block, i, begin.v);
      stops_ = stops_ || (begin.limits == Limits::holds && !idle_[entry] && hard(i));
      if (stops_ || !(idle_[entry] || was_idle_[entry])) continue;
      const auto [value, size] = at(i);
      stops_ = RowOperations<1, K>::meets(begin, lower == 0 ? value : -value, lower == 0, size, block, i);
    }
  }

  /// With the impulses that the block has now, at the velocities v.
  template <int K>
  bool any(const RowBlock<1, K>& block, const Points& v) const {
    bool stops = stops_;
    for (std::size_t i = 0; i < block.size() && !idle_.empty(); ++i)
      stops = stops || (idle_[block.entry(i)] && holds(block, i, v));
    return stops;
  }

 private:
  template <int K>
  static bool holds(const RowBlock<1, K>& block, std::size_t i, const Points& v) {
    constexpr double rounding = 1e-9;
    const double impulse = block.impulse[i][0];
    if (impulse == 0) return false;
    const double open = block.residual(v, i, block.impulse[i])[0];
    return !(std::abs(impulse) <= rounding * std::abs(open) * block.inverse_diagonal[i](0, 0));
  }

  std::vector<bool> idle_, was_idle_;  // as this step began and the last one, of all constraints of an effect
  bool stops_ = false;                 // foreseen
};

}  // namespace pbd
