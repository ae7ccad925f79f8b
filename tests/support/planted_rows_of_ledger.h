// Rows of the ledger whose values are planted, and a check of XML.
#pragma once

#include <regex>
#include <string>
#include <vector>

#include "ledger/ledger.h"

namespace pbdcheck::test {

inline LedgerRow planted_row(const std::string& id, double expected, double measured, double bound) {
  return {.id = id,
          .statement = "a statement",
          .quantity = "a number",
          .unit = "1",
          .formula = "a formula",
          .scene = "a scene",
          .bound = {.absolute = bound, .derivation = "planted"},
          .expected = [=] { return expected; },
          .run = [=](const pbd::Method&) { return measured; }};
}

/// Whether every element of the XML is closed where it should be.
inline bool balanced(const std::string& xml) {
  const std::regex tag("<(/?)([a-z-]+)[^<>]*?(/?)>");
  std::vector<std::string> open;
  for (std::sregex_iterator at(xml.begin(), xml.end(), tag), end; at != end; ++at) {
    if ((*at)[3].length() > 0) continue;
    if ((*at)[1].length() == 0) {
      open.push_back((*at)[2].str());
    } else {
      if (open.empty() || open.back() != (*at)[2].str()) return false;
      open.pop_back();
    }
  }
  return open.empty();
}

}  // namespace pbdcheck::test
