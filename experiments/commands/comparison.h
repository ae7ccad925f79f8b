// What comparisons of steps and of motions share: how they end, and their record and figure.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "commands/commands.h"
#include "harness/files.h"
#include "harness/provenance.h"
#include "harness/results.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

/// How a comparison ended.
struct Compared {
  RunOutcome outcome = RunOutcome::complete;
  std::string reason{};  // why it is not complete
  bool all_ok = true;    // every step of every method met its tolerance

  /// Where there is nothing to compare with.
  void fail(const std::string& why);
  void stop();  // by the user
};

/// run.json in the folder of the options; the time that it tells begins with its making.
class ComparisonRecord {
 public:
  explicit ComparisonRecord(const CompareOptions& options);

  /// What both kinds of comparison have been set to.
  nlohmann::ordered_json settings(const SceneFile& file, const std::string& reference) const;

  /// Writes the record, draws the figure, and returns the exit code.
  int close(const nlohmann::ordered_json& settings, const TableTotals& totals, const Compared& compared);

 private:
  const CompareOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  PartialFile file_;
};

/// Whole motions up to `options.until`.
int compare_motions(const CompareOptions& options, const SceneFile& file);

}  // namespace pbdcheck
