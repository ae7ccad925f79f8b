// Baselines: tables of experiments (tier quick) that are kept with the sources, beside which a loss of
// accuracy shows that no verdict's bound would. They are compared cell by cell:
//
//   text                                         equal
//   sweeps, row_updates, outer_iterations        10 % and two
//   errors, residuals and differences            half of themselves and 1e-11: a factor of 3/2 shows,
//                                                rounding does not
//   other numbers                                1e-6 of themselves and 1e-11
//   measured_rate                                likewise, but on another machine twice the least rate that
//                                                can be told
//   times (wall_s, cpu_s)                        not at all: they are not kept
//
// NaN equals NaN alone. On another processor or by another compiler rounding is another: errors may differ
// threefold, other numbers by 1e-4.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pbdcheck {

/// The folder of an experiment's baseline, there or not.
std::filesystem::path baseline_of(std::string_view experiment);

/// True if there is one.
bool is_baseline(const std::filesystem::path& baseline);

/// How the tables of an experiment's `results` differ from its baseline, worst first, a line each; empty if
/// they do not. Throws SetupError if a table cannot be read.
std::vector<std::string> differences(const std::filesystem::path& baseline,
                                     const std::filesystem::path& results);

/// Makes the tables of an experiment's `results` its baseline, with `reason` and the machine beside them;
/// tables above 64 kB are left out. Throws SetupError unless they are of a whole run at tier quick.
void bless_results(const std::filesystem::path& results, const std::filesystem::path& baseline,
                   const std::string& reason);

}  // namespace pbdcheck
