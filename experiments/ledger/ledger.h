// The ledger: known answers, and what the solver makes of each of them. A row is data and two functions; the
// families of rows, one source each, are in the list of ledger.cpp.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/experiment.h"
#include "method.h"

namespace pbdcheck {

/// How far a measured value may be from the expected one, on either side: absolute + relative |expected|.
struct LedgerBound {
  double absolute = 0;  // in the row's unit
  double relative = 0;
  std::string derivation{};  // from step, mesh, order or tolerance, in a phrase
};

/// What a formula says the solver makes of a row whose expected value it cannot reach.
struct Deviation {
  std::string formula;
  std::function<double()> value;  // in the row's unit
};

struct LedgerRow {
  std::string id{};         // family.case
  std::string statement{};  // a sentence
  std::string quantity{};   // what is measured
  std::string unit{};       // "1" of ratios
  std::string formula{};    // of the expected value
  std::string source{};     // a key of paper/refs.bib; empty: textbook knowledge
  std::string scene{};
  pbd::Method method{};
  LedgerBound bound{};
  std::function<double()> expected{};
  std::function<double(const pbd::Method&)> run{};  // by the solver; throws where it finds no answer
  Tier tier = Tier::quick;
  std::optional<Deviation> deviation{};
  std::string cannot{};  // not empty: why the solver does not run it
};

enum class LedgerVerdict { holds, fails, skipped, expected_failure };
inline constexpr std::array<std::string_view, 4> ledger_verdict_names{"holds", "fails", "skipped",
                                                                      "expected_failure"};

struct LedgerResult {
  double expected, measured, bound;  // in the row's unit; NaN where there is none
  LedgerVerdict verdict;
  std::string reason;  // empty if it holds
  double wall_s;
};

/// Runs a row. It holds where the measured value is within the bound of the expected one; one with a
/// deviation is an expected failure where it is within the bound of the deviation's value, and that is not.
/// NaN is within no bound. What a row throws is the reason of its failure; Interrupted goes on to the caller.
LedgerResult evaluate(const LedgerRow& row);

/// How far a row may be from what it expects, in its unit.
double bound_of(const LedgerRow& row, double expected);

/// The verdict that a result's numbers give, of what is not skipped.
LedgerVerdict verdict_of(const LedgerRow& row, const LedgerResult& result);

/// All rows, by families.
const std::vector<LedgerRow>& ledger_rows();

/// The part of an id before the dot.
std::string family_of(const LedgerRow& row);

}  // namespace pbdcheck
