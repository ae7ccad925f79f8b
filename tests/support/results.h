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

/// The numbers of a data array of a frame for ParaView.
inline std::vector<double> array_of(const std::string& frame, const std::string& name) {
  const std::size_t begin = frame.find('>', frame.find("Name=\"" + name + "\"")) + 1;
  std::istringstream in(frame.substr(begin, frame.find("</DataArray>", begin) - begin));
  std::vector<double> numbers;
  for (double number; in >> number;) numbers.push_back(number);
  return numbers;
}

inline nlohmann::json record_of(const std::filesystem::path& directory) {
  return nlohmann::json::parse(read_text(directory / "run.json"));
}

}  // namespace pbdcheck::test
