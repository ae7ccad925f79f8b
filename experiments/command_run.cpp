#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "choices.h"
#include "commands.h"
#include "error.h"
#include "files.h"
#include "progress.h"
#include "provenance.h"

namespace pbdcheck {
namespace {

enum class Outcome { complete, failed, interrupted };
constexpr std::array<std::string_view, 3> outcome_names{"complete", "failed", "interrupted"};

std::vector<Experiment> chosen(const RunOptions& options, const std::vector<Experiment>& known) {
  if (options.all == !options.experiments.empty())
    throw pbd::SetupError("run", options.all ? "names and --all" : "nothing to run",
                          "EXPERIMENT... or --all");
  if (options.all) return known;
  std::vector<std::string> names;
  for (const auto& experiment : known) names.emplace_back(experiment.name);
  std::vector<Experiment> list;
  for (const auto& name : options.experiments) {
    require_name("run", name, names);
    list.push_back(
        known[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())]);
  }
  return list;
}

nlohmann::ordered_json settings_json(const RunOptions& options) {
  return {{"tier", options.tier}};
}

/// Whether `directory` holds a complete run by this very program, with the same tier and settings.
bool already_complete(const std::filesystem::path& directory, const RunOptions& options) {
  std::ifstream in(directory / "run.json");
  if (!in) return false;
  const auto record = nlohmann::ordered_json::parse(in, nullptr, false);
  return record.is_object() && from_this_build(record) && record.value("status", "") == outcome_names[0] &&
         record.value("tier", "") == options.tier &&
         record.value("settings", nlohmann::ordered_json()) == settings_json(options);
}

Outcome run_guarded(const Experiment& experiment, Context& context, std::string& reason) {
  try {
    experiment.run(context);
    return Outcome::complete;
  } catch (const Interrupted&) {
    return Outcome::interrupted;
  } catch (const std::exception& failure) {
    reason = failure.what();
    error_message(fmt::format("{}: {}", experiment.name, reason));
    return Outcome::failed;
  }
}

void report_failures(const Experiment& experiment, const Context& context) {
  for (const auto& verdict : context.verdicts())
    if (!verdict.holds())
      fmt::print("{} {}: FAILS: {} = {:.6g} > {:.6g} ({})\n", experiment.name, verdict.id, verdict.quantity,
                 verdict.measured, verdict.bound, verdict.statement);
}

struct Summary {
  Outcome outcome;
  std::int64_t failed_verdicts;
};

Summary run_one(const Experiment& experiment, const RunOptions& options) {
  const auto directory = options.directory / experiment.name;
  require_writable(directory);
  std::filesystem::remove(directory / "run.json");  // what follows replaces the results it described
  Context context(directory, options.tier == "full" ? Tier::full : Tier::quick, options.threads);
  const auto start = std::chrono::steady_clock::now();
  std::string reason;
  const Outcome outcome = run_guarded(experiment, context, reason);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  context.write_verdicts();
  report_failures(experiment, context);

  const auto& verdicts = context.verdicts();
  const auto holding =
      std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.holds(); });
  const auto failing = static_cast<std::int64_t>(verdicts.size()) - holding;
  auto record = provenance(options.threads);
  record["experiment"] = experiment.name;
  record["tier"] = options.tier;
  record["settings"] = settings_json(options);
  record["wall_s"] = wall.count();
  record["verdicts"] = {{"holds", holding}, {"fails", failing}};
  record["status"] = outcome_names[static_cast<std::size_t>(outcome)];
  if (!reason.empty()) record["reason"] = reason;
  write_json(directory / "run.json", record);
  fmt::print("{}: {}, {} verdicts hold, {} fail, {:.1f} s\n", experiment.name,
             record["status"].get<std::string>(), holding, failing, wall.count());
  return {outcome, failing};
}

}  // namespace

int run(const RunOptions& options, const std::vector<Experiment>& known) {
  require_name("--tier", options.tier, strings(tier_names));
  if (options.threads < 1)
    throw pbd::SetupError("--threads", std::to_string(options.threads), "an integer >= 1");
  const auto list = chosen(options, known);
  require_writable(options.directory);
  int exit_code = exit_done;
  for (const auto& experiment : list) {
    if (options.resume && already_complete(options.directory / experiment.name, options)) {
      fmt::print("{}: complete already, skipped\n", experiment.name);
      continue;
    }
    const Summary summary = run_one(experiment, options);
    if (summary.outcome == Outcome::interrupted) return exit_interrupted;
    if (summary.outcome == Outcome::failed || summary.failed_verdicts > 0) exit_code = exit_failed;
  }
  return exit_code;
}

}  // namespace pbdcheck
