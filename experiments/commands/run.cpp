#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/commands.h"
#include "error.h"
#include "harness/files.h"
#include "harness/history.h"
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
    if (std::count(options.experiments.begin(), options.experiments.end(), name) > 1)
      throw pbd::SetupError("run", name + " more than once", "each experiment once");
    list.push_back(
        known[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())]);
  }
  return list;
}

nlohmann::ordered_json tier_json(const RunOptions& options) {
  return {{"tier", options.tier}};
}

/// Whether the tables that `rows` counts are there, each with its columns and as many rows.
bool tables_are_whole(const std::filesystem::path& directory, const nlohmann::ordered_json& rows) {
  return !rows.empty() && std::all_of(rows.items().begin(), rows.items().end(), [&](const auto& table) {
    std::ifstream in(directory / (table.key() + ".csv"));
    std::int64_t lines = -1;
    for (std::string line; std::getline(in, line); ++lines)
      if (in.eof()) return false;  // the last line is cut off
    return lines == table.value().template get<std::int64_t>();
  });
}

/// What a complete run by this very program with the same tier and settings, whose tables are all there,
/// makes of the exit code; nothing if `directory` holds none.
std::optional<int> exit_code_of_complete(const std::filesystem::path& directory, const RunOptions& options) {
  const auto file = directory / "run.json";
  if (!std::filesystem::is_regular_file(file)) return std::nullopt;
  std::ifstream in(file);
  const auto record = nlohmann::ordered_json::parse(in, nullptr, false);
  try {
    const bool complete = record.is_object() && from_this_build(record) &&
                          record.value("status", "") == outcome_names[0] &&
                          record.value("tier", "") == options.tier &&
                          record.value("settings", nlohmann::ordered_json()) == tier_json(options) &&
                          tables_are_whole(directory, record.value("rows", nlohmann::ordered_json()));
    if (!complete) return std::nullopt;
    const auto verdicts = record.value("verdicts", nlohmann::ordered_json::object());
    return verdicts.value(std::string(ruling_names[static_cast<std::size_t>(Ruling::fails)]), 0) > 0
               ? exit_failed
               : exit_done;
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

void report_rulings(const Experiment& experiment, const Context& context) {
  constexpr std::array<std::string_view, 4> words{"", "FAILS", "goal missed", "not decided"};
  for (const auto& verdict : context.verdicts())
    if (verdict.ruling() != Ruling::holds)
      fmt::print("{} {}: {}: {}, {} ({}; {})\n", experiment.name, verdict.id,
                 words[static_cast<std::size_t>(verdict.ruling())], verdict.quantity, verdict.reason(),
                 verdict.statement, basis_names[static_cast<std::size_t>(verdict.basis)]);
}

using Counts = std::array<std::int64_t, ruling_names.size()>;

Counts counted(const Context& context) {
  Counts counts{};
  for (const auto& verdict : context.verdicts()) ++counts[static_cast<std::size_t>(verdict.ruling())];
  return counts;
}

nlohmann::ordered_json counts_json(const Counts& counts) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < counts.size(); ++i) json[std::string(ruling_names[i])] = counts[i];
  return json;
}

std::string counts_text(const Counts& counts) {
  auto text = fmt::format("{} verdicts hold, {} fail", counts[0], counts[1]);
  if (counts[2] > 0) text += fmt::format(", {} goals missed", counts[2]);
  if (counts[3] > 0) text += fmt::format(", {} not decided", counts[3]);
  return text;
}

/// Runs it, records it, also in `history`; returns what that makes of the exit code.
int run_one(const Experiment& experiment, const RunOptions& options, nlohmann::ordered_json& history) {
  const auto directory = options.directory / experiment.name;
  require_writable(directory);
  Context context(directory, options.tier == "full" ? Tier::full : Tier::quick, options.threads);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  Counts counts{};
  const auto record = [&](RunOutcome outcome, const std::string& reason) {
    auto json = run_record(options.threads, outcome, reason);
    json["experiment"] = experiment.name;
    json["tier"] = options.tier;
    json["settings"] = tier_json(options);
    json["wall_s"] = seconds();
    json["rows"] = context.totals().rows;
    json["verdicts"] = counts_json(counts);
    write_file(directory / "run.json", json_text(json));
  };
  record(RunOutcome::interrupted, "ended before it was done");  // until it is: the program may be killed
  remove_tables(directory);
  const auto [outcome, exit_code, reason] = run_guarded(experiment, context);
  context.write_verdicts();
  if (outcome == RunOutcome::failed) error_message(fmt::format("{}: {}", experiment.name, reason));
  report_rulings(experiment, context);
  counts = counted(context);
  record(outcome, reason);
  const auto status = outcome_names[static_cast<std::size_t>(outcome)];
  history[std::string(experiment.name)] =
      history_entry(status, seconds(), context.totals(), context.verdicts());
  fmt::print("{}: {}, {}, {:.1f} s\n", experiment.name, status, counts_text(counts), seconds());
  const bool failed = counts[static_cast<std::size_t>(Ruling::fails)] > 0;
  return exit_code == exit_done && failed ? exit_failed : exit_code;
}

nlohmann::ordered_json history_line(const RunOptions& options, const nlohmann::ordered_json& experiments) {
  const auto by = run_record(options.threads, RunOutcome::complete, "");
  nlohmann::ordered_json line{{"tier", options.tier}};
  for (const auto* key : {"date", "commit", "dirty", "changes", "processor", "threads"}) line[key] = by[key];
  line["experiments"] = experiments;
  return line;
}

}  // namespace

int run(const RunOptions& options, const std::vector<Experiment>& known) {
  require_name("--tier", options.tier, strings(tier_names));
  const auto list = chosen(options, known);
  require_writable(options.directory);
  int exit_code = exit_done;
  nlohmann::ordered_json history;
  for (const auto& experiment : list) {
    const auto before =
        options.resume ? exit_code_of_complete(options.directory / experiment.name, options) : std::nullopt;
    if (before) {
      fmt::print("{}: complete already{}, skipped\n", experiment.name,
                 *before == exit_failed ? ", with verdicts that fail" : "");
      exit_code = std::max(exit_code, *before);
      continue;
    }
    exit_code = std::max(exit_code, run_one(experiment, options, history));
    if (exit_code == exit_interrupted) break;
  }
  if (!history.empty()) append_history(options.directory / "history.jsonl", history_line(options, history));
  return exit_code;
}

}  // namespace pbdcheck
