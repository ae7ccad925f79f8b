// Experiments run anew beside their baselines: a row each, the number of cells that differ.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "ledger/baseline.h"
#include "ledger/families.h"
#include "studies/experiments.h"

namespace pbdcheck::ledger {
namespace {

/// A folder of this process that goes when it is done with.
class Scratch {
 public:
  explicit Scratch(std::string_view name)
      : path_(std::filesystem::temp_directory_path() / fmt::format("pbdcheck-{}-{}", getpid(), name)) {
    std::filesystem::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Throws the worst differences as the reason, if there are any.
double cells_that_differ(const Experiment& experiment) {
  constexpr std::size_t shown = 3;
  const Scratch scratch(experiment.name);
  const auto results = scratch.path() / experiment.name;
  std::filesystem::create_directories(results);
  Context context(results, Tier::quick, 1);
  experiment.run(context);
  const auto found = differences(baseline_of(experiment.name), results);
  if (found.empty()) return 0;
  std::string text = fmt::format("{} differences", found.size());
  for (std::size_t k = 0; k < std::min(shown, found.size()); ++k) text += "; " + found[k];
  throw std::runtime_error(text + "; if they are meant: pbdcheck run, then pbdcheck bless");
}

}  // namespace

void baseline_rows(Ledger& rows) {
  for (const Experiment& experiment : experiments()) {
    if (!is_baseline(baseline_of(experiment.name))) continue;
    LedgerRow row;
    row.id = fmt::format("baseline.{}", experiment.name);
    row.statement = "The experiment's tables are those of its baseline.";
    row.quantity = "cells that differ";
    row.unit = "1";
    row.formula = "0";
    row.scene = std::string(experiment.name);
    row.bound = {0.5, 0, "a number of cells; ledger/baseline.h says of each column how far it may be off"};
    row.expected = [] { return 0.0; };
    row.run = [experiment](const pbd::Method&) { return cells_that_differ(experiment); };
    rows.push_back(row);
  }
}

}  // namespace pbdcheck::ledger
