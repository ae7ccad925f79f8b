// Where results come from: the program, the machine and the settings, as run.json keeps them.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace pbdcheck {

/// How a command or an experiment ended, as `status` in run.json.
enum class RunOutcome { complete, failed, interrupted, refuted };
inline constexpr std::array<std::string_view, 4> outcome_names{"complete", "failed", "interrupted",
                                                               "refuted"};

/// Whether a run.json was written by this very program: the same commit ("unknown" outside a git work tree)
/// and the same differences from it.
bool from_this_build(const nlohmann::ordered_json& record);

/// "pbdcheck VERSION (COMMIT)" and the libraries with their versions, one a line.
std::string version_text();

/// The fields every run.json has: commit, dirty, changes (a hash of the differences from the commit),
/// version, compiler, flags, march (what the compiler made of -march), date (UTC, now), system, processor,
/// cores (that run at once), load (of the last minute, this program's own threads included), threads, seed,
/// libraries; status, and reason unless that is empty.
nlohmann::ordered_json run_record(int threads, RunOutcome outcome, const std::string& reason);

/// As files keep it: two spaces of indentation.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace pbdcheck
