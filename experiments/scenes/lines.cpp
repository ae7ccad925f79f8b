#include "lines.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "error.h"

namespace pbdcheck {

Lines::Lines(std::filesystem::path file) : file_(std::move(file)) {
  if (!std::filesystem::is_regular_file(file_))
    throw pbd::SetupError(file_.string(), "no such file", "a mesh file");
  in_.open(file_, std::ios::binary);
  if (!in_) throw pbd::SetupError(file_.string(), "a file that cannot be opened", "a readable mesh file");
}

bool Lines::next() {
  for (std::string text; std::getline(in_, text);) {
    ++line_;
    text.erase(std::min(text.find('#'), text.size()));
    std::istringstream in(text);
    words_.clear();
    for (std::string word; in >> word;) words_.push_back(word);
    if (!words_.empty()) return true;
  }
  words_.clear();
  return false;
}

void Lines::need_next(std::string_view expected) {
  if (!next()) refuse("the end of the file", expected);
}

void Lines::refuse(std::string_view value, std::string_view allowed) const {
  throw pbd::SetupError(fmt::format("{}:{}", file_.string(), line_), value, allowed);
}

double Lines::number(std::size_t index) const {
  if (index >= words_.size()) refuse(fmt::format("{} words", words_.size()), "a number more");
  const std::string& word = words_[index];
  double value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure != std::errc() || end != word.data() + word.size()) refuse("`" + word + "`", "a number");
  return value;
}

std::int64_t Lines::integer(std::size_t index) const {
  if (index >= words_.size()) refuse(fmt::format("{} words", words_.size()), "an integer more");
  const std::string& word = words_[index];
  std::int64_t value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure != std::errc() || end != word.data() + word.size()) refuse("`" + word + "`", "an integer");
  return value;
}

std::array<double, 3> Lines::position(std::size_t index) const {
  std::array<double, 3> found{};
  for (std::size_t i = 0; i < 3; ++i) {
    found[i] = number(index + i);
    if (!std::isfinite(found[i])) refuse("`" + words_[index + i] + "`", "a finite number");
  }
  return found;
}

}  // namespace pbdcheck
