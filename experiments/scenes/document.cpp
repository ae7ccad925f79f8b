#include "document.h"

#include <fmt/format.h>

#include <charconv>

#include "error.h"

namespace pbdcheck {
namespace {

toml::table parsed(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw pbd::SetupError(file.string(), "no such file", "a scene file (TOML)");
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    throw pbd::SetupError(fmt::format("{}:{}", file.string(), error.source().begin.line), error.description(),
                          "TOML 1.0");
  }
}

/// VALUE as TOML, or as a text where that is not TOML (so that names need no quotes).
toml::table parsed_value(const std::string& text) {
  try {
    toml::table table = toml::parse("value = " + text);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
  }
  return toml::table{{"value", text}};
}

std::vector<std::string> split_path(const std::string& path, const std::string& where) {
  std::vector<std::string> parts{""};
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  for (const auto& part : parts)
    if (part.empty()) throw pbd::SetupError(where, "`" + path + "`", "a dotted path, as in step.step_s");
  return parts;
}

/// Entry `part` of a list, which must exist.
toml::node& entry(toml::array& array, const std::string& part, const std::string& where) {
  std::size_t index = array.size();
  const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (failure != std::errc() || end != part.data() + part.size() || index >= array.size())
    throw pbd::SetupError(where, "entry `" + part + "`",
                          array.empty() ? "nothing, the list is empty"
                                        : fmt::format("an entry from 0 to {}", array.size() - 1));
  return array[index];
}

/// The node one step down; a table that is not there yet is made.
toml::node& descend(toml::node& node, const std::string& part, const std::string& where) {
  if (auto* array = node.as_array()) return entry(*array, part, where);
  auto* table = node.as_table();
  if (table == nullptr)
    throw pbd::SetupError(where, "`" + part + "` below a value", "a path to a table's key");
  if (table->get(part) == nullptr) table->insert(part, toml::table{});
  return *table->get(part);
}

}  // namespace

void apply_setting(toml::table& root, const std::string& setting, const std::string& option) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0)
    throw pbd::SetupError(option, "`" + setting + "`", "KEY=VALUE, as in method.relaxation=jacobi");
  const std::string where = option + " " + setting.substr(0, equals);
  const auto parts = split_path(setting.substr(0, equals), where);
  const toml::table value = parsed_value(setting.substr(equals + 1));

  toml::node* node = &root;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) node = &descend(*node, parts[i], where);
  value.get("value")->visit([&](const auto& typed) {
    if (auto* array = node->as_array()) {
      entry(*array, parts.back(), where);
      array->replace(array->cbegin() + std::stol(parts.back()), typed);
    } else if (auto* table = node->as_table()) {
      table->insert_or_assign(parts.back(), typed);
    } else {
      throw pbd::SetupError(where, "`" + parts.back() + "` below a value", "a path to a table's key");
    }
  });
}

toml::table read_document(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  toml::table root = parsed(file);
  for (const auto& setting : settings) apply_setting(root, setting, "--set");
  return root;
}

}  // namespace pbdcheck
