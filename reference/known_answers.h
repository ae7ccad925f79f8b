// The table of known answers: every row computed from its formula, beside the value literature or a
// calculation states.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pbd::reference {

struct KnownAnswer {
  std::string family;  // of related rows
  std::string statement;
  std::string unit;
  double value;                 // by the formula (closed_form.h, linear_fem.h)
  std::string stated;           // decimal, as stated elsewhere; its last digit is its precision
  std::optional<double> check;  // the same by other means: quadrature, ODE, recurrence, eigenvalues
};

/// All rows; computed at the first call (milliseconds).
const std::vector<KnownAnswer>& known_answers();

/// Half a unit of the last stated digit: how far the value may be from a correctly rounded statement.
double half_digit(const KnownAnswer& row);

}  // namespace pbd::reference
