#include "commands/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "scenes/choices.h"

namespace pbdcheck {

CLI::Validator integer_from(int lowest, int highest) {
  const auto refusal = [=](const std::string& text) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, failure] = std::from_chars(text.data(), end, value);
    return failure == std::errc() && stopped == end && value >= lowest && value <= highest
               ? std::string()
               : fmt::format("got `{}`; allowed: an integer from {} to {}", text, lowest, highest);
  };
  return {refusal, ""};
}

CLI::Validator number_between(double low, double high) {
  const auto refusal = [=](const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, failure] = std::from_chars(text.data(), end, value);
    if (failure == std::errc() && stopped == end && value > low && value <= high) return std::string();
    const std::string most = std::isfinite(high) ? fmt::format(", at most {:g}", high) : "";
    return fmt::format("got `{}`; allowed: a number above {:g}{}", text, low, most);
  };
  return {refusal, ""};
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  const auto refusal = [=](const std::string& text) {
    return std::find(names.begin(), names.end(), text) != names.end()
               ? std::string()
               : fmt::format("got `{}`; allowed: {}", text, allowed_names(text, names));
  };
  return {refusal, ""};
}

CLI::Validator no_value() {
  return one_of({"true"});
}

CLI::Validator not_empty(const std::string& allowed) {
  return {
      [=](const std::string& text) { return text.empty() ? "got ``; allowed: " + allowed : std::string(); },
      ""};
}

}  // namespace pbdcheck
