#include "ledger/ledger.h"

#include <chrono>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "ledger/families.h"

namespace pbdcheck {
namespace {

/// NaN is within nothing.
bool within(double value, double target, double bound) {
  return std::abs(value - target) <= bound;
}

void judge_row(const LedgerRow& row, LedgerResult& result) {
  result.expected = row.expected();
  result.bound = bound_of(row, result.expected);
  if (!row.cannot.empty()) {
    result.verdict = LedgerVerdict::skipped;
    result.reason = row.cannot;
    return;
  }
  result.measured = row.run(row.method);
  result.verdict = verdict_of(row, result);
  if (!row.deviation) {
    if (result.verdict == LedgerVerdict::fails)
      result.reason = fmt::format("{:.10g} is not within {:.3g} of {:.10g}", result.measured, result.bound,
                                  result.expected);
    return;
  }
  const double deviated = row.deviation->value();
  const auto text = fmt::format("{:.10g} by {}", deviated, row.deviation->formula);
  if (result.verdict == LedgerVerdict::expected_failure) {
    result.reason = text;
  } else if (within(deviated, result.expected, result.bound)) {
    result.reason = "the deviation " + text + " is within the bound: the row expects no failure";
  } else {
    result.reason = fmt::format("{:.10g} is not within {:.3g} of {}", result.measured, result.bound, text);
  }
}

}  // namespace

double bound_of(const LedgerRow& row, double expected) {
  return row.bound.absolute + row.bound.relative * std::abs(expected);
}

LedgerVerdict verdict_of(const LedgerRow& row, const LedgerResult& result) {
  const auto& [expected, measured, bound] = std::tie(result.expected, result.measured, result.bound);
  if (!row.deviation) return within(measured, expected, bound) ? LedgerVerdict::holds : LedgerVerdict::fails;
  const double deviated = row.deviation->value();
  const bool fails_so = !within(deviated, expected, bound) && within(measured, deviated, bound);
  return fails_so ? LedgerVerdict::expected_failure : LedgerVerdict::fails;
}

LedgerResult evaluate(const LedgerRow& row) {
  const double nan = std::nan("");
  LedgerResult result{nan, nan, nan, LedgerVerdict::fails, "", 0};
  const auto start = std::chrono::steady_clock::now();
  try {
    judge_row(row, result);
  } catch (const std::exception& failure) {
    result.reason = failure.what();
  }
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

const std::vector<LedgerRow>& ledger_rows() {
  static const std::vector<LedgerRow> list = [] {
    std::vector<LedgerRow> rows;
    for (const auto family :
         {ledger::oscillators,    ledger::particles,    ledger::pendulums, ledger::chains,
          ledger::falling_chains, ledger::free_bodies,  ledger::tops,      ledger::mechanisms,
          ledger::sliding,        ledger::rolling,      ledger::impacts,   ledger::contact_springs,
          ledger::thresholds,     ledger::jams,         ledger::carried,   ledger::solids,
          ledger::bars,           ledger::loaded_bars,  ledger::hertz,     ledger::cantilevers,
          ledger::elasticas,      ledger::membranes,    ledger::shells,    ledger::rates,
          ledger::unreachable,    ledger::baseline_rows})
      family(rows);
    return rows;
  }();
  return list;
}

std::string family_of(const LedgerRow& row) {
  return row.id.substr(0, row.id.find('.'));
}

}  // namespace pbdcheck
