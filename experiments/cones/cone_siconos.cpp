// Siconos' text: dimension, contacts, storage (0 dense, 1 blocks), rows, columns, W, q, mu. Dense W stands
// column by column, and so do the numbers of a block, but files with blocks written row by row are about.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "cones/cone_file.h"
#include "error.h"

namespace pbdcheck {
namespace {

using Eigen::VectorXd;
using pbd::SetupError;

class Text {
 public:
  explicit Text(const std::filesystem::path& path) : path_(path.string()), in_(path) {
    if (!in_) refuse("a file that cannot be read", "a readable one");
    characters_ = static_cast<long>(std::filesystem::file_size(path));
  }

  [[noreturn]] void refuse(const std::string& got, const std::string& allowed) const {
    throw SetupError(line_ > 0 ? fmt::format("{}:{}", path_, line_) : path_, got, allowed);
  }

  double number(const std::string& what) {
    std::string word;
    if (!next(word)) refuse("an end of the file where " + what + " should be", "the whole problem");
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end != word.c_str() + word.size()) refuse("`" + word + "` for " + what, "a number");
    if (!(std::abs(value) <= largest_in_cone))
      refuse("`" + word + "` for " + what, fmt::format("a finite number, at most {:g}", largest_in_cone));
    return value;
  }

  /// An integer of the range, no larger than the file has characters.
  int integer(const std::string& what, long least, long most) {
    const double value = number(what);
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most) &&
          value == std::floor(value)))
      refuse(fmt::format("{} = {}", what, value),
             least == most ? fmt::format("{}", least) : fmt::format("an integer from {} to {}", least, most));
    if (value > static_cast<double>(characters_))
      refuse(fmt::format("{} = {} in a file of {} characters", what, value, characters_),
             "the whole problem");
    return static_cast<int>(value);
  }

  VectorXd numbers(const std::string& what, Eigen::Index count) {
    VectorXd all(count);
    for (double& value : all) value = number(what);
    return all;
  }

  void require_end() {
    std::string word;
    if (next(word)) refuse("`" + word + "` after mu", "the end of the file");
  }

  long characters() const { return characters_; }

 private:
  bool next(std::string& word) {
    while (!(words_ >> word)) {
      std::string line;
      if (!std::getline(in_, line)) return false;
      ++line_;
      words_ = std::istringstream(line);
    }
    return true;
  }

  std::string path_;
  std::ifstream in_;
  std::istringstream words_;  // of the line
  long line_ = 0, characters_ = 0;
};

void read_dense(Text& text, int rows, StoredCone& stored) {
  if (static_cast<long>(rows) * rows > text.characters())
    text.refuse(fmt::format("{} x {} numbers of W in a file of {} characters", rows, rows, text.characters()),
                "the whole problem");
  const VectorXd numbers = text.numbers("W", static_cast<Eigen::Index>(rows) * rows);
  stored.delassus = Eigen::Map<const Eigen::MatrixXd>(numbers.data(), rows, rows).sparseView();
  stored.form = "Siconos text, dense";  // read row by row it has the same symmetric part
}

void read_blocks(Text& text, int contacts, StoredCone& stored) {
  const int blocks = text.integer("the number of blocks", 1, 1L << 31U);
  for (const char* what : {"the number of rows of blocks", "the number of columns of blocks"})
    text.integer(what, contacts, contacts);
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < contacts; ++i)
      text.integer("the end of a block of 3 rows or columns", 3L * (i + 1), 3L * (i + 1));
  text.integer("the length of the list of rows", contacts + 1, contacts + 1);
  text.integer("the length of the list of columns", blocks, blocks);
  std::vector<int> begin, column;
  for (int i = 0; i <= contacts; ++i)
    begin.push_back(text.integer("the first block of a row", i == 0 ? 0 : begin.back(), blocks));
  if (begin.front() != 0 || begin.back() != blocks)
    text.refuse("rows that do not hold all blocks", "all of them");
  for (int k = 0; k < blocks; ++k) column.push_back(text.integer("the column of a block", 0, contacts - 1));
  std::vector<Eigen::Triplet<double>> by_columns, by_rows;
  std::vector<int> row_of_last(static_cast<std::size_t>(contacts), -1);  // with a block in each column
  for (int i = 0; i < contacts; ++i)
    for (int k = begin[static_cast<std::size_t>(i)]; k < begin[static_cast<std::size_t>(i) + 1]; ++k) {
      text.integer("the number of a block", k, k);
      const int j = column[static_cast<std::size_t>(k)];
      if (std::exchange(row_of_last[static_cast<std::size_t>(j)], i) == i)
        text.refuse(fmt::format("two blocks in row {} and column {}", i, j), "one");
      const VectorXd b = text.numbers("a block", 9);
      for (int l = 0; l < 9; ++l) {
        by_columns.emplace_back(3 * i + l % 3, 3 * j + l / 3, b(l));
        by_rows.emplace_back(3 * i + l / 3, 3 * j + l % 3, b(l));
      }
    }
  stored.delassus.resize(3 * contacts, 3 * contacts);
  stored.delassus.setFromTriplets(by_columns.begin(), by_columns.end());
  stored.transposed.resize(3 * contacts, 3 * contacts);
  stored.transposed.setFromTriplets(by_rows.begin(), by_rows.end());
  stored.form = "Siconos text";
}

}  // namespace

StoredCone read_siconos(const std::filesystem::path& path) {
  Text text(path);
  constexpr long most_contacts = 1000000;
  text.integer("the dimension", 3, 3);
  const int contacts = text.integer("the number of contacts", 1, most_contacts);
  const int storage = text.integer("the storage (0 dense, 1 blocks)", 0, 1);
  for (const char* what : {"the number of rows", "the number of columns"})
    text.integer(what, 3L * contacts, 3L * contacts);
  StoredCone stored;
  if (storage == 0)
    read_dense(text, 3 * contacts, stored);
  else
    read_blocks(text, contacts, stored);
  stored.free_velocity = text.numbers("q", 3 * contacts);
  stored.friction = text.numbers("mu", contacts);
  text.require_end();
  return stored;
}

}  // namespace pbdcheck
