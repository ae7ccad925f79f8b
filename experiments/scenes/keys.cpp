#include "scenes/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "error.h"
#include "scenes/choices.h"

namespace pbdcheck {
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
  double value = 0;
  if (node.is_floating_point()) value = *node.value<double>();
  if (node.is_integer()) value = static_cast<double>(*node.value<std::int64_t>());  // beyond 2^53 rounded
  if (!is_number || !within(value, range))
    throw pbd::SetupError(where_of(&node, key), shown(node), description(range));
  return value;
}

int Keys::checked_integer(const toml::node& node, std::string_view key, int smallest, int largest) const {
  const auto value = node.is_integer() ? *node.value<std::int64_t>() : std::int64_t{-1};
  if (!node.is_integer() || value < smallest || value > largest)
    throw pbd::SetupError(where_of(&node, key), shown(node),
                          fmt::format("an integer from {} to {}", smallest, largest));
  return static_cast<int>(value);
}

double Keys::number(std::string_view key, Range range) {
  return checked_number(need(key, description(range)), key, range);
}

double Keys::number_or(std::string_view key, double fallback, Range range) {
  return has(key) ? number(key, range) : fallback;
}

int Keys::integer_or(std::string_view key, int fallback, int smallest, int largest) {
  return has(key) ? checked_integer(*find(key), key, smallest, largest) : fallback;
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
