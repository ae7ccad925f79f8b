#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "error.h"
#include "harness/files.h"
#include "harness/progress.h"
#include "harness/provenance.h"
#include "scenes/choices.h"

namespace pbdcheck {
namespace {

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

nlohmann::ordered_json tier_json(const RunOptions& options) {
  return {{"tier", options.tier}};
}

/// Whether `directory` holds a complete run by this very program, with the same tier and settings.
bool already_complete(const std::filesystem::path& directory, const RunOptions& options) {
  const auto file = directory / "run.json";
  if (!std::filesystem::is_regular_file(file)) return false;
  std::ifstream in(file);
  const auto record = nlohmann::ordered_json::parse(in, nullptr, false);
  try {
    return record.is_object() && from_this_build(record) && record.value("status", "") == outcome_names[0] &&
           record.value("tier", "") == options.tier &&
           record.value("settings", nlohmann::ordered_json()) == tier_json(options);
  } catch (const nlohmann::ordered_json::type_error& error) {
    throw pbd::SetupError(file.string(), error.what(),
                          "a record as `run` writes it; without one the experiment is run again");
  }
}

/// How an experiment ended; `exit_code` is what that makes of the program's.
struct Ending {
  RunOutcome outcome;
  int exit_code;
  std::string reason;
};

Ending run_guarded(const Experiment& experiment, Context& context) {
  try {
    experiment.run(context);
    return {RunOutcome::complete, exit_done, ""};
  } catch (const Interrupted&) {
    return {RunOutcome::interrupted, exit_interrupted, "stopped by the user"};
  } catch (const pbd::SetupError& failure) {  // a result that cannot be written
    return {RunOutcome::failed, exit_usage, failure.what()};
  } catch (const std::exception& failure) {
    return {RunOutcome::failed, exit_failed, failure.what()};
  }
}

/// Removes the tables of an earlier run, so that the folder never holds those of two runs.
void remove_tables(const std::filesystem::path& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (entry.is_regular_file() && entry.path().extension() == ".csv") std::filesystem::remove(entry.path());
}

void report_failures(const Experiment& experiment, const Context& context) {
  for (const auto& verdict : context.verdicts())
    if (!verdict.holds())
      fmt::print("{} {}: FAILS: {} = {:.6g} > {:.6g} ({})\n", experiment.name, verdict.id, verdict.quantity,
                 verdict.measured, verdict.bound, verdict.statement);
}

/// Runs it and records it; returns what that makes of the exit code.
int run_one(const Experiment& experiment, const RunOptions& options) {
  const auto directory = options.directory / experiment.name;
  require_writable(directory);
  Context context(directory, options.tier == "full" ? Tier::full : Tier::quick, options.threads);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::int64_t holding = 0, failing = 0;
  const auto record = [&](RunOutcome outcome, const std::string& reason) {
    auto json = run_record(options.threads, outcome, reason);
    json["experiment"] = experiment.name;
    json["tier"] = options.tier;
    json["settings"] = tier_json(options);
    json["wall_s"] = seconds();
    json["rows"] = context.rows();
    json["verdicts"] = {{"holds", holding}, {"fails", failing}};
    write_file(directory / "run.json", json_text(json));
  };
  record(RunOutcome::interrupted, "ended before it was done");  // until it is: the program may be killed
  remove_tables(directory);
  const auto [outcome, exit_code, reason] = run_guarded(experiment, context);
  context.write_verdicts();
  if (outcome == RunOutcome::failed) error_message(fmt::format("{}: {}", experiment.name, reason));
  report_failures(experiment, context);
  for (const auto& verdict : context.verdicts()) ++(verdict.holds() ? holding : failing);
  record(outcome, reason);
  fmt::print("{}: {}, {} verdicts hold, {} fail, {:.1f} s\n", experiment.name,
             outcome_names[static_cast<std::size_t>(outcome)], holding, failing, seconds());
  return exit_code == exit_done && failing > 0 ? exit_failed : exit_code;
}

}  // namespace

int run(const RunOptions& options, const std::vector<Experiment>& known) {
  require_name("--tier", options.tier, strings(tier_names));
  const auto list = chosen(options, known);
  require_writable(options.directory);
  int exit_code = exit_done;
  for (const auto& experiment : list) {
    if (options.resume && already_complete(options.directory / experiment.name, options)) {
      fmt::print("{}: complete already, skipped\n", experiment.name);
      continue;
    }
    exit_code = std::max(exit_code, run_one(experiment, options));
    if (exit_code == exit_interrupted) return exit_interrupted;
  }
  return exit_code;
}

}  // namespace pbdcheck
