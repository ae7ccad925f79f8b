// The one exception of set-up mistakes: thrown before anything is computed, never inside a step.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace pbd {

/// A mistake in what the user gave. `where` is the file and line, key or element; `value` what stands there;
/// `allowed` what may stand there.
class SetupError : public std::runtime_error {
 public:
  SetupError(std::string_view where, std::string_view value, std::string_view allowed)
      : std::runtime_error(std::string(where) + ": got " + std::string(value) +
                           "; allowed: " + std::string(allowed)) {}
};

}  // namespace pbd
