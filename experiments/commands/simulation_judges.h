// The judges of a simulation's steps: which is asked, what it takes, and what is told of them in run.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/step_checks.h"
#include "harness/step_judge.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

nlohmann::ordered_json checks_json(const StepChecks& checks);
void write_checks(const std::filesystem::path& path, const StepChecks& checks, TableTotals& totals);
nlohmann::ordered_json judged_json(const StepJudge& judge);

/// N of "every=N"; throws SetupError.
std::int64_t every_of(const std::string& text);

/// Throws SetupError for what the judge does not solve, before anything is computed.
void require_judgeable(const SceneFile& file, std::int64_t every);

}  // namespace pbdcheck
