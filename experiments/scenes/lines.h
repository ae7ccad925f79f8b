// The lines of a text file, with their numbers, for the mesh readers.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace pbdcheck {

/// Why a file cannot be read as one ("no such file", "a folder", ...); empty if it can.
std::string unreadable(const std::filesystem::path& file);

/// What a file that is no text may hold, with `?` for each byte beyond ASCII.
std::string ascii(std::string text);

class Lines {
 public:
  /// Opens the file; throws SetupError if it cannot be read. A byte order mark at its begin is skipped.
  explicit Lines(std::filesystem::path file);

  /// Moves to the next line that has words, text after `#` left out; false at the end. Refuses a line that
  /// holds control characters, as binary files do.
  bool next();

  /// As next(), but the file's end is an error: `expected` says what is missing.
  void need_next(std::string_view expected);

  /// Refuses this line unless `first` is its first word.
  void need_first(std::string_view first) const;

  /// Refuses this line unless it has `least` to `most` words; `meaning` says which.
  void need_words(std::size_t least, std::size_t most, std::string_view meaning) const;
  void need_words(std::size_t number, std::string_view meaning) const;

  /// f() at each of the next `entries` lines; where the file ends, `expected` says what is missing.
  template <class F>
  void for_each(std::size_t entries, std::string_view expected, F&& f) {
    for (; entries > 0; --entries) {
      need_next(expected);
      f();
    }
  }

  /// Refuses a further line.
  void need_end();

  const std::vector<std::string>& words() const { return words_; }

  /// Word `index` of this line as a number; throws SetupError with the line if it is missing or not one.
  double number(std::size_t index) const;
  std::int64_t integer(std::size_t index) const;

  /// A part of this line as an integer; throws SetupError with the line if it is not one.
  std::int64_t integer(std::string_view text) const;

  /// Word `index` as a count, not negative; the second one takes a word that is missing for 0.
  std::size_t count(std::size_t index) const;
  std::size_t count_or_none(std::size_t index) const;

  /// Words `index` to `index + 2` as a position, finite.
  std::array<double, 3> position(std::size_t index) const;

  [[noreturn]] void refuse(std::string value, std::string_view allowed) const;

 private:
  const std::string& word(std::size_t index) const;

  std::filesystem::path file_;
  std::ifstream in_;
  std::vector<std::string> words_;
  std::int64_t line_ = 0;
};

}  // namespace pbdcheck
