// A scene file as TOML, with the settings of the command line put in.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pbdcheck {

/// Parts of a dotted key; more would exhaust the stack of toml++, which follows them by recursion.
inline constexpr std::size_t most_key_parts = 32;

/// Puts "PATH=VALUE" into a table. PATH is dotted, entries of lists by their number from 0
/// ("solid.0.young_pa"); VALUE is TOML, or a bare word for a text. Throws SetupError beginning with `option`
/// for a path that leads nowhere or has too many parts.
void apply_setting(toml::table& root, const std::string& setting, const std::string& option);

/// Parses `file` and applies each setting of `--set`, later ones winning. Throws SetupError with file and
/// line for what is not TOML, and for keys of more than `most_key_parts` parts.
toml::table read_document(const std::filesystem::path& file, const std::vector<std::string>& settings);

}  // namespace pbdcheck
