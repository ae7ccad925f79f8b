#include "scenes/values.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace pbdcheck {

std::string_view description(Range range) {
  switch (range) {
    case Range::finite:
      return "a finite number up to 1e100 in size";
    case Range::not_negative:
      return "a finite number >= 0, up to 1e100";
    case Range::positive:
      return "a finite number > 0, up to 1e100";
    case Range::positive_or_infinite:
      return "a number > 0 up to 1e100, or inf";
  }
  return "";
}

bool within(double value, Range range) {
  switch (range) {
    case Range::finite:
      return std::abs(value) <= largest_number;
    case Range::not_negative:
      return value >= 0 && value <= largest_number;
    case Range::positive:
      return value > 0 && value <= largest_number;
    case Range::positive_or_infinite:
      return (value > 0 && value <= largest_number) || value == std::numeric_limits<double>::infinity();
  }
  return false;
}

std::string shown(const toml::node& node) {
  std::ostringstream out;
  if (node.is_table())
    out << "a table";
  else if (node.is_floating_point())
    out << fmt::format("{}", *node.value<double>());
  else if (const auto* array = node.as_array(); array != nullptr && array->size() > 8)
    out << "a list of " << array->size() << " entries";
  else
    node.visit([&](const auto& value) { out << value; });
  std::string line;  // a list may be printed over several
  for (const char c : out.str())
    if (c != '\n' && !(c == ' ' && line.ends_with(' '))) line += c;
  return line;
}

}  // namespace pbdcheck
