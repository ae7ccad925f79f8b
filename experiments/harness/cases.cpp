#include "harness/cases.h"

#include <fmt/format.h>

#include "scenes/mechanisms.h"
#include "scenes/standard.h"

namespace pbdcheck {

Case swinging_chain(double ratio, double h) {
  constexpr double lead_step = 1.0 / 100;  // s
  constexpr int lead_steps = 30;           // to the middle of the swing
  return {fmt::format("chain20 tip x{:g}", ratio), chain(20, ratio), h, lead_step, lead_steps};
}

Case swinging_rods(double ratio, double h) {
  constexpr double lead_step = 1.0 / 100;  // s
  constexpr int lead_steps = 30;
  return {fmt::format("rods10 tip x{:g}", ratio), rod_chain(10, ratio), h, lead_step, lead_steps};
}

std::vector<double> chain_ratios(bool full) {
  if (full) return {1, 2, 3, 5, 10, 20, 30, 50, 100, 200, 300, 500, 1000};
  return {1, 3, 10, 30, 100, 300, 1000};
}

std::vector<double> chain_steps(bool full) {
  if (full)
    return {1.0 / 30, 1.0 / 42, 1.0 / 60, 1.0 / 85, 1.0 / 120, 1.0 / 170, 1.0 / 240, 1.0 / 340, 1.0 / 480};
  return {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480};
}

}  // namespace pbdcheck
