// Sweeps over the rows of a step, on several threads.
#pragma once

#include <string_view>
#include <vector>

#include "linear/linear_solver.h"
#include "rows/rows.h"
#include "studies/cost/repeated_seconds.h"

namespace pbdcheck {

/// A relaxation that goes on over the same rows.
struct Sweeps {
  pbd::Rows rows;
  pbd::Points v;  // m/s
  pbd::LinearSolver solver;

  Sweeps(const pbd::Rows& of, const pbd::Points& from, std::string_view relaxation, int threads = 1)
      : rows(of), v(from), solver(pbd::make_linear_solver(relaxation)) {
    divide(rows, threads);
    std::visit([&](auto& kind) { kind.begin(rows, v, true); }, solver);
  }
  void sweep() {
    std::visit([&](auto& kind) { kind.sweep(rows, v, nullptr); }, solver);
  }
};

struct Swept {
  std::vector<double> seconds;  // of a sweep, by repeats
  pbd::Points v;                // m/s, after so many sweeps
};

/// Sweeps of `relaxation` from velocities v.
inline Swept swept(const pbd::Rows& rows, const pbd::Points& v, std::string_view relaxation, int threads) {
  Sweeps sweeps(rows, v, relaxation, threads);
  const std::vector<double> seconds = repeated_seconds([&] { sweeps.sweep(); });
  return {seconds, sweeps.v};
}

}  // namespace pbdcheck
