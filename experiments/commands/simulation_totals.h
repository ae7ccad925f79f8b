// What the steps of a run reached, summed up.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "step/step.h"

namespace pbdcheck {

/// One step's residual: NaN if it diverged, infinite where nothing moves, as there is no scale.
struct WorstStep {
  double residual = 0;
  std::int64_t step = 0;     // 0: none yet
  std::string constraint{};  // most of it; empty where none is told
  std::string reason{};      // why it is not ok; empty if it is

  /// True if there is none yet, or if the report's residual is larger, or NaN where this one is not.
  bool is_less_than(const pbd::Report& report) const;
  /// For people.
  std::string text() const;
};

struct SimulationTotals {
  std::int64_t steps = 0;
  std::array<std::int64_t, pbd::status_names.size()> by_status{};
  std::int64_t outer_iterations = 0;
  std::int64_t sweeps = 0;
  std::int64_t row_updates = 0;
  WorstStep worst, worst_missed;    // of all steps, and of those that are not ok
  std::int64_t steps_in_parts = 0;  // that diverged as a whole
  int most_parts = 1;

  /// `name` tells a constraint.
  void add(const pbd::Report& report, int parts,
           const std::function<std::string(const pbd::ConstraintIndex&)>& name);

  std::int64_t missed() const { return steps - by_status[0]; }
};

/// As in run.json, with what each effect cost.
nlohmann::ordered_json report_json(const SimulationTotals& totals, const pbd::Workspace& workspace);

}  // namespace pbdcheck
