#include "harness/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace pbdcheck {
namespace {

constexpr int bar_width = 30;                                     // characters
constexpr auto redraw_interval = std::chrono::milliseconds(100);  // a bar redrawn more often only flickers

/// What stderr does not take is lost: there is nowhere else to say so.
void print(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void message(std::string_view kind, std::string_view colour, std::string_view text) {
  if (on_terminal()) print("\r\033[K");
  print(in_colour() ? fmt::format("\033[{}m{}:\033[0m {}\n", colour, kind, text)
                    : fmt::format("{}: {}\n", kind, text));
}

}  // namespace

bool on_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

bool in_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return on_terminal() && (no_colour == nullptr || *no_colour == '\0');
}

void note(std::string_view text) {
  message("note", "36", text);
}

void warn(std::string_view text) {
  message("warning", "33", text);
}

void error_message(std::string_view text) {
  message("error", "31", text);
}

void SlowNotice::poll() {
  const auto spent = std::chrono::steady_clock::now() - begin_;
  if (spent < next_) return;
  note(fmt::format("{}: {:.0f} s so far", what_, std::chrono::duration<double>(spent).count()));
  next_ *= 2;
}

ProgressBar::ProgressBar(std::string title, std::int64_t units)
    : title_(std::move(title)), units_(std::max<std::int64_t>(units, 1)), terminal_(on_terminal()) {}

ProgressBar::~ProgressBar() {
  if (drawn_) print("\n");
}

void ProgressBar::advance(std::string_view label) {
  ++done_;
  if (terminal_) {
    const auto now = std::chrono::steady_clock::now();
    if (done_ >= units_ || !drawn_ || now - last_ > redraw_interval) {
      last_ = now;
      draw_bar(label);
    }
  } else if (done_ * 10 / units_ > tenths_) {
    tenths_ = done_ * 10 / units_;
    print(fmt::format("{}: {}/{} {}\n", title_, done_, units_, label));
  }
}

void ProgressBar::draw_bar(std::string_view label) {
  const auto filled = static_cast<std::size_t>(std::min(done_, units_) * bar_width / units_);
  const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
  print(fmt::format("\r\033[K{} {} {}/{} {}", title_,
                    in_colour() ? fmt::format("\033[32m{}\033[0m", bar) : bar, done_, units_, label));
  drawn_ = true;
}

}  // namespace pbdcheck
