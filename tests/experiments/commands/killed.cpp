// A run that is killed at any moment leaves nothing half-written, and --resume ends in the same tables.
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <map>
#include <random>

#include "results.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

/// Experiments without times in their tables.
std::vector<std::string> untimed_run(const std::filesystem::path& folder) {
  return {"run", "contact_contraction", "convex_gap", "friction_isotropy", "redundant", "--resume",
          "-o",  folder.string()};
}

/// Contents of the tables, by their place in the folder.
std::map<std::string, std::string> tables_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> tables;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".csv")
      tables[entry.path().lexically_relative(folder).string()] = read_text(entry.path());
  return tables;
}

/// Files that were being written. What is killed at once leaves its own, which no run takes for a result.
int partial_files_in(const std::filesystem::path& folder) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    count += entry.path().extension() == ".partial";
  return count;
}

}  // namespace

TEST_CASE("killed at ten moments and resumed, a run writes the tables of one that was left alone") {
  const TemporaryFolder whole;
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(run_program(untimed_run(whole.path)).exit_code == 0);
  const std::chrono::duration<double> alone = std::chrono::steady_clock::now() - start;
  const auto expected = tables_in(whole.path);
  REQUIRE(expected.size() == 8);

  std::mt19937 random(20170401);
  std::uniform_real_distribution<double> part(0, 1);
  TemporaryFolder folder;
  int killed = 0, cut = 0;  // cut: something was left to do
  for (int tries = 0; killed < 10 && tries < 100; ++tries) {
    const int partial_before = partial_files_in(folder.path);
    const std::string name = killed % 2 == 0 ? "INT" : "KILL";
    const Ran ran = run_program(untimed_run(folder.path), "timeout --preserve-status -s " + name + " " +
                                                              std::to_string(part(random) * alone.count()));
    if (ran.exit_code == 0) {  // it was done before
      CHECK(tables_in(folder.path) == expected);
      std::filesystem::remove_all(folder.path);
      std::filesystem::create_directory(folder.path);
      continue;
    }
    INFO(name << ": " << ran.err);
    ++killed;
    CHECK((ran.exit_code == 3 || ran.exit_code == 128 + SIGKILL || ran.exit_code == 128 + SIGINT));
    if (name == "INT") CHECK(partial_files_in(folder.path) == partial_before);
    const auto tables = tables_in(folder.path);
    cut += tables != expected;
    for (const auto& [table, content] : tables) {
      INFO(table);
      const auto record = folder.path / std::filesystem::path(table).parent_path() / "run.json";
      if (std::filesystem::exists(record) && record_of(record.parent_path())["status"] == "complete")
        CHECK(content == expected.at(table));
      else
        CHECK((expected.at(table).rfind(content, 0) == 0 &&
               content.back() == '\n'));  // whole rows, the first ones
    }
  }
  CHECK(killed == 10);
  CHECK(cut > 0);
  CHECK(run_program(untimed_run(folder.path)).exit_code == 0);
  CHECK(tables_in(folder.path) == expected);
}
