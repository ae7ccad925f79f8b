#include "scenes/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "error.h"

namespace pbdcheck {
namespace {

/// The whole of `text` as a number; false if it is not one.
template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failure == std::errc() && end == text.data() + text.size();
}

std::string counted(std::size_t words) {
  return fmt::format("{} word{}", words, words == 1 ? "" : "s");
}

bool is_control(char c) {
  return c == 127 || (c >= 0 && c < ' ' && (c < '\t' || c > '\r'));
}

}  // namespace

std::string unreadable(const std::filesystem::path& file) {
  std::error_code failure;
  const auto status = std::filesystem::status(file, failure);
  if (status.type() == std::filesystem::file_type::not_found) return "no such file";
  if (failure) return failure.message();
  if (std::filesystem::is_directory(status)) return "a folder";
  if (!std::filesystem::is_regular_file(status)) return "no regular file";
  return std::ifstream(file) ? "" : "a file that cannot be opened";
}

Lines::Lines(std::filesystem::path file) : file_(std::move(file)) {
  const auto reason = unreadable(file_);
  if (!reason.empty()) throw pbd::SetupError(file_.string(), reason, "a mesh file");
  in_.open(file_, std::ios::binary);
  std::string mark(3, ' ');
  if (!in_.read(mark.data(), 3) || mark != "\xEF\xBB\xBF") {
    in_.clear();
    in_.seekg(0);
  }
}

bool Lines::next() {
  for (std::string text; std::getline(in_, text);) {
    ++line_;
    if (std::any_of(text.begin(), text.end(), is_control)) refuse("binary data", "a text file");
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

void Lines::need_first(std::string_view first) const {
  if (words_[0] != first) refuse("`" + words_[0] + "`", first);
}

void Lines::need_words(std::size_t least, std::size_t most, std::string_view meaning) const {
  if (words_.size() < least || words_.size() > most) refuse(counted(words_.size()), meaning);
}

void Lines::need_words(std::size_t number, std::string_view meaning) const {
  need_words(number, number, fmt::format("{}: {}", number, meaning));
}

void Lines::need_end() {
  if (next()) refuse("`" + words_[0] + "`", "the end of the file, after as many entries as it announces");
}

void Lines::refuse(std::string value, std::string_view allowed) const {
  throw pbd::SetupError(line_ == 0 ? file_.string() : fmt::format("{}:{}", file_.string(), line_),
                        ascii(std::move(value)), allowed);
}

std::string ascii(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < 0; }, '?');
  return text;
}

const std::string& Lines::word(std::size_t index) const {
  if (index >= words_.size()) refuse(counted(words_.size()), "a number more");
  return words_[index];
}

double Lines::number(std::size_t index) const {
  double value = 0;
  if (!parse(word(index), value)) refuse("`" + words_[index] + "`", "a number");
  return value;
}

std::int64_t Lines::integer(std::size_t index) const {
  return integer(std::string_view(word(index)));
}

std::int64_t Lines::integer(std::string_view text) const {
  std::int64_t value = 0;
  if (!parse(text, value)) refuse(fmt::format("`{}`", text), "an integer");
  return value;
}

std::size_t Lines::count(std::size_t index) const {
  const auto value = integer(index);
  if (value < 0) refuse(fmt::format("{}", value), "a count >= 0");
  return static_cast<std::size_t>(value);
}

std::size_t Lines::count_or_none(std::size_t index) const {
  return index < words_.size() ? count(index) : 0;
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
