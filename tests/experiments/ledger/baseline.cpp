#include "ledger/baseline.h"

#include <catch2/catch.hpp>

#include "error.h"
#include "harness/provenance.h"
#include "results.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

const std::string table =
    "scene,step_s,error,force_n,sweeps,wall_s,status\n"
    "\"box, on a slope\",0.01,1e-6,9.81,100,0.5,ok\n"
    "chain,0.01,nan,0,200,0.25,diverged\n";

/// Results of an experiment with one table, and its baseline.
struct Kept {
  TemporaryFolder folder;
  std::filesystem::path results = folder.path / "results", baseline = folder.path / "baseline";

  Kept() {
    std::filesystem::create_directories(results);
    write(table);
    record("complete", "quick");
  }
  void write(const std::string& text) const { write_file(results / "motion.csv", text); }
  void record(const std::string& status, const std::string& tier,
              const nlohmann::ordered_json& rows = {{"motion", 2}}) const {
    auto json = run_record(1, RunOutcome::complete, "");
    json["status"] = status;
    json["tier"] = tier;
    json["rows"] = rows;
    write_file(results / "run.json", json_text(json));
  }
  std::vector<std::string> after(const std::string& was, const std::string& is) const {
    std::string changed = table;
    REQUIRE(changed.find(was) != std::string::npos);
    changed.replace(changed.find(was), was.size(), is);
    write(changed);
    return differences(baseline, results);
  }
};

}  // namespace

TEST_CASE("a baseline tells what changed of its tables, and nothing else") {
  const Kept kept;
  bless_results(kept.results, kept.baseline, "the first one");
  CHECK(differences(kept.baseline, kept.results).empty());
  CHECK(nlohmann::json::parse(read_text(kept.baseline / "baseline.json"))["reason"] == "the first one");
  CHECK(read_text(kept.baseline / "motion.csv").find("wall_s") == std::string::npos);

  for (const auto& [was, is] : std::vector<std::pair<std::string, std::string>>{{"0.25", "99"},
                                                                                {"9.81", "9.810001"},
                                                                                {"1e-6", "1.4e-6"},
                                                                                {",0,200", ",1e-12,200"},
                                                                                {"100", "111"}}) {
    INFO(was << " -> " << is);
    CHECK(kept.after(was, is).empty());
  }
  for (const auto& [was, is, text] : std::vector<std::array<std::string, 3>>{
           {"9.81", "9.8101", "motion row 1 (box, on a slope ok): force_n is 9.8101, was 9.81"},
           {"1e-6", "1.6e-6", "motion row 1 (box, on a slope ok): error is 1.6e-6, was 1e-6"},
           {"1e-6", "nan", "error is nan, was 1e-6"},
           {"nan", "1e-12", "error is 1e-12, was nan"},
           {"100", "113", "sweeps is 113, was 100"},
           {"diverged", "ok", "status is ok, was diverged"},
           {"force_n", "push_n", "no column `force_n` any more"},
           {"chain,0.01,nan,0,200,0.25,diverged\n", "", "motion: 1 rows, were 2"},
           {"chain,", "chain,0.01,nan,0,200,0.25,diverged\nchain,", "motion: 3 rows, were 2"}}) {
    INFO(was << " -> " << is);
    const auto found = kept.after(was, is);
    REQUIRE_FALSE(found.empty());
    CHECK_THAT(found.front(), Catch::Contains(text));
  }
}

TEST_CASE("the worst difference from a baseline comes first") {
  const Kept kept;
  bless_results(kept.results, kept.baseline, "the first one");
  kept.write(
      "scene,step_s,error,force_n,sweeps,wall_s,status\n"
      "\"box, on a slope\",0.01,1e-6,9.82,100,0.5,ok\n"
      "chain,0.01,nan,5,200,0.25,diverged\n");
  const auto found = differences(kept.baseline, kept.results);
  REQUIRE(found.size() == 2);
  CHECK_THAT(found[0], Catch::StartsWith("motion row 2 (chain nan diverged): force_n is 5") ||
                           Catch::StartsWith("motion row 2 (chain diverged): force_n is 5"));
}

TEST_CASE("a table that is gone differs from its baseline, one with too few cells is refused") {
  const Kept kept;
  bless_results(kept.results, kept.baseline, "the first one");
  kept.write("scene,step_s\nchain\n");
  CHECK_THROWS_WITH(differences(kept.baseline, kept.results), Catch::Contains("motion.csv:2"));
  std::filesystem::remove(kept.results / "motion.csv");
  CHECK(differences(kept.baseline, kept.results) ==
        std::vector<std::string>{"motion: no such table any more"});
}

TEST_CASE("only a whole run at tier quick becomes a baseline") {
  const Kept kept;
  for (const auto& [status, tier] :
       std::vector<std::pair<std::string, std::string>>{{"interrupted", "quick"}, {"complete", "full"}}) {
    kept.record(status, tier);
    CHECK_THROWS_AS(bless_results(kept.results, kept.baseline, "why not"), pbd::SetupError);
  }
  std::ofstream(kept.results / "run.json") << R"({"status": 3, "tier": null})";
  CHECK_THROWS_WITH(bless_results(kept.results, kept.baseline, "why not"), Catch::Contains("status 3"));
  for (const nlohmann::ordered_json& rows :
       std::vector<nlohmann::ordered_json>{3, {1}, {{"motion", "two"}}}) {
    kept.record("complete", "quick", rows);
    CHECK_THROWS_WITH(bless_results(kept.results, kept.baseline, "why not"),
                      Catch::StartsWith((kept.results / "run.json").string() + ": got "));
  }
  std::filesystem::remove(kept.results / "run.json");
  CHECK_THROWS_AS(bless_results(kept.results, kept.baseline, "why not"), pbd::SetupError);
  CHECK_FALSE(is_baseline(kept.baseline));
}
