#include "known_answers.h"

#include <cmath>

#include "known_answers_rows.h"

namespace pbd::reference {

namespace known {

std::string number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

}  // namespace known

const std::vector<KnownAnswer>& known_answers() {
  static const known::Rows table = [] {
    known::Rows rows;
    known::oscillators(rows);
    known::particles(rows);
    known::chains(rows);
    known::solids(rows);
    known::bodies(rows);
    known::contacts(rows);
    return rows;
  }();
  return table;
}

double half_digit(const KnownAnswer& row) {
  const std::size_t exponent_at = row.stated.find('e');
  const std::string mantissa = row.stated.substr(0, exponent_at);
  const double exponent =
      exponent_at == std::string::npos ? 0 : std::stod(row.stated.substr(exponent_at + 1));
  const std::size_t point = mantissa.find('.');
  const double decimals = point == std::string::npos ? 0 : static_cast<double>(mantissa.size() - point - 1);
  return 0.5 * std::pow(10, exponent - decimals);
}

}  // namespace pbd::reference
