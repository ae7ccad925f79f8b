// Checks of what the command line is given; each refusal says what is allowed.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace pbdcheck {

/// A number above `low` and up to `high`.
CLI::Validator number_between(double low, double high);

/// Refuses an argument that is not an integer of the range.
CLI::Validator integer_from(int lowest, int highest);

CLI::Validator one_of(const std::vector<std::string>& names);

/// A flag takes no value but the one CLI11 gives it.
CLI::Validator no_value();

/// Refuses an empty argument; `allowed` is what it is to be.
CLI::Validator not_empty(const std::string& allowed);

}  // namespace pbdcheck
