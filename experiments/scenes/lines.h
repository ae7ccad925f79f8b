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

class Lines {
 public:
  /// Opens the file; throws SetupError if there is none.
  explicit Lines(std::filesystem::path file);

  /// Moves to the next line that has words, text after `#` left out; false at the end.
  bool next();

  /// As next(), but the file's end is an error: `expected` says what is missing.
  void need_next(std::string_view expected);

  const std::vector<std::string>& words() const { return words_; }

  /// Word `index` of this line as a number; throws SetupError with the line if it is missing or not one.
  double number(std::size_t index) const;
  std::int64_t integer(std::size_t index) const;

  /// Words `index` to `index + 2` as a position, finite.
  std::array<double, 3> position(std::size_t index) const;

  [[noreturn]] void refuse(std::string_view value, std::string_view allowed) const;

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::vector<std::string> words_;
  std::int64_t line_ = 0;
};

}  // namespace pbdcheck
