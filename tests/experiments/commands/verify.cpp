// The command `verify` as a user runs it, and how it goes on after an interruption.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "error.h"
#include "harness/interrupt.h"
#include "planted_rows_of_ledger.h"
#include "results.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

TEST_CASE("verify --only runs the rows of a pattern, prints a table and records the run") {
  const TemporaryFolder folder;
  const auto ran = run_program({"verify", "--only", "particle.*", "-o", folder.path});
  INFO(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Catch::Contains("particle.fall_lag") && Catch::Contains("holds") &&
                          Catch::Contains(" hold, 0 fail, 0 fail as expected, 0 skipped"));
  CHECK_THAT(ran.out, !Catch::Contains("pendulum."));
  const auto record = record_of(folder.path / "verify");
  CHECK(record["status"] == "complete");
  CHECK(record["settings"]["only"] == "particle.*");
  CHECK(record["verdicts"]["fails"] == 0);
  const auto ledger = nlohmann::json::parse(read_text(folder.path / "verify" / "ledger.json"));
  CHECK(static_cast<int>(ledger.size()) == record["verdicts"]["holds"].get<int>());
}

TEST_CASE("verify prints JSON with the fields that scripts read, and writes JUnit's XML") {
  const TemporaryFolder folder;
  const auto xml = folder.path / "ledger.xml";
  const auto ran =
      run_program({"verify", "--only", "friction.diagonal*", "--json", "--junit", xml, "-o", folder.path});
  CHECK(ran.exit_code == 0);
  const auto array = nlohmann::json::parse(ran.out);
  REQUIRE(array.size() == 2);
  for (const auto* field :
       {"id", "statement", "quantity", "expected", "measured", "bound", "verdict", "reason", "wall_s"})
    CHECK(array[0].contains(field));
  CHECK(array[0]["verdict"] == "holds");
  CHECK(array[0]["reason"] == "");
  CHECK(array[1]["verdict"] == "expected_failure");
  CHECK_THAT(array[1]["reason"].get<std::string>(), Catch::Contains("sqrt(2) mu g"));
  const auto text = read_text(xml);
  CHECK(balanced(text));
  CHECK_THAT(text, Catch::Contains("tests=\"2\" failures=\"0\""));
}

TEST_CASE("a pattern that no row matches is refused with what is allowed") {
  const TemporaryFolder folder;
  const auto ran = run_program({"verify", "--only", "pendulum.perod_5", "-o", folder.path});
  CHECK(ran.exit_code == 2);
  CHECK_THAT(ran.err, Catch::Contains("--only: got `pendulum.perod_5`") &&
                          Catch::Contains("FAMILY one of oscillator, particle, pendulum") &&
                          Catch::Contains("did you mean `pendulum.period_5`?"));
  CHECK(run_program({"verify", "--tier", "slow", "-o", folder.path}).exit_code == 2);
  CHECK(run_program({"verify", "--junit", "", "-o", folder.path}).exit_code == 2);
  CHECK(run_program({"verify", "--only", "", "-o", folder.path}).exit_code == 2);
}

TEST_CASE("a file of JUnit that cannot be written is refused before any row is run") {
  const TemporaryFolder folder;
  folder.write("file", "");
  const auto xml = folder.path / "file" / "rows.xml", out = folder.path / "out";
  const auto ran = run_program({"verify", "--only", "pendulum.period_5", "--junit", xml, "-o", out});
  CHECK(ran.exit_code == 2);
  CHECK_THAT(ran.err, Catch::Contains("--junit: got"));
  CHECK(!std::filesystem::exists(out));
}

TEST_CASE("rows of the full tier are skipped in the quick one") {
  const TemporaryFolder folder;
  const auto ran =
      run_program({"verify", "--only", "cantilever.torsion_mesh_4", "--json", "-o", folder.path});
  CHECK(ran.exit_code == 0);
  CHECK(nlohmann::json::parse(ran.out)[0]["reason"] == "of tier full");
}

namespace {

/// Two rows that count their runs; the second stops as Ctrl-C would, the first time.
struct CountedRows {
  int first = 0, second = 0;
  std::vector<LedgerRow> rows{planted_row("a.first", 1, 1, 1), planted_row("b.second", 1, 1, 1)};

  CountedRows() {
    rows[0].run = [this](const pbd::Method&) { return ++first, 1.0; };
    rows[1].run = [this](const pbd::Method&) {
      if (++second == 1) throw Interrupted{};
      return 1.0;
    };
  }
};

}  // namespace

TEST_CASE("an interrupted verify keeps what is done, and --resume does the rest") {
  const TemporaryFolder folder;
  CountedRows counted;
  VerifyOptions options{.directory = folder.path};
  CHECK(verify(options, counted.rows) == exit_interrupted);
  CHECK(record_of(folder.path / "verify")["status"] == "interrupted");
  options.resume = true;
  CHECK(verify(options, counted.rows) == exit_done);
  CHECK(counted.first == 1);
  CHECK(counted.second == 2);
  CHECK(record_of(folder.path / "verify")["verdicts"]["holds"] == 2);
  options.resume = false;
  CHECK(verify(options, counted.rows) == exit_done);
  CHECK(counted.first == 2);
}

TEST_CASE("results of another program are none of a resumed verify's, though it has run nothing yet") {
  const TemporaryFolder folder;
  int runs = 0;
  std::vector<LedgerRow> rows{planted_row("a.first", 1, 1, 1), planted_row("c.slow", 1, 1, 1)};
  rows[0].run = [&](const pbd::Method&) { return ++runs, 1.0; };
  rows[1].tier = Tier::full;
  VerifyOptions options{.directory = folder.path};
  CHECK(verify(options, rows) == exit_done);
  auto record = record_of(folder.path / "verify");
  record["commit"] = "old";
  folder.write("verify/run.json", record.dump());
  options.resume = true;
  options.only = "c.*";
  CHECK(verify(options, rows) == exit_done);
  options.only.clear();
  CHECK(verify(options, rows) == exit_done);
  CHECK(runs == 2);
}

TEST_CASE("results that are none are refused by --resume") {
  const TemporaryFolder folder;
  CountedRows counted;
  VerifyOptions options{.directory = folder.path};
  verify(options, counted.rows);
  const std::string row = R"({"id": "a.first", "verdict": "perhaps", "expected": 1, "measured": 1, "bound": 1,
    "reason": "", "wall_s": 0})";
  options.resume = true;
  const std::string altered =
      R"({"id": "a.first", "verdict": "holds", "expected": 1, "measured": 1e9, "bound": 1,
    "reason": "", "wall_s": 0})";
  const std::string widened =
      R"({"id": "a.first", "verdict": "holds", "expected": 1, "measured": 77, "bound": 1e300,
    "reason": "", "wall_s": 0})";
  for (const std::string& wrong : {std::string("[{\"id\": 3}]"), std::string("[{"), "[" + row + "]",
                                   "[" + altered + "]", "[" + widened + "]"}) {
    const auto file = folder.write("verify/ledger.json", wrong);
    CHECK_THROWS_WITH(verify(options, counted.rows), Catch::StartsWith(file.string() + ": got "));
  }
}

TEST_CASE("a record whose commit is no text is refused by --resume") {
  const TemporaryFolder folder;
  CountedRows counted;
  VerifyOptions options{.directory = folder.path};
  verify(options, counted.rows);
  options.resume = true;
  const auto file = folder.write("verify/run.json", R"({"commit": 3, "changes": null})");
  CHECK_THROWS_WITH(verify(options, counted.rows), Catch::StartsWith(file.string() + ": got "));
}

TEST_CASE("a row that fails makes verify's exit code 1") {
  const TemporaryFolder folder;
  const VerifyOptions options{.directory = folder.path};
  CHECK(verify(options, {planted_row("a.right", 1, 1, 0.1), planted_row("a.wrong", 1, 2, 0.1)}) ==
        exit_failed);
  CHECK(record_of(folder.path / "verify")["verdicts"]["fails"] == 1);
}
