#include "keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "choices.h"
#include "error.h"

namespace pbdcheck {
namespace {

std::string_view description(Range range) {
  switch (range) {
    case Range::finite:
      return "a finite number up to 1e100 in size";
    case Range::not_negative:
      return "a finite number >= 0, up to 1e100";
    case Range::positive:
      return "a finite number > 0, up to 1e100";
    case Range::positive_or_infinite:
      return "a number > 0 up to 1e100, or inf";
  }
  return "";
}

bool within(double value, Range range) {
  switch (range) {
    case Range::finite:
      return std::abs(value) <= largest_number;
    case Range::not_negative:
      return value >= 0 && value <= largest_number;
    case Range::positive:
      return value > 0 && value <= largest_number;
    case Range::positive_or_infinite:
      return (value > 0 && value <= largest_number) || value == pbd::infinity;
  }
  return false;
}

std::string shown(const toml::node& node) {
  std::ostringstream out;
  if (node.is_table())
    out << "a table";
  else if (node.is_floating_point())
    out << fmt::format("{}", *node.value<double>());
  else if (const auto* array = node.as_array(); array != nullptr && array->size() > 8)
    out << "a list of " << array->size() << " entries";
  else
    node.visit([&](const auto& value) { out << value; });
  std::string line;  // a list may be printed over several
  for (const char c : out.str())
    if (c != '\n' && !(c == ' ' && line.ends_with(' '))) line += c;
  return line;
}

constexpr std::string_view vector_text = "a list of three finite numbers up to 1e100 in size";

}  // namespace

Keys::Keys(const toml::table& table, std::string path, Origin origin)
    : table_(&table), path_(std::move(path)), origin_(std::move(origin)) {}

std::string Keys::where_of(const toml::node* node, std::string_view key) const {
  std::string full = path_;
  if (!key.empty()) full += (full.empty() ? "" : ".") + std::string(key);
  if (node == nullptr && path_.empty()) return full.empty() ? origin_.file : origin_.file + ": " + full;
  if (node == nullptr) node = table_;
  const auto line = node->source().begin.line;
  if (line > 0) return fmt::format("{}:{}{}{}", origin_.file, line, full.empty() ? "" : ": ", full);
  return origin_.option + " " + full;
}

std::string Keys::where() const {
  return where_of(nullptr, "");
}

std::string Keys::where(std::string_view key) const {
  return where_of(table_->get(key), key);
}

int Keys::line() const {
  const auto line = table_->source().begin.line;
  return line > 0 ? static_cast<int>(line) : std::numeric_limits<int>::max();
}

void Keys::refuse(std::string_view key, const std::string& value, std::string_view allowed) const {
  throw pbd::SetupError(where(key), value, allowed);
}

void Keys::refuse(std::string_view key, std::string_view allowed) const {
  refuse(key, shown(*table_->get(key)), allowed);
}

const toml::node* Keys::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  return table_->get(key);
}

const toml::node& Keys::need(std::string_view key, std::string_view allowed) {
  const toml::node* node = find(key);
  if (node == nullptr) refuse(key, "nothing", allowed);
  return *node;
}

bool Keys::has(std::string_view key) {
  return find(key) != nullptr;
}

double Keys::checked_number(const toml::node& node, std::string_view key, Range range) const {
  const bool is_number = node.is_floating_point() || node.is_integer();
  const double value = is_number ? *node.value<double>() : 0;
  if (!is_number || !within(value, range))
    throw pbd::SetupError(where_of(&node, key), shown(node), description(range));
  return value;
}

int Keys::checked_integer(const toml::node& node, std::string_view key, int smallest) const {
  const auto value = node.is_integer() ? *node.value<std::int64_t>() : std::int64_t{-1};
  if (!node.is_integer() || value < smallest || value > std::numeric_limits<int>::max())
    throw pbd::SetupError(where_of(&node, key), shown(node),
                          fmt::format("an integer from {} to {}", smallest, std::numeric_limits<int>::max()));
  return static_cast<int>(value);
}

pbd::Vec3 Keys::checked_vector(const toml::node& node, std::string_view key) const {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != 3)
    throw pbd::SetupError(where_of(&node, key), shown(node), vector_text);
  pbd::Vec3 vector;
  for (int i = 0; i < 3; ++i)
    vector[i] = checked_number((*array)[static_cast<std::size_t>(i)], key, Range::finite);
  return vector;
}

double Keys::number(std::string_view key, Range range) {
  return checked_number(need(key, description(range)), key, range);
}

double Keys::number_or(std::string_view key, double fallback, Range range) {
  return has(key) ? number(key, range) : fallback;
}

int Keys::integer_or(std::string_view key, int fallback, int smallest) {
  return has(key) ? checked_integer(*find(key), key, smallest) : fallback;
}

bool Keys::flag_or(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) refuse(key, shown(*node), "true or false");
  return *node->value<bool>();
}

std::string Keys::text(std::string_view key) {
  const toml::node& node = need(key, "a text in quotes");
  if (!node.is_string()) refuse(key, shown(node), "a text in quotes");
  return *node.value<std::string>();
}

std::string Keys::choice(std::string_view key, const std::vector<std::string>& allowed) {
  const auto names = allowed_names("", allowed);
  const toml::node& node = need(key, names);
  if (!node.is_string()) refuse(key, names);
  std::string name = *node.value<std::string>();
  require_name(where(key), name, allowed);
  return name;
}

std::string Keys::choice_or(std::string_view key, std::string_view fallback,
                            const std::vector<std::string>& allowed) {
  return has(key) ? choice(key, allowed) : std::string(fallback);
}

std::vector<std::string> Keys::texts(std::string_view key, std::size_t size) {
  const auto allowed = fmt::format("a list of {} texts in quotes", size);
  const toml::array& array = need_array(key, allowed);
  if (array.size() != size || !array.is_homogeneous<std::string>()) refuse(key, allowed);
  std::vector<std::string> found;
  for (const auto& entry : array) found.push_back(*entry.value<std::string>());
  return found;
}

pbd::Vec3 Keys::vector(std::string_view key) {
  return checked_vector(need(key, vector_text), key);
}

pbd::Vec3 Keys::vector_or(std::string_view key, const pbd::Vec3& fallback) {
  return has(key) ? vector(key) : fallback;
}

const toml::array& Keys::need_array(std::string_view key, std::string_view allowed) {
  const toml::node& node = need(key, allowed);
  if (!node.is_array()) refuse(key, shown(node), allowed);
  return *node.as_array();
}

std::vector<pbd::Vec3> Keys::vectors(std::string_view key) {
  std::vector<pbd::Vec3> found;
  for (const auto& node : need_array(key, "a list of lists of three numbers"))
    found.push_back(checked_vector(node, key));
  return found;
}

std::vector<double> Keys::numbers(std::string_view key, std::size_t size, Range range) {
  const auto allowed = fmt::format("a list of {} numbers", size);
  const toml::array& array = need_array(key, allowed);
  if (array.size() != size) refuse(key, allowed);
  std::vector<double> found;
  for (const auto& entry : array) found.push_back(checked_number(entry, key, range));
  return found;
}

std::vector<double> Keys::numbers_or_one(std::string_view key, std::size_t size, Range range) {
  const toml::node& node = need(key, description(range));
  if (node.is_array()) return numbers(key, size, range);
  return std::vector<double>(size, checked_number(node, key, range));
}

std::vector<std::array<double, 2>> Keys::pairs(std::string_view key) {
  constexpr std::string_view allowed = "a list of lists of two numbers";
  std::vector<std::array<double, 2>> found;
  for (const auto& node : need_array(key, allowed)) {
    const toml::array* pair = node.as_array();
    if (pair == nullptr || pair->size() != 2)
      throw pbd::SetupError(where_of(&node, key), shown(node), allowed);
    found.push_back(
        {checked_number((*pair)[0], key, Range::finite), checked_number((*pair)[1], key, Range::finite)});
  }
  return found;
}

std::vector<int> Keys::integers(std::string_view key, int smallest) {
  std::vector<int> found;
  for (const auto& node : need_array(key, "a list of integers"))
    found.push_back(checked_integer(node, key, smallest));
  return found;
}

std::vector<std::vector<int>> Keys::integer_lists(std::string_view key, std::size_t width, int smallest) {
  const std::string allowed = fmt::format("a list of {0} integers, or a list of such lists", width);
  const toml::array& array = need_array(key, allowed);
  const auto read = [&](const toml::node& node) {
    if (!node.is_array() || node.as_array()->size() != width)
      throw pbd::SetupError(where_of(&node, key), shown(node), allowed);
    std::vector<int> list;
    for (const auto& entry : *node.as_array()) list.push_back(checked_integer(entry, key, smallest));
    return list;
  };
  if (array.empty() || !array[0].is_array()) return {read(array)};
  std::vector<std::vector<int>> found;
  for (const auto& node : array) found.push_back(read(node));
  return found;
}

std::vector<Keys> Keys::tables(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const std::string full = path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  if (node->is_table()) return {Keys(*node->as_table(), full, origin_)};
  const toml::array* array = node->as_array();
  if (array == nullptr) refuse(key, shown(*node), fmt::format("a table, [{0}] or [[{0}]]", full));
  if (array->empty()) refuse(key, "an empty list", "one table or more; leave the key out for none");
  std::vector<Keys> found;
  for (const auto& entry : *array) {
    if (!entry.is_table()) throw pbd::SetupError(where_of(&entry, key), shown(entry), "a table");
    found.emplace_back(*entry.as_table(), fmt::format("{}.{}", full, found.size()), origin_);
  }
  return found;
}

std::optional<Keys> Keys::table(std::string_view key) {
  auto found = tables(key);
  if (found.empty()) return {};
  if (found.size() > 1) refuse(key, fmt::format("{} tables", found.size()), "one table");
  return std::move(found[0]);
}

void Keys::refuse_unknown() const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
    const auto line = key.source().begin.line;
    const std::string path = path_.empty() ? name : path_ + "." + name;
    throw pbd::SetupError(
        line > 0 ? fmt::format("{}:{}: {}", origin_.file, line, path) : origin_.option + " " + path,
        "unknown key `" + name + "`", allowed_names(name, asked_));
  }
}

}  // namespace pbdcheck
