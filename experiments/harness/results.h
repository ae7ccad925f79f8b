// What an experiment leaves behind: tidy tables, one CSV file each.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pbdcheck {

/// One cell of a table. Doubles are written with 17 significant digits, NaN and infinities as `nan`, `inf`,
/// `-inf`.
using Cell = std::variant<std::string, double, std::int64_t>;

/// Columns of work and time, whose sums tell a run from the next.
inline constexpr std::array<std::string_view, 4> work_columns{"outer_iterations", "sweeps", "row_updates",
                                                              "wall_s"};

/// Of the tables that are closed.
struct TableTotals {
  std::map<std::string, std::int64_t> rows;  // without the header, by the table's name
  std::map<std::string, double> work;        // sums of the finite cells of `work_columns` of all tables
};

/// A tidy table, written to `<path>.partial` and renamed when closed; its rows and work are added to
/// `totals`, if there are any, then.
class Table {
 public:
  Table(std::filesystem::path path, std::vector<std::string> columns, TableTotals* totals = nullptr);
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

}  // namespace pbdcheck
