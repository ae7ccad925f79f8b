// Result files, read back.
#pragma once

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"

namespace pbdcheck::test {

/// The cells of a table without quotes, the header first.
inline std::vector<std::vector<std::string>> rows_of(const std::filesystem::path& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(read_text(csv));
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

inline nlohmann::json record_of(const std::filesystem::path& directory) {
  return nlohmann::json::parse(read_text(directory / "run.json"));
}

}  // namespace pbdcheck::test
