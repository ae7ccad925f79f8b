#include <fmt/format.h>

#include <algorithm>

#include "commands/commands.h"
#include "error.h"
#include "ledger/baseline.h"
#include "scenes/choices.h"

namespace pbdcheck {

int bless(const BlessOptions& options) {
  std::vector<std::string> names;
  for (const auto& experiment : experiments()) names.emplace_back(experiment.name);
  for (const std::string& name : options.experiments) require_name("bless", name, names);
  if (std::all_of(options.reason.begin(), options.reason.end(), [](char c) { return c == ' '; }))
    throw pbd::SetupError("--reason", "nothing", "why the results of now are the ones to keep");
  for (const std::string& name : options.experiments) {
    bless_results(options.directory / name, baseline_of(name), options.reason);
    fmt::print("{}: baseline kept\n", name);
  }
  return exit_done;
}

}  // namespace pbdcheck
