// What an experiment leaves behind: tidy tables, one CSV file each, and verdicts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

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

/// A statement of an experiment that was measured against a bound.
struct Verdict {
  std::string id, statement, quantity;
  double measured = 0;
  double bound = 0;

  bool holds() const { return measured <= bound; }  // NaN never holds
};

}  // namespace pbdcheck
