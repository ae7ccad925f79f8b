#include "ledger/ledger_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "error.h"
#include "scenes/choices.h"

namespace pbdcheck {
namespace {

std::string_view name_of(LedgerVerdict verdict) {
  return ledger_verdict_names[static_cast<std::size_t>(verdict)];
}

double number_or_nan(const nlohmann::ordered_json& value) {
  return value.is_null() ? std::nan("") : value.get<double>();
}

/// Text in an attribute; what XML cannot hold becomes `?`.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c >= 0 && c < ' ' ? '?' : c;
  }
  return out;
}

std::int64_t count(const std::vector<LedgerEntry>& entries, LedgerVerdict verdict) {
  return std::count_if(entries.begin(), entries.end(),
                       [&](const LedgerEntry& entry) { return entry.result.verdict == verdict; });
}

std::string junit_case(const LedgerEntry& entry) {
  const auto& [row, result] = entry;
  std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.6f}\">\n",
                                 escaped(family_of(row)), escaped(row.id), result.wall_s);
  const std::string reason = escaped(result.reason);
  if (result.verdict == LedgerVerdict::fails)
    text += fmt::format("      <failure message=\"{}\"/>\n", reason);
  if (result.verdict == LedgerVerdict::skipped)
    text += fmt::format("      <skipped message=\"{}\"/>\n", reason);
  if (result.verdict == LedgerVerdict::expected_failure)
    text += fmt::format("      <system-out>expected failure: {}</system-out>\n", reason);
  return text + "    </testcase>\n";
}

/// Of what the row was judged by: the error over the bound.
double share_of_bound(const LedgerEntry& entry) {
  const auto& [row, result] = entry;
  const bool deviates = result.verdict == LedgerVerdict::expected_failure;
  const double target = deviates ? row.deviation->value() : result.expected;
  return std::abs(result.measured - target) / result.bound;
}

}  // namespace

nlohmann::ordered_json ledger_json(const LedgerEntry& entry) {
  const auto& [row, result] = entry;
  return {{"id", row.id},
          {"statement", row.statement},
          {"quantity", row.unit == "1" ? row.quantity : row.quantity + ", " + row.unit},
          {"expected", result.expected},
          {"measured", result.measured},
          {"bound", result.bound},
          {"verdict", name_of(result.verdict)},
          {"reason", result.reason},
          {"wall_s", result.wall_s},
          {"formula", row.formula},
          {"source", row.source},
          {"scene", row.scene},
          {"integrator", row.method.integrator},
          {"outer", row.method.outer},
          {"relaxation", row.method.relaxation},
          {"friction", row.method.friction},
          {"bound_from", row.bound.derivation},
          {"tier", tier_names[static_cast<std::size_t>(row.tier)]}};
}

LedgerResult ledger_result(const nlohmann::ordered_json& object) {
  const auto verdict = object.at("verdict").get<std::string>();
  const auto found = std::find(ledger_verdict_names.begin(), ledger_verdict_names.end(), verdict);
  if (found == ledger_verdict_names.end())
    throw pbd::SetupError("verdict", verdict, "one of " + joined(strings(ledger_verdict_names)));
  return {number_or_nan(object.at("expected")),
          number_or_nan(object.at("measured")),
          number_or_nan(object.at("bound")),
          static_cast<LedgerVerdict>(found - ledger_verdict_names.begin()),
          object.at("reason").get<std::string>(),
          object.at("wall_s").get<double>()};
}

std::string ledger_junit(const std::vector<LedgerEntry>& entries) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  text += fmt::format("<testsuites name=\"pbdcheck verify\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n",
                      entries.size(), count(entries, LedgerVerdict::fails),
                      count(entries, LedgerVerdict::skipped));
  for (auto first = entries.begin(); first != entries.end();) {
    const std::string family = family_of(first->row);
    const auto last = std::find_if(first, entries.end(),
                                   [&](const LedgerEntry& entry) { return family_of(entry.row) != family; });
    const std::vector<LedgerEntry> suite(first, last);
    text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n",
                        escaped(family), suite.size(), count(suite, LedgerVerdict::fails),
                        count(suite, LedgerVerdict::skipped));
    for (const LedgerEntry& entry : suite) text += junit_case(entry);
    text += "  </testsuite>\n";
    first = last;
  }
  return text + "</testsuites>\n";
}

std::string ledger_table(const std::vector<LedgerEntry>& entries) {
  std::size_t widest = 2;
  for (const LedgerEntry& entry : entries) widest = std::max(widest, entry.row.id.size());
  std::string text = fmt::format("{:{}}  {:>14}  {:>14}  {:<6} {:>11}  {:<16} {:>6}\n", "id", widest,
                                 "expected", "measured", "unit", "error/bound", "verdict", "s");
  for (const LedgerEntry& entry : entries) {
    const auto& [row, result] = entry;
    text += fmt::format("{:{}}  {:>14.8g}  {:>14.8g}  {:<6} {:>11.3g}  {:<16} {:>6.2f}\n", row.id, widest,
                        result.expected, result.measured, row.unit, share_of_bound(entry),
                        name_of(result.verdict), result.wall_s);
    if (!result.reason.empty()) text += fmt::format("{:{}}  {}\n", "", widest, result.reason);
  }
  return text;
}

std::string ledger_counts(const std::vector<LedgerEntry>& entries) {
  return fmt::format("{} hold, {} fail, {} fail as expected, {} skipped",
                     count(entries, LedgerVerdict::holds), count(entries, LedgerVerdict::fails),
                     count(entries, LedgerVerdict::expected_failure), count(entries, LedgerVerdict::skipped));
}

}  // namespace pbdcheck
