// Lets tests written for Catch2 2 (Debian 12) compile with Catch2 3 (later Debian, Ubuntu 24.04).
#pragma once

#include <catch2/catch_all.hpp>

using Catch::Approx;

namespace Catch {
using Matchers::EndsWith;
using Matchers::StartsWith;
inline auto Contains(const std::string& part) {  // NOLINT(readability-identifier-naming): Catch2's name
  return Matchers::ContainsSubstring(part);
}
}  // namespace Catch
