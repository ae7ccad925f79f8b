// Times of what is done again and again.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "geometry.h"

namespace pbdcheck {

/// Seconds that f() takes, the least of three times, after a call that is thrown away.
template <class F>
double least_seconds(F&& f) {
  using Clock = std::chrono::steady_clock;
  constexpr int tries = 3;
  f();
  double least = pbd::infinity;
  for (int k = 0; k < tries; ++k) {
    const auto start = Clock::now();
    f();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return least;
}

/// The same five times.
template <class F>
std::vector<double> repeated_seconds(F&& f) {
  constexpr int repeats = 5;
  std::vector<double> all;
  for (int k = 0; k < repeats; ++k) all.push_back(least_seconds(f));
  return all;
}

}  // namespace pbdcheck
