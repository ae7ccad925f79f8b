// How far a command is, on stderr: a bar that is redrawn on a terminal, a plain line every tenth otherwise.
// NO_COLOR, if set and not empty, takes the colour off.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace pbdcheck {

/// Whether stderr is a terminal, and whether it may be coloured.
bool on_terminal();
bool in_colour();

/// Prints "warning: ..." or "error: ..." to stderr.
void warn(std::string_view text);
void error_message(std::string_view text);

class ProgressBar {
 public:
  ProgressBar(std::string title, std::int64_t units);
  ~ProgressBar();  // leaves a bar's line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// One more unit is done.
  void advance(std::string_view label);

 private:
  void draw_bar(std::string_view label);

  std::string title_;
  std::int64_t units_;
  std::int64_t done_ = 0;
  std::int64_t tenths_ = 0;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace pbdcheck
