// The ledger's rows: what they state, what makes them hold or fail, how that is written down.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "harness/interrupt.h"
#include "ledger/ledger_text.h"
#include "planted_rows_of_ledger.h"
#include "program.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

std::set<std::string> literature() {
  std::set<std::string> keys;
  std::istringstream in(read_text(source_root() / "paper" / "refs.bib"));
  const std::regex entry("@\\w+\\{([^,]+),.*");
  std::smatch key;
  for (std::string line; std::getline(in, line);)
    if (std::regex_match(line, key, entry)) keys.insert(key[1].str());
  return keys;
}

}  // namespace

TEST_CASE("every row of the ledger says what it measures, by which formula, and whence its bound comes") {
  const auto keys = literature();
  const std::regex form("[a-z0-9_]+\\.[a-z0-9_.+-]+");
  std::set<std::string> ids;
  for (const LedgerRow& row : ledger_rows()) {
    INFO(row.id);
    CHECK(std::regex_match(row.id, form));
    CHECK(ids.insert(row.id).second);
    for (const auto& text : {row.statement, row.quantity, row.unit, row.formula, row.scene})
      CHECK_FALSE(text.empty());
    CHECK((row.source.empty() || keys.count(row.source) == 1));
    REQUIRE(row.expected);
    CHECK(static_cast<bool>(row.run) == row.cannot.empty());
    if (!row.run) continue;
    CHECK(row.bound.absolute + row.bound.relative > 0);
    CHECK_FALSE(row.bound.derivation.empty());
    if (row.deviation) CHECK_FALSE(row.deviation->formula.empty());
  }
}

TEST_CASE("the solver runs at least eighty rows in the quick tier") {
  const auto& rows = ledger_rows();
  CHECK(std::count_if(rows.begin(), rows.end(),
                      [](const LedgerRow& row) { return row.run && row.tier == Tier::quick; }) >= 80);
}

TEST_CASE("the first rows of each family hold, or fail as expected") {
  std::string family;
  int tested = 0;
  for (const LedgerRow& row : ledger_rows()) {
    tested = family_of(row) == family ? tested + 1 : 1;
    family = family_of(row);
    if (tested > 2 || family == "baseline") continue;  // a baseline is of one machine and of one build
    const LedgerResult result = evaluate(row);
    INFO(row.id << ": " << result.reason);
    CHECK(result.verdict != LedgerVerdict::fails);
    CHECK(std::isfinite(result.expected));
    CHECK((result.verdict == LedgerVerdict::skipped) == !row.cannot.empty());
  }
}

TEST_CASE("a row holds within its bound on either side, and nowhere else") {
  const double value = GENERATE(8.9, 9.1, 10.0, 10.9, 11.1);
  const LedgerResult result = evaluate(planted_row("a.row", 10, value, 1));
  CHECK((result.verdict == LedgerVerdict::holds) == (std::abs(value - 10) <= 1));
  CHECK(result.measured == value);
  CHECK(result.reason.empty() == (result.verdict == LedgerVerdict::holds));
}

TEST_CASE("NaN is within no bound, whether measured, expected or the bound itself") {
  const double nan = std::nan("");
  for (const auto& row : {planted_row("a.row", 10, nan, 1), planted_row("a.row", nan, 10, 1),
                          planted_row("a.row", 10, 10, nan)})
    CHECK(evaluate(row).verdict == LedgerVerdict::fails);
  LedgerRow row = planted_row("a.row", 1, nan, 0.1);
  row.deviation = Deviation{"a formula", [] { return 2.0; }};
  CHECK(evaluate(row).verdict == LedgerVerdict::fails);
}

TEST_CASE("a row that throws fails with what it says, and only Ctrl-C goes on") {
  LedgerRow row = planted_row("a.row", 1, 1, 1);
  row.run = [](const pbd::Method&) -> double { throw std::runtime_error("the step is diverged"); };
  const LedgerResult result = evaluate(row);
  CHECK(result.verdict == LedgerVerdict::fails);
  CHECK(result.reason == "the step is diverged");
  CHECK(std::isnan(result.measured));
  row.run = [](const pbd::Method&) -> double { throw Interrupted{}; };
  CHECK_THROWS_AS(evaluate(row), Interrupted);
}

TEST_CASE("a failure is expected only where the formula of the deviation predicts what is measured") {
  LedgerRow row = planted_row("a.row", 1, 2, 0.1);
  const auto verdict_by = [&](double deviated) {
    row.deviation = Deviation{"a formula", [=] { return deviated; }};
    return evaluate(row);
  };
  CHECK(verdict_by(2.05).verdict == LedgerVerdict::expected_failure);
  CHECK_THAT(verdict_by(2.05).reason, Catch::Contains("a formula"));
  CHECK(verdict_by(2.2).verdict == LedgerVerdict::fails);
  CHECK(verdict_by(1.05).verdict == LedgerVerdict::fails);
  CHECK_THAT(verdict_by(1.05).reason, Catch::Contains("expects no failure"));
  row.run = [](const pbd::Method&) { return 1.0; };  // the expected value itself
  CHECK(verdict_by(2.05).verdict == LedgerVerdict::fails);
}

TEST_CASE("what the solver cannot run is skipped with its reason") {
  LedgerRow row = planted_row("a.row", 1, 1, 1);
  row.cannot = "there is no such effect";
  const LedgerResult result = evaluate(row);
  CHECK(result.verdict == LedgerVerdict::skipped);
  CHECK(result.reason == row.cannot);
  CHECK(std::isnan(result.measured));
}

TEST_CASE("a result is the same after it was written as JSON") {
  LedgerRow row = planted_row("a.row", 1, 3, 0.1);
  row.unit = "m";
  const LedgerEntry entry{row, evaluate(row)};
  const auto object = nlohmann::ordered_json::parse(ledger_json(entry).dump());
  CHECK(object["quantity"] == "a number, m");
  CHECK(object["verdict"] == "fails");
  const LedgerResult read = ledger_result(object);
  CHECK(read.measured == 3);
  CHECK(read.verdict == LedgerVerdict::fails);
  CHECK(read.reason == entry.result.reason);
  row.cannot = "no";
  const auto skipped = ledger_json({row, evaluate(row)});
  CHECK(nlohmann::json::parse(skipped.dump())["measured"].is_null());
  CHECK(std::isnan(ledger_result(nlohmann::ordered_json::parse(skipped.dump())).measured));
}

TEST_CASE("JUnit's XML has a suite a family, balanced elements and no unescaped text") {
  LedgerRow wrong = planted_row("a.wrong", 1, 2, 0.1), other = planted_row("b.right", 1, 1, 1);
  wrong.run = [](const pbd::Method&) -> double { throw std::runtime_error("<a> & \"b\"\n"); };
  const std::string xml = ledger_junit({{wrong, evaluate(wrong)}, {other, evaluate(other)}});
  CHECK_THAT(xml, Catch::Contains("message=\"&lt;a&gt; &amp; &quot;b&quot;?\""));
  CHECK_THAT(xml, Catch::Contains("<testsuite name=\"a\" tests=\"1\" failures=\"1\" skipped=\"0\">"));
  CHECK_THAT(xml, Catch::Contains("<testsuite name=\"b\" tests=\"1\" failures=\"0\" skipped=\"0\">"));
  CHECK(balanced(xml));
}
