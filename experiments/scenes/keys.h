// One table of a scene file being read: typed access to its keys, each checked as it is read, so that what is
// left unread is a key nobody knows.
//
// Every error is a SetupError "FILE:LINE: TABLE.KEY: got VALUE; allowed: ..."; a value that came from the
// command line has no line and stands as "--set TABLE.KEY".
#pragma once

#include <toml++/toml.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene.h"
#include "scenes/values.h"

namespace pbdcheck {

/// Where tables come from: the file, and the option whose values have no line in it.
struct Origin {
  std::string file;
  std::string option = "--set";
};

class Keys {
 public:
  /// `path` is the table's dotted path from the file's root, empty for the root itself.
  Keys(const toml::table& table, std::string path, Origin origin);

  bool has(std::string_view key);

  double number(std::string_view key, Range range);
  double number_or(std::string_view key, double fallback, Range range);
  int integer_or(std::string_view key, int fallback, int smallest,
                 int largest = std::numeric_limits<int>::max());
  bool flag_or(std::string_view key, bool fallback);
  std::string text(std::string_view key);
  std::vector<std::string> texts(std::string_view key, std::size_t size);
  std::string choice(std::string_view key, const std::vector<std::string>& allowed);
  std::string choice_or(std::string_view key, std::string_view fallback,
                        const std::vector<std::string>& allowed);

  pbd::Vec3 vector(std::string_view key);
  pbd::Vec3 vector_or(std::string_view key, const pbd::Vec3& fallback);
  std::vector<pbd::Vec3> vectors(std::string_view key);

  /// A list of `size` numbers.
  std::vector<double> numbers(std::string_view key, std::size_t size, Range range);

  /// The same, or one number repeated `size` times.
  std::vector<double> numbers_or_one(std::string_view key, std::size_t size, Range range);

  /// A list of lists of two numbers.
  std::vector<std::array<double, 2>> pairs(std::string_view key);

  std::vector<int> integers(std::string_view key, int smallest);

  /// Lists of `width` integers: one list, or a list of such lists.
  std::vector<std::vector<int>> integer_lists(std::string_view key, std::size_t width, int smallest);

  /// The sub-table or the sub-tables ([key] and [[key]] both do), in the file's order; none if absent.
  std::vector<Keys> tables(std::string_view key);

  /// The only sub-table, if there is one.
  std::optional<Keys> table(std::string_view key);

  /// Throws for the first key of the table that was never asked for, with the nearest one that was.
  void refuse_unknown() const;

  [[noreturn]] void refuse(std::string_view key, const std::string& value, std::string_view allowed) const;

  /// Refuses the value that stands at `key`.
  [[noreturn]] void refuse(std::string_view key, std::string_view allowed) const;

  /// Where the table itself, or a key of it, stands, as errors begin.
  std::string where() const;
  std::string where(std::string_view key) const;
  int line() const;
  const std::string& file() const { return origin_.file; }

 private:
  const toml::node* find(std::string_view key);
  const toml::node& need(std::string_view key, std::string_view allowed);
  double checked_number(const toml::node& node, std::string_view key, Range range) const;
  int checked_integer(const toml::node& node, std::string_view key, int smallest,
                      int largest = std::numeric_limits<int>::max()) const;
  pbd::Vec3 checked_vector(const toml::node& node, std::string_view key) const;
  const toml::array& need_array(std::string_view key, std::string_view allowed);
  std::string where_of(const toml::node* node, std::string_view key) const;

  const toml::table* table_;
  std::string path_;
  Origin origin_;
  std::vector<std::string> asked_;
};

}  // namespace pbdcheck
