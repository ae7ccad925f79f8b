#include "harness/results.h"

#include <fmt/format.h>

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

}  // namespace

struct Table::Data {
  PartialFile file;
  std::size_t columns;
  RowCounts* counts;
  std::int64_t rows = -1;  // the header is written as one
};

Table::Table(std::filesystem::path path, std::vector<std::string> columns, RowCounts* counts)
    : data_(new Data{PartialFile(std::move(path)), columns.size(), counts}) {
  row({columns.begin(), columns.end()});
}

Table::Table(Table&&) noexcept = default;

Table::~Table() = default;

void Table::row(const std::vector<Cell>& cells) {
  if (cells.size() != data_->columns)
    throw std::logic_error(fmt::format("{}: a row of {} cells for {} columns", data_->file.path().string(),
                                       cells.size(), data_->columns));
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + cell_text(cells[i]);
  data_->file.write(line + '\n');
  ++data_->rows;
}

void Table::close() {
  data_->file.complete();
  if (data_->counts != nullptr) (*data_->counts)[data_->file.path().stem().string()] = data_->rows;
}

}  // namespace pbdcheck
