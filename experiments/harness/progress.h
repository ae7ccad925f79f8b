// How far a command is, on stderr: a bar that is redrawn on a terminal, a plain line every tenth otherwise.
// NO_COLOR, if set and not empty, takes the colour off.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace pbdcheck {

/// Whether stderr is a terminal, and whether it may be coloured.
bool on_terminal();
bool in_colour();

/// Prints "note: ...", "warning: ..." or "error: ..." to stderr.
void note(std::string_view text);
void warn(std::string_view text);
void error_message(std::string_view text);

/// Says on stderr that something takes long: after 5 s, and each time as long again as it has taken.
class SlowNotice {
 public:
  explicit SlowNotice(std::string what) : what_(std::move(what)) {}

  /// To be called often.
  void poll();

 private:
  std::string what_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::seconds next_{5};  // what is sooner done nobody waits for
};

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
