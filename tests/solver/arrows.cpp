// Arrows between the folders of solver/ run one way, no file includes itself through others, and none is left
// out.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;

const fs::path root = PBDCHECK_SOLVER;

/// From what may include none of the others to what may include all.
const std::vector<std::string> order{"model",   "threads", "collision", "rows",
                                     "effects", "linear",  "outer",     "step"};

/// Those that stand side by side: neither includes the other.
bool apart(const std::string& a, const std::string& b) {
  return (a == "effects" && b == "linear") || (a == "linear" && b == "effects");
}

/// Files of solver/ that a file includes, from there; headers of model/ are included by their name alone.
std::vector<std::string> includes(const fs::path& file) {
  std::vector<std::string> found;
  std::ifstream in(file);
  constexpr std::string_view before = "#include \"";
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(before)) continue;
    const std::string name = line.substr(before.size(), line.rfind('"') - before.size());
    if (fs::exists(root / name))
      found.push_back(name);
    else if (fs::exists(root / "model" / name))
      found.push_back("model/" + name);
  }
  return found;
}

std::map<std::string, std::vector<std::string>> sources() {
  std::map<std::string, std::vector<std::string>> all;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp")
      all[fs::relative(entry.path(), root).generic_string()] = includes(entry.path());
  return all;
}

std::string folder(const std::string& file) {
  return file.substr(0, file.find('/'));
}

auto rank(const std::string& file) {
  return std::find(order.begin(), order.end(), folder(file)) - order.begin();
}

}  // namespace

TEST_CASE("folders of the solver include one way") {
  const auto all = sources();
  REQUIRE(all.size() > 100);
  for (const auto& [file, included] : all) {
    INFO(file);
    CHECK(rank(file) < static_cast<std::ptrdiff_t>(order.size()));
    for (const auto& other : included) {
      INFO(file << " includes " << other);
      CHECK(rank(other) <= rank(file));
      CHECK_FALSE(apart(folder(file), folder(other)));
    }
  }
}

TEST_CASE("every header of the solver is included by another file than its own source") {
  std::set<std::string> included{"model/boundary.h", "model/mass_properties.h"};  // for who builds scenes
  const auto all = sources();
  for (const auto& [file, others] : all)
    for (const auto& other : others)
      if (fs::path(file).replace_extension() != fs::path(other).replace_extension()) included.insert(other);
  for (const auto& [file, others] : all)
    if (file.ends_with(".h")) {
      INFO(file);
      CHECK(included.contains(file));
    }
}

TEST_CASE("no file of the solver includes itself through others") {
  const auto all = sources();
  std::set<std::string> done, open;
  const std::function<void(const std::string&)> visit = [&](const std::string& file) {
    if (done.contains(file)) return;
    INFO(file);
    open.insert(file);
    for (const auto& other : all.at(file))
      if (!open.contains(other))
        visit(other);
      else
        FAIL_CHECK(file << " and " << other << " include each other");
    open.erase(file);
    done.insert(file);
  };
  for (const auto& [file, included] : all) visit(file);
}
