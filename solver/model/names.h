// Looking up the named variants of a list.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "error.h"

namespace pbd {

/// The error for a name that is not in a list.
inline SetupError unknown_name(std::string_view kind, std::string_view name,
                               const std::vector<std::string_view>& allowed) {
  std::string listed;
  for (const auto& entry : allowed) listed += (listed.empty() ? "" : ", ") + std::string(entry);
  return SetupError(kind, "\"" + std::string(name) + "\"", listed);
}

/// Names of a list whose entries have a `name`.
template <class List>
std::vector<std::string_view> names(const List& list) {
  std::vector<std::string_view> found;
  for (const auto& entry : list) found.push_back(entry.name);
  return found;
}

/// The entry of that name; throws SetupError listing the allowed ones.
template <class List>
const auto& find_named(const List& list, std::string_view kind, std::string_view name) {
  for (const auto& entry : list)
    if (entry.name == name) return entry;
  throw unknown_name(kind, name, names(list));
}

}  // namespace pbd
