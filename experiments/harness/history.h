// A line a run: what later runs are compared with.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "harness/results.h"
#include "harness/verdict.h"

namespace pbdcheck {

/// Of one experiment: its status, seconds, totals of work and verdicts.
nlohmann::ordered_json history_entry(std::string_view status, double seconds, const TableTotals& totals,
                                     const std::vector<Verdict>& verdicts);

/// Appends `record` as one line in one write, so that a program that is killed leaves no half line. A line
/// that has no end is left alone: the new one begins below it. Throws SetupError if it cannot be written.
void append_history(const std::filesystem::path& path, const nlohmann::ordered_json& record);

}  // namespace pbdcheck
