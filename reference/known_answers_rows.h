// The families of known answers, one source each, and what they share.
#pragma once

#include <initializer_list>
#include <numbers>
#include <string>
#include <string_view>

#include "known_answers.h"

namespace pbd::reference::known {

using Rows = std::vector<KnownAnswer>;

inline constexpr double pi = std::numbers::pi;
inline constexpr double g = 9.81;  // m/s^2

inline double radians(double degrees) {
  return degrees * pi / 180;
}

/// Decimal without trailing zeros, for statements.
std::string number(double value);

/// One text of its parts.
std::string joined(std::initializer_list<std::string_view> parts);

void oscillators(Rows& rows);
void particles(Rows& rows);
void chains(Rows& rows);
void solids(Rows& rows);
void bodies(Rows& rows);
void contacts(Rows& rows);

}  // namespace pbd::reference::known
