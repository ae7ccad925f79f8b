// What an experiment is given and what it leaves behind.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cases.h"
#include "interrupt.h"

namespace pbdcheck {

/// One cell of a table. Doubles are written with 17 significant digits, NaN and infinities as `nan`, `inf`,
/// `-inf`.
using Cell = std::variant<std::string, double, std::int64_t>;

/// Rows of tables, without the header, by their names.
using RowCounts = std::map<std::string, std::int64_t>;

/// A tidy table, written to `<path>.partial` and renamed when closed; `counts`, if there are any, get its
/// rows then.
class Table {
 public:
  Table(std::filesystem::path path, std::vector<std::string> columns, RowCounts* counts = nullptr);
  ~Table();  // without close(): the partial file is removed
  Table(Table&&) noexcept;
  Table& operator=(Table&&) = delete;

  /// Appends a row; throws std::logic_error unless there is one cell per column.
  void row(const std::vector<Cell>& cells);
  void close();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

enum class Tier { quick, full };

inline constexpr std::array<std::string_view, 2> tier_names{"quick", "full"};

/// Begins every random sequence, so that a run can be repeated.
inline constexpr std::uint64_t seed = 20170401;

/// A statement of an experiment that was measured against a bound.
struct Verdict {
  std::string id, statement, quantity;
  double measured = 0;
  double bound = 0;

  bool holds() const { return measured <= bound; }  // NaN never holds
};

/// The surroundings of one running experiment.
class Context {
 public:
  Context(std::filesystem::path directory, Tier tier, int threads);

  Tier tier() const;
  bool full() const { return tier() == Tier::full; }
  int threads() const;

  /// A table `<directory>/<name>.csv`.
  Table table(std::string_view name, std::vector<std::string> columns);

  /// Of the tables that are closed.
  const RowCounts& rows() const;

  /// Announces the number of units of work, then each finished one with a short label; throws Interrupted if
  /// the user pressed Ctrl-C.
  void begin(std::int64_t units);
  void advance(std::string_view label);

  /// Records a verdict in `verdicts.csv`: holds if measured <= bound (NaN never holds). Of `id` lower case
  /// letters, digits and dots are kept, what is between becomes one _.
  void verdict(std::string_view id, std::string_view statement, std::string_view quantity, double measured,
               double bound);
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

/// All experiments, in the order of the report.
const std::vector<Experiment>& experiments();

}  // namespace pbdcheck
