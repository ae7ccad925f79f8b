#include <fnmatch.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <mutex>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "error.h"
#include "harness/files.h"
#include "harness/progress.h"
#include "harness/provenance.h"
#include "ledger/ledger_text.h"
#include "scenes/choices.h"

namespace pbdcheck {
namespace {

/// The rows whose ids match, of !GLOB those that do not.
std::vector<LedgerRow> matching(const std::string& glob, const std::vector<LedgerRow>& known) {
  std::vector<LedgerRow> rows;
  const bool others = glob.starts_with('!');
  std::copy_if(known.begin(), known.end(), std::back_inserter(rows), [&](const LedgerRow& row) {
    return glob.empty() || (fnmatch(glob.c_str() + others, row.id.c_str(), 0) == 0) != others;
  });
  if (!rows.empty()) return rows;
  std::vector<std::string> families, ids;
  for (const LedgerRow& row : known) {
    ids.push_back(row.id);
    if (families.empty() || families.back() != family_of(row)) families.push_back(family_of(row));
  }
  const std::string nearest = nearest_name(glob, ids);
  throw pbd::SetupError("--only", "`" + glob + "`, which no row matches",
                        "a pattern of ids, FAMILY.* with FAMILY one of " + joined(families) +
                            (nearest.empty() ? "" : "; did you mean `" + nearest + "`?"));
}

/// Rows that are being run, and the file `ledger.json` of those that are done.
class LedgerRun {
 public:
  LedgerRun(const VerifyOptions& options, const std::vector<LedgerRow>& known)
      : options_(options),
        directory_(options.directory / "verify"),
        rows_(matching(options.only, known)),
        results_(rows_.size()) {
    require_writable(directory_);
    if (options.resume) take_over();
    write_done();  // what another program left there is gone before the record names this one
    record(RunOutcome::interrupted, "ended before it was done");  // until it is: the program may be killed
  }

  void run() {
    const Tier tier = options_.tier == "full" ? Tier::full : Tier::quick;
    const Context context(directory_, tier, options_.threads);
    ProgressBar progress("verify", std::ssize(rows_));
    std::mutex recording;
    context.parallel(std::ssize(rows_), [&](std::int64_t i) {
      const auto k = static_cast<std::size_t>(i);
      const bool left_out = rows_[k].tier > tier;
      auto result = results_[k] ? *results_[k]
                    : left_out  ? LedgerResult{std::nan(""),           std::nan(""),   std::nan(""),
                                              LedgerVerdict::skipped, "of tier full", 0}
                                : evaluate(rows_[k]);
      const std::lock_guard lock(recording);
      results_[k] = std::move(result);
      if (!left_out) write_done();
      progress.advance(rows_[k].id);
    });
  }

  /// run.json
  void record(RunOutcome outcome, const std::string& reason) const {
    auto json = run_record(options_.threads, outcome, reason);
    json["tier"] = options_.tier;
    json["settings"] = {{"tier", options_.tier}, {"only", options_.only}};
    json["wall_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    for (const auto name : ledger_verdict_names) json["verdicts"][std::string(name)] = 0;
    for (const LedgerEntry& entry : done()) {
      auto& number =
          json["verdicts"][std::string(ledger_verdict_names[static_cast<std::size_t>(entry.result.verdict)])];
      number = number.get<int>() + 1;
    }
    write_file(directory_ / "run.json", json_text(json));
  }

  std::vector<LedgerEntry> done() const {
    std::vector<LedgerEntry> entries;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (results_[k]) entries.push_back({rows_[k], *results_[k]});
    return entries;
  }

  nlohmann::ordered_json json() const {
    auto array = nlohmann::ordered_json::array();
    for (const LedgerEntry& entry : done()) array.push_back(ledger_json(entry));
    return array;
  }

 private:
  std::filesystem::path ledger_file() const { return directory_ / "ledger.json"; }
  void write_done() const { write_file(ledger_file(), json_text(json())); }

  /// The results that this very program left there; those that were skipped are looked at again, and what is
  /// compared with files, which `bless` changes.
  void take_over() {
    const auto parsed = [](const std::filesystem::path& file) {
      std::ifstream in(file);
      return nlohmann::ordered_json::parse(in, nullptr, false);
    };
    const char* const allowed = "results as `verify` writes them; without them all rows are run again";
    const auto record = parsed(directory_ / "run.json");
    try {
      if (!record.is_object() || !from_this_build(record)) return;
    } catch (const nlohmann::ordered_json::type_error& error) {
      throw pbd::SetupError((directory_ / "run.json").string(), error.what(), allowed);
    }
    std::map<std::string, LedgerResult> before;
    const auto results = parsed(ledger_file());
    if (!results.is_array()) throw pbd::SetupError(ledger_file().string(), "no JSON list", allowed);
    try {
      for (const auto& object : results)
        before.emplace(object.at("id").get<std::string>(), ledger_result(object));
    } catch (const std::exception& error) {  // of JSON, or a verdict that there is not
      throw pbd::SetupError(ledger_file().string(), error.what(), allowed);
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto found = before.find(rows_[k].id);
      if (found != before.end() && found->second.verdict != LedgerVerdict::skipped &&
          family_of(rows_[k]) != "baseline") {
        const LedgerResult& result = found->second;
        const auto refuse = [&](const char* what) {
          throw pbd::SetupError(ledger_file().string(), rows_[k].id + what, allowed);
        };
        if (!std::isnan(result.expected) && bound_of(rows_[k], result.expected) != result.bound)
          refuse(" with a bound that is not the row's");
        if (verdict_of(rows_[k], result) != result.verdict)
          refuse(" with a verdict that its numbers do not give");
        results_[k] = result;
      }
    }
  }

  VerifyOptions options_;
  std::filesystem::path directory_;
  std::vector<LedgerRow> rows_;
  std::vector<std::optional<LedgerResult>> results_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void print_results(const LedgerRun& run, bool as_json) {
  const auto entries = run.done();
  if (as_json)
    fmt::print("{}", json_text(run.json()));
  else
    fmt::print("{}{}\n", ledger_table(entries), ledger_counts(entries));
}

}  // namespace

int verify(const VerifyOptions& options, const std::vector<LedgerRow>& known) {
  require_name("--tier", options.tier, strings(tier_names));
  if (!options.junit.empty())
    require_writable(std::filesystem::absolute(options.junit).parent_path(), "--junit");
  LedgerRun run(options, known);
  try {
    run.run();
  } catch (const Interrupted&) {
    run.record(RunOutcome::interrupted, "stopped by the user");
    print_results(run, options.json);
    return exit_interrupted;
  }
  run.record(RunOutcome::complete, "");
  const auto entries = run.done();
  if (!options.junit.empty()) write_file(options.junit, ledger_junit(entries));
  print_results(run, options.json);
  const bool fails = std::any_of(entries.begin(), entries.end(), [](const LedgerEntry& entry) {
    return entry.result.verdict == LedgerVerdict::fails;
  });
  return fails ? exit_failed : exit_done;
}

}  // namespace pbdcheck
