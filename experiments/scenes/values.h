// Values of a scene file: which ones are allowed, and how errors show them.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace pbdcheck {

/// Which numbers a key takes. Finite ones are at most `largest_number` in size, so that squares and cubes of
/// them stay finite.
inline constexpr double largest_number = 1e100;
enum class Range { finite, not_negative, positive, positive_or_infinite };

std::string_view description(Range range);
bool within(double value, Range range);

/// In one line; long lists by their length.
std::string shown(const toml::node& node);

}  // namespace pbdcheck
