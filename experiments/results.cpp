// Table and Context of experiment.h.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <exception>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "experiment.h"
#include "files.h"
#include "progress.h"

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

std::string clean_id(std::string_view text) {
  std::string id;
  for (const unsigned char c : text) {
    const bool kept = c < 128 && (std::isalnum(c) != 0 || c == '.');
    if (kept)
      id += static_cast<char>(std::tolower(c));
    else if (!id.empty() && id.back() != '_')
      id += '_';
  }
  return id;
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

struct Context::Data {
  std::filesystem::path directory;
  Tier tier;
  int threads;
  std::optional<Progress> progress;
  std::vector<Verdict> verdicts;
  RowCounts rows;
};

Context::Context(std::filesystem::path directory, Tier tier, int threads) : data_(std::make_shared<Data>()) {
  data_->directory = std::move(directory);
  data_->tier = tier;
  data_->threads = threads;
}

Tier Context::tier() const {
  return data_->tier;
}

int Context::threads() const {
  return data_->threads;
}

Table Context::table(std::string_view name, std::vector<std::string> columns) {
  return {data_->directory / (std::string(name) + ".csv"), std::move(columns), &data_->rows};
}

const RowCounts& Context::rows() const {
  return data_->rows;
}

void Context::begin(std::int64_t units) {
  data_->progress.emplace(data_->directory.filename().string(), units);
}

void Context::advance(std::string_view label) {
  if (data_->progress) data_->progress->advance(label);
  throw_if_interrupted();
}

void Context::verdict(std::string_view id, std::string_view statement, std::string_view quantity,
                      double measured, double bound) {
  data_->verdicts.push_back({clean_id(id), std::string(statement), std::string(quantity), measured, bound});
}

const std::vector<Verdict>& Context::verdicts() const {
  return data_->verdicts;
}

void Context::write_verdicts() {
  data_->progress.reset();
  Table verdicts = table("verdicts", {"id", "statement", "quantity", "measured", "bound", "verdict"});
  for (const auto& v : data_->verdicts)
    verdicts.row(
        {v.id, v.statement, v.quantity, v.measured, v.bound, std::string(v.holds() ? "holds" : "fails")});
  verdicts.close();
}

void Context::parallel(std::int64_t count, const std::function<void(std::int64_t)>& f) const {
  std::atomic<std::int64_t> next{0};
  std::mutex mutex;
  std::int64_t failed_index = count;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::int64_t i = next++; i < count && !interrupted(); i = next++) {
      try {
        f(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (i < failed_index) {
          failed_index = i;
          failure = std::current_exception();
        }
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::int64_t i = 1; i < std::min<std::int64_t>(threads(), count); ++i) helpers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);  // that of the smallest index, whatever the order was
  throw_if_interrupted();
}

}  // namespace pbdcheck
