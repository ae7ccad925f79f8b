#include "ledger/baseline.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "error.h"
#include "harness/files.h"
#include "harness/provenance.h"
#include "harness/results.h"
#include "studies/iteration/measured_rate.h"

namespace pbdcheck {
namespace {

namespace fs = std::filesystem;

constexpr const char* head_name = "baseline.json";
constexpr std::array same_keys{"compiler", "processor", "march"};  // of a record: those of one machine
constexpr double infinity = std::numeric_limits<double>::infinity();

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Cells of a line; those with a comma or a quotation mark are quoted, as `Table` writes them.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool doubled = quoted && line.compare(i, 2, "\"\"") == 0;
    if (line[i] == '"' && !doubled)
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
    if (doubled) ++i;
  }
  return cells;
}

CsvTable read_csv(const fs::path& path) {
  CsvTable table;
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) throw pbd::SetupError(path.string(), "no header", "a table");
  table.columns = cells_of(line);
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    table.rows.push_back(cells_of(line));
    if (table.rows.back().size() != table.columns.size())
      throw pbd::SetupError(fmt::format("{}:{}", path.string(), number),
                            fmt::format("{} cells", table.rows.back().size()),
                            fmt::format("{}, as in the header", table.columns.size()));
  }
  return table;
}

nlohmann::ordered_json read_json(const fs::path& path) {
  std::ifstream in(path);
  auto json = nlohmann::ordered_json::parse(in, nullptr, false);
  if (!json.is_object()) throw pbd::SetupError(path.string(), "no JSON object", "a record of pbdcheck");
  return json;
}

enum class Kind { time, work, error, rate, other };

Kind kind_of(const std::string& column) {
  const auto has = [&](const char* part) { return column.find(part) != std::string::npos; };
  if (has("wall_s") || has("cpu_s")) return Kind::time;
  if (column == "sweeps" || column == "row_updates" || column == "outer_iterations") return Kind::work;
  if (column == "measured_rate") return Kind::rate;
  return has("error") || has("residual") || has("difference") ? Kind::error : Kind::other;
}

std::optional<double> number_in(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

/// How far a cell is from what it was, as a multiple of what is allowed. Rates are measured from errors that
/// fall to rounding: on another machine they are known to what can be told of them.
double deviation(Kind kind, const std::string& was, const std::string& is, bool same_machine) {
  if (was == is || kind == Kind::time) return 0;
  const auto before = number_in(was), now = number_in(is);
  if (!before || !now || std::isnan(*before) || std::isnan(*now) || std::isinf(*before)) return infinity;
  constexpr double rounding = 1e-11;
  const double size = std::abs(*before);
  const double allowed = kind == Kind::work    ? 0.1 * size + 2
                         : kind == Kind::error ? (same_machine ? 0.5 : 2) * size + rounding
                         : kind == Kind::rate && !same_machine
                             ? 2 * least_rate
                             : (same_machine ? 1e-6 : 1e-4) * size + rounding;
  return std::abs(*now - *before) / allowed;
}

struct Difference {
  double times;  // what is allowed
  std::string text;
};

/// The cells of a row that are text, which tell it from others.
std::string name_of(const std::vector<std::string>& row) {
  std::string name;
  for (const std::string& cell : row)
    if (!cell.empty() && !number_in(cell)) name += (name.empty() ? "" : " ") + cell;
  return name;
}

void compare_tables(const std::string& name, const CsvTable& was, const CsvTable& is, bool same_machine,
                    std::vector<Difference>& found) {
  if (was.rows.size() != is.rows.size())
    found.push_back({infinity, fmt::format("{}: {} rows, were {}", name, is.rows.size(), was.rows.size())});
  for (std::size_t c = 0; c < was.columns.size(); ++c) {
    const std::string& column = was.columns[c];
    const auto place = std::find(is.columns.begin(), is.columns.end(), column);
    if (place == is.columns.end()) {
      found.push_back({infinity, fmt::format("{}: no column `{}` any more", name, column)});
      continue;
    }
    const auto at = static_cast<std::size_t>(place - is.columns.begin());
    for (std::size_t r = 0; r < std::min(was.rows.size(), is.rows.size()); ++r) {
      const std::string &before = was.rows[r][c], &now = is.rows[r][at];
      const double times = deviation(kind_of(column), before, now, same_machine);
      if (times <= 1) continue;
      found.push_back({times, fmt::format("{} row {} ({}): {} is {}, was {}", name, r + 1,
                                          name_of(was.rows[r]), column, now, before)});
    }
  }
}

/// Keeps a table without its columns of times.
void keep(const CsvTable& table, const fs::path& path) {
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (kind_of(table.columns[c]) != Kind::time) kept.push_back(c);
  std::vector<std::string> columns;
  for (const std::size_t c : kept) columns.push_back(table.columns[c]);
  Table written(path, columns);
  for (const auto& row : table.rows) {
    std::vector<Cell> cells;
    for (const std::size_t c : kept) cells.emplace_back(row[c]);
    written.row(cells);
  }
  written.close();
}

/// The record of a whole run at tier quick.
nlohmann::ordered_json blessed_record(const fs::path& results) {
  const fs::path file = results / "run.json";
  if (!fs::is_regular_file(file))
    throw pbd::SetupError(results.string(), "no run.json", "results of `pbdcheck run` at tier quick");
  auto record = read_json(file);
  const nlohmann::ordered_json none, status = record.value("status", none), tier = record.value("tier", none);
  if (status != outcome_names[0] || tier != "quick")
    throw pbd::SetupError(file.string(), fmt::format("status {} and tier {}", status.dump(), tier.dump()),
                          "a complete run at tier quick");
  return record;
}

}  // namespace

fs::path baseline_of(std::string_view experiment) {
  return source_root() / "experiments/baselines" / experiment;
}

bool is_baseline(const fs::path& baseline) {
  return fs::is_regular_file(baseline / head_name);
}

std::vector<std::string> differences(const fs::path& baseline, const fs::path& results) {
  const auto head = read_json(baseline / head_name);
  const auto machine = run_record(1, RunOutcome::complete, "");
  // Virtual processors of one name have several instruction sets, which round sums otherwise.
  const bool same_machine = std::all_of(same_keys.begin(), same_keys.end(), [&](const char* key) {
    return head.contains(key) && head.at(key) == machine.at(key);
  });
  std::vector<Difference> found;
  for (const std::string& name : head.at("tables").get<std::vector<std::string>>()) {
    if (fs::is_regular_file(results / (name + ".csv")))
      compare_tables(name, read_csv(baseline / (name + ".csv")), read_csv(results / (name + ".csv")),
                     same_machine, found);
    else
      found.push_back({infinity, name + ": no such table any more"});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Difference& a, const Difference& b) { return a.times > b.times; });
  std::vector<std::string> lines;
  for (const auto& [times, text] : found)
    lines.push_back(std::isinf(times) ? text : fmt::format("{} ({:.3g} times what is allowed)", text, times));
  return lines;
}

void bless_results(const fs::path& results, const fs::path& baseline, const std::string& reason) {
  constexpr std::uintmax_t largest = 64 << 10;  // bytes: the repository is to stay small
  const auto record = blessed_record(results);
  nlohmann::ordered_json head{{"reason", reason}};
  std::vector<std::string> names;
  try {
    for (const char* key : {"commit", "dirty"}) head[key] = record.at(key);
    for (const char* key : same_keys) head[key] = record.at(key);
    for (const auto& [name, rows] : record.at("rows").get<std::map<std::string, int>>())
      if (name != "verdicts" && rows > 0) names.push_back(name);
  } catch (const nlohmann::ordered_json::exception& error) {
    throw pbd::SetupError((results / "run.json").string(), error.what(), "a record as `run` writes it");
  }
  head["tables"] = head["left_out"] = nlohmann::ordered_json::array();
  for (const std::string& name : names)
    head[fs::file_size(results / (name + ".csv")) <= largest ? "tables" : "left_out"].push_back(name);
  require_writable(baseline);
  for (const auto& name : head["tables"])
    keep(read_csv(results / (name.get<std::string>() + ".csv")),
         baseline / (name.get<std::string>() + ".csv"));
  write_file(baseline / head_name, json_text(head));
  for (const auto& entry : fs::directory_iterator(baseline)) {
    const bool listed = std::find(head["tables"].begin(), head["tables"].end(),
                                  entry.path().stem().string()) != head["tables"].end();
    if (entry.path().extension() == ".csv" && !listed) fs::remove(entry.path());
  }
}

}  // namespace pbdcheck
