// What a step reached.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "geometry.h"

namespace pbd {

/// A constraint by its effect's index in the scene and its own in the effect; a contact by its place among
/// the effect's in `Workspace::contacts`.
struct ConstraintIndex {
  std::size_t effect = 0, constraint = 0;
};

enum class Status { ok, not_converged, diverged };
inline constexpr std::array<std::string_view, 3> status_names{"ok", "not_converged", "diverged"};

/// Residuals are absolute, in sqrt(J).
struct Report {
  Status status = Status::ok;
  std::string_view reason;  // empty if ok
  int outer_iterations = 0;
  std::int64_t sweeps = 0;
  std::int64_t row_updates = 0;
  double primal = 0;
  double dual = 0;
  double scale = 0;
  double contraction = std::nan("");     // of plain at the step's end: what it multiplies an error by; an
                                         // estimate, for quasi_newton an upper bound
  std::optional<ConstraintIndex> worst;  // of a step that missed: what has the largest part of `dual`
  std::string_view linear_part;  // the linear solver, of `direct` the part, that worked last; empty if
                                 // nothing was relaxed

  /// Largest residual relative to `scale`; 0 if that vanishes and what is left is rounding, or nothing.
  double residual() const {
    const double largest = larger(primal, dual);
    return scale == 0 && (status == Status::ok || largest == 0) ? 0.0 : largest / scale;
  }
};

/// State of the iteration at an outer iterate, shown to an observer before the iterate is improved.
struct Iterate {
  int outer_iteration;
  std::int64_t sweeps;
  std::int64_t row_updates;
  double primal, dual, scale;
  const Points& x;  // x(v)
  const Points& v;
};
using Observer = std::function<void(const Iterate&)>;

}  // namespace pbd
