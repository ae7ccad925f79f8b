// The cells of the maps of `stability_map`: steps over two parameters, each solved by several methods.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "harness/experiment.h"
#include "step/step.h"
#include "studies/iteration/auto_cost.h"

namespace pbdcheck {

/// Steps over `value` (a mass ratio, a Young's modulus) and step, made by `make`.
struct StabilityMap {
  std::string scene, value_column;
  std::vector<double> values, steps;
  Case (*make)(double value, double h);
};

/// A step by one method.
struct MapSolve {
  pbd::Method method;
  double iterations = std::nan("");  // until the error is first `reached`
  double error = std::nan("");       // at the step's end
  pbd::Report report{};
  std::string status{}, reason{};
};

struct MapCell : SolvedStep {
  std::vector<MapSolve> solves{};
};

std::vector<MapCell> run_map(const Context& context, const StabilityMap& map,
                             const std::vector<pbd::Method>& all);

const MapSolve& solve_by_auto(const MapCell& cell);

/// Verdicts and the table `predictions`: does plain converge where the solver and dense matrices say so?
void prediction_verdicts(Context& context, const std::vector<MapCell>& cells);

/// Of bodies no dense matrices are known: whether plain returns to the solution against what was predicted.
void joint_verdict(Context& context, const std::vector<MapCell>& cells);

}  // namespace pbdcheck
