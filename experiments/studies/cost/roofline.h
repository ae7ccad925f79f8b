// The part of the experiment `threads` that asks how near sweeps over each effect's rows come to what the
// machine could do (williams2009roofline).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/experiment.h"
#include "rows/rows.h"

namespace pbdcheck {

/// A block of rows of one effect, with its columns.
struct EffectRows {
  pbd::AnyBlock block;
  std::vector<double> inverse_mass;  // 1/kg
  pbd::Points v;                     // m/s
};

/// Of each effect, and of each shape that its rows have, the first ones of generated worlds.
std::map<std::string, EffectRows> rows_of_effects();

/// The table `roofline` and its verdict. `copied` are bytes a second that copying moves, on one thread, on
/// two, and so on.
void roofline(Context& context, const std::map<std::string, EffectRows>& effects,
              const std::vector<double>& copied);

}  // namespace pbdcheck
