// Siconos' text: dimension, contacts, storage, rows, columns, W, q, mu, and perhaps a flag and a solution.
//   0 dense   rows and columns again, then W column by column
//   1 blocks  the lists of their ends and places, and each one's numbers column by column; some files have
//             them row by row
//   2 sparse  what Siconos has CSparse print of triplets (origin 1) or of compressed columns (2): W in six
//             digits (%g)
#include <fmt/format.h>

#include <limits>
#include <unordered_set>
#include <utility>

#include "cones/cone_file.h"
#include "cones/cone_text.h"

namespace pbdcheck {
namespace {

using Eigen::VectorXd;

void read_dense(ConeText& text, int rows, StoredCone& stored) {
  for (const char* what : {"the number of rows, again", "the number of columns, again"})
    text.integer(what, rows, rows);
  if (static_cast<long>(rows) * rows > text.characters())
    text.refuse(fmt::format("{} x {} numbers of W in a file of {} characters", rows, rows, text.characters()),
                "the whole problem");
  const VectorXd numbers = text.numbers("W", static_cast<Eigen::Index>(rows) * rows);
  stored.delassus = Eigen::Map<const Eigen::MatrixXd>(numbers.data(), rows, rows).sparseView();
  stored.form = "Siconos text, dense";
}

/// The ends of blocks, each of which holds whole contacts.
std::vector<int> read_ends(ConeText& text, int count, int rows) {
  std::vector<int> ends{0};
  for (int i = 0; i < count; ++i) {
    ends.push_back(text.integer("the end of a block", ends.back() + 3L, rows));
    if (ends.back() % 3 != 0)
      text.refuse(fmt::format("a block that ends at {}", ends.back()), "whole contacts");
  }
  if (ends.back() != rows)
    text.refuse(fmt::format("blocks of {} rows", ends.back()), fmt::format("{}", rows));
  return ends;
}

void read_blocks(ConeText& text, int rows, StoredCone& stored) {
  const int blocks = text.integer("the number of blocks", 1, std::numeric_limits<int>::max());
  const int lines = text.integer("the number of rows of blocks", 1, rows / 3);
  text.integer("the number of columns of blocks", lines, lines);
  const std::vector<int> row_ends = read_ends(text, lines, rows), column_ends = read_ends(text, lines, rows);
  text.integer("the length of the list of rows", lines + 1, lines + 1);
  text.integer("the length of the list of columns", blocks, blocks);
  std::vector<int> begin, column;
  for (int i = 0; i <= lines; ++i)
    begin.push_back(text.integer("the first block of a row", i == 0 ? 0 : begin.back(), blocks));
  if (begin.front() != 0 || begin.back() != blocks)
    text.refuse("rows that do not hold all blocks", "all of them");
  for (int k = 0; k < blocks; ++k) column.push_back(text.integer("the column of a block", 0, lines - 1));
  std::vector<Eigen::Triplet<double>> by_columns, by_rows;
  std::vector<int> row_of_last(static_cast<std::size_t>(lines), -1);  // with a block in each column
  for (int i = 0; i < lines; ++i)
    for (int k = begin[i]; k < begin[i + 1]; ++k) {
      text.integer("the number of a block", k, k);
      const int j = column[k];
      if (std::exchange(row_of_last[j], i) == i)
        text.refuse(fmt::format("two blocks in row {} and column {}", i, j), "one");
      const long height = row_ends[i + 1] - row_ends[i], width = column_ends[j + 1] - column_ends[j];
      if (height * width > text.characters())
        text.refuse(fmt::format("a block of {} x {} numbers in a file of {} characters", height, width,
                                text.characters()),
                    "the whole problem");
      for (long l = 0; l < height * width; ++l) {
        const double number = text.number("a block");
        by_columns.emplace_back(row_ends[i] + static_cast<int>(l % height),
                                column_ends[j] + static_cast<int>(l / height), number);
        by_rows.emplace_back(row_ends[i] + static_cast<int>(l / width),
                             column_ends[j] + static_cast<int>(l % width), number);
      }
    }
  stored.delassus.resize(rows, rows);
  stored.delassus.setFromTriplets(by_columns.begin(), by_columns.end());
  stored.transposed.resize(rows, rows);
  stored.transposed.setFromTriplets(by_rows.begin(), by_rows.end());
  stored.form = "Siconos text";
}

/// The entries of a sparse W, each of which stands once.
struct SparseEntries {
  int rows;
  std::vector<Eigen::Triplet<double>> all{};
  std::unordered_set<std::int64_t> places{};

  /// Reads `: value` of row i and column j.
  void read(ConeText& text, int i, int j) {
    text.expect(":");
    const double value = text.number("W");
    if (!places.insert(std::int64_t{rows} * j + i).second)
      text.refuse(fmt::format("another entry {} in row {} and column {}", value, i, j), "one");
    all.emplace_back(i, j, value);
  }
};

void read_triplets(ConeText& text, int count, SparseEntries& entries) {
  for (int k = 0; k < count; ++k) {
    const int i = text.integer("a row", 0, entries.rows - 1);
    const int j = text.integer("a column", 0, entries.rows - 1);
    entries.read(text, i, j);
  }
}

void read_columns(ConeText& text, int count, SparseEntries& entries) {
  text.expect("1-norm:");
  text.number("the norm");
  for (int j = 0; j < entries.rows; ++j) {
    text.expect("col");
    text.integer("a column", j, j);
    for (const char* word : {":", "locations"}) text.expect(word);
    const long read = std::ssize(entries.all);
    const int first = text.integer("a column's first entry", read, read);
    text.expect("to");
    const int last = text.integer("a column's last entry", first - 1L, count - 1L);
    for (int k = first; k <= last; ++k) entries.read(text, text.integer("a row", 0, entries.rows - 1), j);
  }
}

void read_sparse(ConeText& text, int rows, StoredCone& stored) {
  constexpr int triplets = 1, columns = 2;
  const int origin = text.integer("the origin (1 triplets, 2 compressed columns)", triplets, columns);
  while (text.word("CSparse's heading") != "nnz:") continue;
  std::string number = text.word("the number of entries");
  if (!number.empty() && number.back() == ',') number.pop_back();
  const int count =
      text.integer("the number of entries", number, 0,
                   std::min<long>(static_cast<long>(rows) * rows, std::numeric_limits<int>::max()));
  SparseEntries entries{rows};
  origin == triplets ? read_triplets(text, count, entries) : read_columns(text, count, entries);
  if (std::ssize(entries.all) != count)
    text.refuse(fmt::format("{} entries", entries.all.size()), fmt::format("{}", count));
  stored.delassus.resize(rows, rows);
  stored.delassus.setFromTriplets(entries.all.begin(), entries.all.end());
  stored.rounding = 5e-6;  // half a unit of the sixth digit of 1.00000
  stored.form = "Siconos text, sparse";
}

}  // namespace

StoredCone read_siconos(const std::filesystem::path& path) {
  ConeText text(path);
  constexpr long most_contacts = 1000000;
  text.integer("the dimension", 3, 3);
  const int contacts = text.integer("the number of contacts", 1, most_contacts);
  const int storage = text.integer("the storage (0 dense, 1 blocks, 2 sparse)", 0, 2);
  for (const char* what : {"the number of rows", "the number of columns"})
    text.integer(what, 3L * contacts, 3L * contacts);
  StoredCone stored;
  if (storage == 0)
    read_dense(text, 3 * contacts, stored);
  else if (storage == 1)
    read_blocks(text, 3 * contacts, stored);
  else
    read_sparse(text, 3 * contacts, stored);
  stored.free_velocity = text.numbers("q", 3 * contacts);
  stored.friction = text.numbers("mu", contacts);
  text.skip_solution(3L * contacts);
  return stored;
}

}  // namespace pbdcheck
