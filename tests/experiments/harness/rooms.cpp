// What sources have to keep to: the rooms of experiments/ include each other one way only, as
// experiments/README.md lists them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <string_view>

#include "program.h"
#include "studies/experiments.h"

using namespace pbdcheck::test;

namespace {

/// From what is on top to what all others may include.
const std::vector<std::string> order{"main.cpp", "bench",   "commands", "ledger", "studies",
                                     "cones",    "harness", "scenes",   "rivals"};

std::ptrdiff_t rank(const std::string& room) {
  return std::find(order.begin(), order.end(), room) - order.begin();
}

/// The files of experiments/ that a source includes, from there.
std::vector<std::filesystem::path> includes(const std::filesystem::path& source) {
  constexpr std::string_view before = "#include \"";
  std::vector<std::filesystem::path> found;
  std::istringstream in(read_text(source));
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(before)) continue;
    const auto name = line.substr(before.size(), line.rfind('"') - before.size());
    if (std::filesystem::exists(experiments_folder / name)) found.emplace_back(name);
  }
  return found;
}

/// The room of a study; a helper of all studies has none.
std::string study(const std::filesystem::path& file) {
  return *file.begin() == "studies" && std::distance(file.begin(), file.end()) > 2 ? *std::next(file.begin())
                                                                                   : "";
}

}  // namespace

TEST_CASE("rooms include downwards only") {
  int seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(experiments_folder)) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
    const auto file = std::filesystem::relative(entry.path(), experiments_folder);
    REQUIRE(rank(*file.begin()) < std::ssize(order));
    for (const auto& included : includes(entry.path())) {
      INFO(file.string() << " includes " << included.string());
      CHECK(rank(*file.begin()) <= rank(*included.begin()));
      const auto from = study(file), to = study(included);
      const bool scenes = (from == "robustness" && to == "contact") || (from == "cost" && to == "robustness");
      CHECK((from.empty() || to.empty() || from == to || scenes));
      ++seen;
    }
  }
  CHECK(seen > 100);
}

TEST_CASE("every experiment that is declared is in the list") {
  std::ifstream in(experiments_folder / "studies" / "experiments.h");
  const std::regex declaration("void (\\w+)\\(Context& context\\);");
  std::size_t declared = 0;
  for (std::string line; std::getline(in, line);) {
    std::smatch name;
    if (!std::regex_match(line, name, declaration)) continue;
    INFO(line);
    ++declared;
    const auto& list = pbdcheck::experiments();
    CHECK(
        std::any_of(list.begin(), list.end(), [&](const auto& each) { return each.name == name[1].str(); }));
  }
  CHECK(declared == pbdcheck::experiments().size());
}

TEST_CASE("no test has a semicolon in its name, where CTest would cut it and run nothing") {
  const std::regex cut("TEST_CASE\\(\"[^\"]*;");
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(experiments_folder.parent_path() / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    INFO(entry.path().string());
    CHECK(!std::regex_search(read_text(entry.path()), cut));
  }
}
