// The parts of the experiment `direction`, each a table and its verdicts, and what their rows share.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment.h"
#include "studies/time/direction_scenes.h"

namespace pbdcheck {

inline constexpr double direction_frame = 1.0 / 60;  // s, a step of a usual simulation

/// Every scheme as a user would take it.
std::vector<Scheme> default_schemes();

/// A table that begins with the scheme's columns; its rows end with status and reason.
Table direction_table(Context& context, std::string_view name, std::initializer_list<std::string> columns);
void add_row(Table& table, const std::string& scene, const Scheme& scheme, std::vector<Cell> values,
             const DirectionRun& run);

/// Largest stable steps: `largest_steps`.
void direction_largest_steps(Context& context);
/// What a step leaves of the taut chain's modes: `modes`.
void direction_modes(Context& context);
/// The pendulum's energy: `energy`.
void direction_energy(Context& context);
/// Violations of constraints at equal work: `equal_work`.
void direction_equal_work(Context& context);
/// Overlaps of shapes at equal work: `contact`.
void direction_contact(Context& context);
/// Frozen and refreshed directions, and a heavier M, on the taut chain: `contenders`.
void direction_contenders(Context& context);

}  // namespace pbdcheck
