#include "cones/cone_text.h"

#include <fmt/format.h>

#include <cmath>

#include "cones/cone_file.h"
#include "error.h"
#include "scenes/lines.h"

namespace pbdcheck {

ConeText::ConeText(const std::filesystem::path& path) : path_(path.string()), in_(path) {
  if (!in_) refuse("a file that cannot be read", "a readable one");
  characters_ = static_cast<long>(std::filesystem::file_size(path));
}

void ConeText::refuse(const std::string& got, const std::string& allowed) const {
  throw pbd::SetupError(line_ > 0 ? fmt::format("{}:{}", path_, line_) : path_, ascii(got), allowed);
}

std::string ConeText::word(const std::string& what) {
  std::string found;
  if (!next(found)) refuse("an end of the file where " + what + " should be", "the whole problem");
  return found;
}

double ConeText::number(const std::string& what) {
  return number(what, word(what));
}

Eigen::VectorXd ConeText::numbers(const std::string& what, Eigen::Index count) {
  Eigen::VectorXd all(count);
  for (double& value : all) value = number(what);
  return all;
}

int ConeText::integer(const std::string& what, long least, long most) {
  return integer(what, word(what), least, most);
}

void ConeText::expect(const std::string& expected) {
  const std::string found = word("`" + expected + "`");
  if (found != expected) refuse("`" + found + "`", "`" + expected + "`, as Siconos has CSparse print it");
}

int ConeText::integer(const std::string& what, const std::string& word, long least, long most) const {
  const double value = number(what, word);
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most) &&
        value == std::floor(value)))
    refuse(fmt::format("{} = {}", what, value),
           least == most ? fmt::format("{}", least) : fmt::format("an integer from {} to {}", least, most));
  if (value > static_cast<double>(characters_))
    refuse(fmt::format("{} = {} in a file of {} characters", what, value, characters_), "the whole problem");
  return static_cast<int>(value);
}

void ConeText::skip_solution(long rows) {
  const std::string what = "what stands behind mu";
  std::string first, other;
  if (!next(first)) return;
  number(what, first);
  long count = 1;
  for (; next(other); ++count) number(what, other);
  const bool flagged = (first == "0" || first == "1") && (count - 1) % rows == 0;
  if ((!flagged && count % rows != 0) || count > 2 * rows + 1)
    refuse(fmt::format("{} numbers behind mu", count),
           fmt::format("nothing, a flag 0 or 1, a solution of {} or {} numbers, or a flag and a solution",
                       rows, 2 * rows));
}

double ConeText::number(const std::string& what, const std::string& word) const {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (end != word.c_str() + word.size()) refuse("`" + word + "` for " + what, "a number");
  if (!(std::abs(value) <= largest_in_cone))
    refuse("`" + word + "` for " + what, fmt::format("a finite number, at most {:g}", largest_in_cone));
  return value;
}

bool ConeText::next(std::string& word) {
  while (!(words_ >> word)) {
    std::string line;
    if (!std::getline(in_, line)) return false;
    ++line_;
    words_ = std::istringstream(line);
  }
  return true;
}

}  // namespace pbdcheck
