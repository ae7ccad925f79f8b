// Times of what is done again and again.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "geometry.h"

namespace pbdcheck {

/// Seconds that f() takes: of each of five repeats the smallest of three, after a call that is thrown away.
template <class F>
std::vector<double> repeated_seconds(F&& f) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t repeats = 5, tries = 3;
  f();
  std::vector<double> best(repeats, pbd::infinity);
  for (std::size_t k = 0; k < repeats * tries; ++k) {
    const auto start = Clock::now();
    f();
    double& smallest = best[k / tries];
    smallest = std::min(smallest, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

}  // namespace pbdcheck
