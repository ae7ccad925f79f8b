#include "harness/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/files.h"

namespace pbdcheck {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string cell_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return quoted(*text);
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *integer);
  const double number = std::get<double>(cell);
  return std::isnan(number) ? "nan" : fmt::format("{:.17g}", number);
}

/// NaN of a text.
double number_of(const Cell& cell) {
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*integer);
  const auto* number = std::get_if<double>(&cell);
  return number != nullptr ? *number : std::nan("");
}

}  // namespace

struct Table::Data {
  PartialFile file;
  std::vector<std::string> columns;
  TableTotals* totals;
  std::map<std::string, double> work = {};
  std::int64_t rows = -1;  // the header is written as one
};

Table::Table(std::filesystem::path path, std::vector<std::string> columns, TableTotals* totals)
    : data_(new Data{PartialFile(std::move(path)), std::move(columns), totals}) {
  row({data_->columns.begin(), data_->columns.end()});
}

Table::Table(Table&&) noexcept = default;

Table::~Table() = default;

void Table::row(const std::vector<Cell>& cells) {
  if (cells.size() != data_->columns.size())
    throw std::logic_error(fmt::format("{}: a row of {} cells for {} columns", data_->file.path().string(),
                                       cells.size(), data_->columns.size()));
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + cell_text(cells[i]);
  data_->file.write(line + '\n');
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (std::find(work_columns.begin(), work_columns.end(), data_->columns[i]) != work_columns.end())
      if (const double number = number_of(cells[i]); std::isfinite(number))
        data_->work[data_->columns[i]] += number;
  ++data_->rows;
}

void Table::close() {
  data_->file.complete();
  if (data_->totals == nullptr) return;
  data_->totals->rows[data_->file.path().stem().string()] = data_->rows;
  for (const auto& [column, sum] : data_->work) data_->totals->work[column] += sum;
}

}  // namespace pbdcheck
