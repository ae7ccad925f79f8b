// What an experiment is given and what it leaves behind.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/cases.h"
#include "harness/interrupt.h"
#include "harness/results.h"
#include "harness/verdict.h"

namespace pbdcheck {

enum class Tier { quick, full };

inline constexpr std::array<std::string_view, 2> tier_names{"quick", "full"};

/// Begins every random sequence, so that a run can be repeated.
inline constexpr std::uint64_t seed = 20170401;

/// The surroundings of one running experiment.
class Context {
 public:
  Context(std::filesystem::path directory, Tier tier, int threads);

  const std::filesystem::path& directory() const;
  Tier tier() const;
  bool full() const { return tier() == Tier::full; }
  int threads() const;

  /// A table `<directory>/<name>.csv`.
  Table table(std::string_view name, std::vector<std::string> columns);

  /// Of the tables that are closed.
  const TableTotals& totals() const;

  /// Announces the number of units of work, then each finished one with a short label; throws Interrupted if
  /// the user pressed Ctrl-C.
  void begin(std::int64_t units);
  void advance(std::string_view label);

  /// Records a verdict in `verdicts.csv`. Of `id` lower case letters, digits and dots are kept, what is
  /// between becomes one _.
  void verdict(Basis basis, std::string_view id, std::string_view statement, std::string_view quantity,
               const Measured& measured, double bound);
  const std::vector<Verdict>& verdicts() const;

  /// Writes `verdicts.csv`; called once the experiment has ended.
  void write_verdicts();

  /// Runs f(i) for i in [0, count) on at most `threads()` threads; results must not depend on the order. Do
  /// not use it for work that is timed.
  void parallel(std::int64_t count, const std::function<void(std::int64_t)>& f) const;

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

struct Experiment {
  std::string_view name;
  std::string_view question;  // one sentence, shown by `list` and in the report
  void (*run)(Context&);
  std::vector<Case> (*cases)(bool full) = nullptr;  // the steps it compares with a judge
};

}  // namespace pbdcheck
