#include "harness/experiment.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "harness/progress.h"

namespace pbdcheck {
namespace {

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

struct Context::Data {
  std::filesystem::path directory;
  Tier tier;
  int threads;
  std::optional<ProgressBar> progress;
  std::vector<Verdict> verdicts;
  TableTotals totals;
};

Context::Context(std::filesystem::path directory, Tier tier, int threads) : data_(std::make_shared<Data>()) {
  data_->directory = std::move(directory);
  data_->tier = tier;
  data_->threads = threads;
}

const std::filesystem::path& Context::directory() const {
  return data_->directory;
}

Tier Context::tier() const {
  return data_->tier;
}

int Context::threads() const {
  return data_->threads;
}

Table Context::table(std::string_view name, std::vector<std::string> columns) {
  return {data_->directory / (std::string(name) + ".csv"), std::move(columns), &data_->totals};
}

const TableTotals& Context::totals() const {
  return data_->totals;
}

void Context::begin(std::int64_t units) {
  data_->progress.emplace(data_->directory.filename().string(), units);
}

void Context::advance(std::string_view label) {
  if (data_->progress) data_->progress->advance(label);
  throw_if_interrupted();
}

void Context::verdict(Basis basis, std::string_view id, std::string_view statement, std::string_view quantity,
                      const Measured& measured, double bound) {
  data_->verdicts.push_back(
      {basis, clean_id(id), std::string(statement), std::string(quantity), measured, bound});
}

const std::vector<Verdict>& Context::verdicts() const {
  return data_->verdicts;
}

void Context::write_verdicts() {
  data_->progress.reset();
  Table verdicts = table("verdicts", {"id", "class", "statement", "quantity", "measured", "measured_low",
                                      "measured_high", "bound", "verdict", "reason"});
  for (const auto& v : data_->verdicts)
    verdicts.row({v.id, std::string(basis_names[static_cast<std::size_t>(v.basis)]), v.statement, v.quantity,
                  v.measured.value, v.measured.low, v.measured.high, v.bound,
                  std::string(ruling_names[static_cast<std::size_t>(v.ruling())]), v.reason()});
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
