// Results of the ledger's rows as JSON, JUnit's XML and a table for the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "ledger/ledger.h"

namespace pbdcheck {

struct LedgerEntry {
  LedgerRow row;
  LedgerResult result;
};

/// An object with id, statement, quantity (with its unit), expected, measured, bound, verdict, reason,
/// wall_s, and then what else the row states; NaN is null.
nlohmann::ordered_json ledger_json(const LedgerEntry& entry);

/// The result in such an object; throws nlohmann's exceptions where there is none.
LedgerResult ledger_result(const nlohmann::ordered_json& object);

/// A test suite a family; rows that fail are failures, skipped and expected ones carry their reason.
std::string ledger_junit(const std::vector<LedgerEntry>& entries);

/// A line a row: id, expected, measured, error over bound, verdict, seconds; reasons below the rows that have
/// one.
std::string ledger_table(const std::vector<LedgerEntry>& entries);

/// "80 hold, 0 fail, 3 fail as expected, 2 skipped".
std::string ledger_counts(const std::vector<LedgerEntry>& entries);

}  // namespace pbdcheck
