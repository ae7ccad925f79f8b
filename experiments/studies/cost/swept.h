// Sweeps over the rows of a step, on several threads.
#pragma once

#include <string_view>
#include <vector>

#include "linear/linear_solver.h"
#include "rows/rows.h"
#include "studies/cost/repeated_seconds.h"

namespace pbdcheck {

struct Swept {
  std::vector<double> seconds;  // of a sweep, by repeats
  pbd::Points v;                // m/s, after so many sweeps
};

/// Sweeps of `relaxation` from velocities v.
inline Swept swept(pbd::Rows rows, const pbd::Points& v, std::string_view relaxation, int threads) {
  Swept result{{}, v};
  divide(rows, threads);
  pbd::LinearSolver any = pbd::make_linear_solver(relaxation);
  std::visit(
      [&](auto& kind) {
        kind.begin(rows, result.v, true);
        result.seconds = repeated_seconds([&] { kind.sweep(rows, result.v, nullptr); });
      },
      any);
  return result;
}

}  // namespace pbdcheck
