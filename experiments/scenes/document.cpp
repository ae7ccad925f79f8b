#include "scenes/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>

#include "error.h"
#include "scenes/lines.h"

namespace pbdcheck {
namespace {

/// The line (from 1) on which a dotted key has too many parts; 0 if there is none. Texts and comments are
/// skipped.
std::ptrdiff_t line_of_deep_key(std::string_view text) {
  std::size_t dots = 0;
  std::string_view closing;  // of the text or comment being skipped
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!closing.empty()) {
      if (text.substr(i).starts_with(closing)) {
        i += closing.size() - 1;
        closing = {};
      } else if (c == '\\' && closing[0] == '"') {
        ++i;
      } else if (c == '\n' && closing.size() == 1) {
        closing = {};
      }
    } else if (c == '"' || c == '\'') {
      closing = text.substr(i, text.substr(i, 3) == std::string(3, c) ? 3 : 1);
      i += closing.size() - 1;
    } else if (c == '.') {
      if (++dots == most_key_parts) return 1 + std::count(text.begin(), text.begin() + i, '\n');
    } else if (std::string_view("\n#=,[]{}").find(c) != std::string_view::npos) {
      dots = 0;
      if (c == '#') closing = "\n";
    }
  }
  return 0;
}

[[noreturn]] void refuse_deep_key(const std::string& where) {
  throw pbd::SetupError(where, "a key of too many parts",
                        fmt::format("at most {} parts, as in a.b.c", most_key_parts));
}

toml::table parsed(const std::filesystem::path& file) {
  const auto reason = unreadable(file);
  if (!reason.empty()) throw pbd::SetupError(file.string(), reason, "a scene file (TOML)");
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  if (const auto line = line_of_deep_key(text.str()))
    refuse_deep_key(fmt::format("{}:{}", file.string(), line));
  try {
    return toml::parse(text.str(), file.string());
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

/// Takes out the keys of a table that say the same in other words: a setting stands for them.
void drop_alternatives(toml::table& table, const std::string& key) {
  constexpr std::array<std::array<std::string_view, 2>, 2> alternatives{
      {{"steps", "duration_s"}, {"compliance_m_per_n", "stiffness_n_per_m"}}};
  for (const auto& [one, other] : alternatives) {
    if (key == one) table.erase(other);
    if (key == other) table.erase(one);
  }
}

}  // namespace

void apply_setting(toml::table& root, const std::string& setting, const std::string& option) {
  if (line_of_deep_key(setting) > 0) refuse_deep_key(option);
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0)
    throw pbd::SetupError(option, "`" + setting + "`",
                          option == "--set" ? "KEY=VALUE, as in method.relaxation=jacobi"
                                            : "KEY=VALUE, as in relaxation=jacobi");
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
      drop_alternatives(*table, parts.back());
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
