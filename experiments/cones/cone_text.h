// The words of a text file, one after another; what is wrong is refused with the file and the line.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace pbdcheck {

class ConeText {
 public:
  explicit ConeText(const std::filesystem::path& path);

  /// Throws SetupError naming the file and the line of the last word.
  [[noreturn]] void refuse(const std::string& got, const std::string& allowed) const;

  // Each reads the next word or words; `what` says what they are. Numbers are finite, at most
  // `largest_in_cone`; integers are of the range, and no larger than the file has characters.
  std::string word(const std::string& what);
  double number(const std::string& what);
  Eigen::VectorXd numbers(const std::string& what, Eigen::Index count);
  int integer(const std::string& what, long least, long most);
  void expect(const std::string& expected);

  /// The integer that `word` is.
  int integer(const std::string& what, const std::string& word, long least, long most) const;

  /// What may stand behind mu: a flag, and a solution of `rows` numbers, or of twice as many with velocities.
  void skip_solution(long rows);

  long characters() const { return characters_; }

 private:
  double number(const std::string& what, const std::string& word) const;
  bool next(std::string& word);

  std::string path_;
  std::ifstream in_;
  std::istringstream words_;  // of the line
  long line_ = 0, characters_ = 0;
};

}  // namespace pbdcheck
