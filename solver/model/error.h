// The one exception of set-up mistakes: thrown before anything is computed, never inside a step.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pbd {

/// A mistake in what the user gave. `where` is the file and line, key or element; `value` what stands there,
/// cut after 200 characters; `allowed` what may stand there. The message is one line: control characters, as
/// a damaged file has them, are shown as `?`.
class SetupError : public std::runtime_error {
 public:
  SetupError(std::string_view where, std::string_view value, std::string_view allowed)
      : SetupError(std::string(where) + ": got " + std::string(value.substr(0, longest_value)) +
                   (value.size() > longest_value ? "..." : "") + "; allowed: " + std::string(allowed)) {}

  explicit SetupError(std::string message) : std::runtime_error(one_line(std::move(message))) {}

 private:
  static constexpr std::size_t longest_value = 200;

  static std::string one_line(std::string text) {
    const auto control = [](char c) { return (c >= 0 && c < ' ') || c == 127; };
    std::replace_if(text.begin(), text.end(), control, '?');
    return text;
  }
};

}  // namespace pbd
