// Tables, contexts and runs of experiments.
#include <atomic>
#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "error.h"
#include "program.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

namespace {

nlohmann::json run_record(const std::filesystem::path& directory) {
  return nlohmann::json::parse(read_text(directory / "run.json"));
}

int times_counted = 0;

const std::vector<Experiment> samples{
    {"counted", "How often does it run?", [](Context&) { ++times_counted; }},
    {"good", "Does a verdict at its bound hold?",
     [](Context& context) { context.verdict(Basis::code, "g1", "holds, \"just\"", "error", 1, 1); }},
    {"bad", "Does one above it fail?",
     [](Context& context) { context.verdict(Basis::code, "b1", "fails", "error", 2, 1); }},
    {"unknown", "Does NaN fail?",
     [](Context& context) {
       context.verdict(Basis::code, "u1", "nan", "error", std::numeric_limits<double>::quiet_NaN(), 1);
     }},
    {"titled", "What becomes of an id made of a title?",
     [](Context& context) {
       context.verdict(Basis::code, "titled.A02 four-bar,  explicit_torque.newmark 0.5", "holds", "error", 0,
                       1);
     }},
    {"worked", "What did it cost?",
     [](Context& context) {
       auto table = context.table("costs", {"sweeps", "wall_s", "error"});
       table.row({std::int64_t{3}, 0.5, 7.0});
       table.row({std::int64_t{4}, std::numeric_limits<double>::quiet_NaN(), 7.0});
       table.close();
       context.verdict(Basis::theory, "w1", "holds", "error", 0.5, 2);
     }},
    {"open", "What of a goal that is missed and a time that is not decided?",
     [](Context& context) {
       context.verdict(Basis::goal, "o1", "missed", "time", 2, 1);
       context.verdict(Basis::theory, "o2", "not decided", "time", Measured({0.5, 2}), 1);
     }},
    {"thrown", "What if it throws?",
     [](Context& context) {
       auto table = context.table("half", {"a"});
       table.row({1.0});
       throw std::runtime_error("broken");
     }},
    {"stopped", "What if it is stopped?",
     [](Context& context) {
       auto table = context.table("first", {"a"});
       table.row({1.0});
       table.row({2.0});
       table.close();
       throw Interrupted{};
     }},
    {"unwritable", "What if a table's place is taken?",
     [](Context& context) { context.table("taken", {"a"}); }},
};

}  // namespace

TEST_CASE("a table quotes as RFC 4180 asks and writes numbers that read back as they were") {
  const TemporaryFolder folder;
  const auto path = folder.path / "t.csv";
  Table table(path, {"text", "number", "count"});
  table.row({std::string("plain"), 0.1, std::int64_t{-3}});
  table.row({std::string("a,b"), std::numeric_limits<double>::quiet_NaN(), std::int64_t{0}});
  table.row({std::string("say \"x\""), std::numeric_limits<double>::infinity(), std::int64_t{0}});
  table.row(
      {std::string("two\nlines"), -std::numeric_limits<double>::infinity(), std::int64_t{9007199254740993}});
  CHECK_FALSE(std::filesystem::exists(path));
  table.close();
  CHECK(files_in(folder.path) == std::vector<std::string>{"t.csv"});
  CHECK(read_text(path) ==
        "text,number,count\nplain,0.10000000000000001,-3\n\"a,b\",nan,0\n\"say \"\"x\"\"\",inf,0\n"
        "\"two\nlines\",-inf,9007199254740993\n");
}

TEST_CASE("a table that is not closed leaves nothing, and an older one of its name stays") {
  const TemporaryFolder folder;
  const auto path = folder.write("t.csv", "old\n");
  {
    Table table(path, {"a"});
    table.row({1.0});
    Table moved(std::move(table));
    moved.row({2.0});
  }
  CHECK(files_in(folder.path) == std::vector<std::string>{"t.csv"});
  CHECK(read_text(path) == "old\n");
}

TEST_CASE("a row of the wrong width and a place that cannot be written to are refused") {
  const TemporaryFolder folder;
  Table table(folder.path / "t.csv", {"a", "b"});
  CHECK_THROWS_AS(table.row({1.0}), std::logic_error);
  CHECK_THROWS_AS(Table(folder.path / "none" / "t.csv", {"a"}), pbd::SetupError);
}

TEST_CASE("parallel work visits each index once and rethrows the failure of the smallest index") {
  for (const int threads : {1, 4}) {
    const TemporaryFolder folder;
    const Context context(folder.path, Tier::quick, threads);
    std::vector<std::int64_t> result(1000, -1);
    context.parallel(1000, [&](std::int64_t i) { result[static_cast<std::size_t>(i)] += i + 1; });
    for (std::int64_t i = 0; i < 1000; ++i) REQUIRE(result[static_cast<std::size_t>(i)] == i);
    CHECK_THROWS_WITH(context.parallel(100,
                                       [](std::int64_t i) {
                                         if (i >= 3) throw std::runtime_error("index " + std::to_string(i));
                                       }),
                      "index 3");
  }
}

TEST_CASE("there are no more threads than work") {
  const TemporaryFolder folder;
  std::atomic<int> done = 0;
  Context(folder.path, Tier::quick, std::numeric_limits<int>::max()).parallel(3, [&](std::int64_t) {
    ++done;
  });
  CHECK(done == 3);
}

TEST_CASE("a run writes its verdicts and record, and its exit code says whether all hold") {
  const TemporaryFolder folder;
  RunOptions options{.experiments = {"good"}, .directory = folder.path};
  CHECK(run(options, samples) == exit_done);
  CHECK(files_in(folder.path / "good") == std::vector<std::string>{"run.json", "verdicts.csv"});
  CHECK(read_text(folder.path / "good" / "verdicts.csv") ==
        "id,class,statement,quantity,measured,measured_low,measured_high,bound,verdict,reason\n"
        "g1,code,\"holds, \"\"just\"\"\",error,1,1,1,1,holds,\n");
  const auto record = run_record(folder.path / "good");
  CHECK(record["status"] == "complete");
  CHECK(record["tier"] == "quick");
  CHECK(record["verdicts"]["holds"] == 1);
  for (const auto* key : {"commit", "dirty", "version", "compiler", "flags", "processor", "threads", "seed",
                          "settings", "libraries", "wall_s"})
    CHECK(record.contains(key));
  CHECK(record["march"] != "native");  // says nothing on another machine
  CHECK_THAT(record["march"].get<std::string>(),
             Catch::Matches("[a-z0-9._+-]+") && !Catch::Equals("unknown"));
  CHECK_THAT(record["date"].get<std::string>(),
             Catch::Matches("20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ"));
  CHECK_THAT(record["system"].get<std::string>(), Catch::Contains(" "));  // a name and a release
  CHECK(record["cores"].get<int>() >= 1);
  CHECK(record["load"].get<double>() >= 0);

  for (const auto* name : {"bad", "unknown"}) {
    options.experiments = {name};
    CHECK(run(options, samples) == exit_failed);
    CHECK(run_record(folder.path / name)["verdicts"]["fails"] == 1);
  }
}

TEST_CASE("a goal that is missed and a time that is not decided are counted, and are no failure") {
  const TemporaryFolder folder;
  CHECK(run({.experiments = {"open"}, .directory = folder.path}, samples) == exit_done);
  CHECK(run_record(folder.path / "open")["verdicts"].dump() ==
        R"({"fails":0,"holds":0,"missed":1,"not_decided":1})");
  CHECK_THAT(read_text(folder.path / "open" / "verdicts.csv"),
             Catch::Contains("o1,goal,missed,time,2,2,2,1,missed,2 > 1\n") &&
                 Catch::Contains("1.25,0.5,2,1,not_decided,\"spread: repeats from 0.5 to 2, bound 1\"\n"));
  CHECK(run({.experiments = {"open", "bad"}, .directory = folder.path}, samples) == exit_failed);
}

TEST_CASE("each run adds a whole line to the history, below what an earlier one left") {
  const TemporaryFolder folder;
  const RunOptions options{.experiments = {"worked", "unknown"}, .directory = folder.path};
  run(options, samples);
  const std::string first = read_text(folder.path / "history.jsonl");
  CHECK(std::count(first.begin(), first.end(), '\n') == 1);
  const auto line = nlohmann::json::parse(first);
  for (const auto* key : {"date", "commit", "dirty", "changes", "tier", "processor", "threads"})
    CHECK(line.contains(key));
  const auto& worked = line["experiments"]["worked"];
  CHECK(worked["status"] == "complete");
  CHECK(worked["work"].dump() == R"({"sweeps":7.0,"wall_s":0.5})");
  CHECK(worked["verdicts"].dump() ==
        R"([{"bound":2.0,"class":"theory","id":"w1","measured":0.5,"verdict":"holds"}])");
  CHECK(line["experiments"]["unknown"]["verdicts"][0]["measured"].is_null());

  folder.write("history.jsonl", first + R"({"half)");
  run({.experiments = {"stopped"}, .directory = folder.path}, samples);
  const std::string all = read_text(folder.path / "history.jsonl");
  REQUIRE(all.starts_with(first + "{\"half\n"));
  CHECK(nlohmann::json::parse(all.substr(first.size() + 7))["experiments"]["stopped"]["status"] ==
        "interrupted");
}

TEST_CASE("a history that cannot be written is one clear error") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path / "history.jsonl");
  CHECK_THROWS_WITH(run({.experiments = {"good"}, .directory = folder.path}, samples),
                    Catch::Contains("history.jsonl"));
}

TEST_CASE("ids of verdicts are lower case letters, digits, dots and single _") {
  const TemporaryFolder folder;
  CHECK(run({.experiments = {"titled"}, .directory = folder.path}, samples) == exit_done);
  CHECK_THAT(read_text(folder.path / "titled" / "verdicts.csv"),
             Catch::Contains("\ntitled.a02_four_bar_explicit_torque.newmark_0.5,code,holds,"));
}

TEST_CASE("the record counts the rows of each table that is complete") {
  const TemporaryFolder folder;
  run({.experiments = {"bad", "thrown", "stopped"}, .directory = folder.path}, samples);
  CHECK(run_record(folder.path / "bad")["rows"].dump() == "{\"verdicts\":1}");
  CHECK(run_record(folder.path / "thrown")["rows"].dump() == "{\"verdicts\":0}");
  CHECK(run_record(folder.path / "stopped")["rows"].dump() == "{\"first\":2,\"verdicts\":0}");
}

TEST_CASE("an experiment that throws or is stopped says so and leaves no partial files") {
  const TemporaryFolder folder;
  RunOptions options{.experiments = {"thrown", "good"}, .directory = folder.path};
  CHECK(run(options, samples) == exit_failed);
  CHECK(files_in(folder.path / "thrown") == std::vector<std::string>{"run.json", "verdicts.csv"});
  CHECK(run_record(folder.path / "thrown")["status"] == "failed");
  CHECK(run_record(folder.path / "thrown")["reason"] == "broken");
  CHECK(run_record(folder.path / "good")["status"] == "complete");  // the others still run

  std::filesystem::create_directory(folder.path / "stopped");
  folder.write("stopped/run.json", "{}");
  folder.write("stopped/second.csv", "of an earlier run");
  options.experiments = {"stopped", "bad"};
  CHECK(run(options, samples) == exit_interrupted);
  CHECK(run_record(folder.path / "stopped")["status"] == "interrupted");
  CHECK(files_in(folder.path / "stopped") ==
        std::vector<std::string>{"first.csv", "run.json", "verdicts.csv"});
  CHECK_FALSE(std::filesystem::exists(folder.path / "bad"));
}

TEST_CASE("an experiment that cannot write its results makes the exit code 2, and the others still run") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path / "unwritable" / "taken.csv");
  const RunOptions options{.experiments = {"unwritable", "good", "bad"}, .directory = folder.path};
  CHECK(run(options, samples) == exit_usage);
  CHECK(run_record(folder.path / "unwritable")["status"] == "failed");
  CHECK_THAT(run_record(folder.path / "unwritable")["reason"].get<std::string>(),
             Catch::Contains((folder.path / "unwritable" / "taken.csv").string()));
  CHECK(run_record(folder.path / "bad")["status"] == "complete");
}

TEST_CASE("run --resume skips what is complete with the same tier, and repeats the rest") {
  const TemporaryFolder folder;
  RunOptions options{.experiments = {"counted"}, .resume = true, .directory = folder.path};
  times_counted = 0;
  CHECK(run(options, samples) == exit_done);
  CHECK(run(options, samples) == exit_done);
  CHECK(times_counted == 1);
  options.tier = "full";
  CHECK(run(options, samples) == exit_done);
  CHECK(times_counted == 2);

  const auto record = run_record(folder.path / "counted");
  for (const auto& [key, value] :
       std::map<std::string, std::string>{{"status", "interrupted"}, {"commit", "old"}}) {
    auto changed = record;
    changed[key] = value;
    folder.write("counted/run.json", changed.dump());
    const int before = times_counted;
    CHECK(run(options, samples) == exit_done);
    CHECK(times_counted == before + 1);
  }
  folder.write("counted/run.json", "{ not json");
  CHECK(run(options, samples) == exit_done);
  CHECK(times_counted == 5);
  for (const auto* key : {"commit", "changes", "status", "tier"}) {
    auto changed = record;
    changed[key] = 7;
    const auto file = folder.write("counted/run.json", changed.dump());
    CHECK_THROWS_WITH(run(options, samples), Catch::StartsWith(file.string() + ": got "));
  }
  options.resume = false;
  CHECK(run(options, samples) == exit_done);
  CHECK(times_counted == 6);
}

TEST_CASE("run --resume repeats what has lost a table or a part of one, and tells of verdicts that fail") {
  const TemporaryFolder folder;
  RunOptions options{.experiments = {"worked"}, .resume = true, .directory = folder.path};
  CHECK(run(options, samples) == exit_done);
  const std::string costs = read_text(folder.path / "worked" / "costs.csv"),
                    verdicts = read_text(folder.path / "worked" / "verdicts.csv");
  for (const std::size_t left : {costs.size() - 2, costs.size() - 1, std::size_t(40), std::size_t(0)}) {
    folder.write("worked/costs.csv", costs.substr(0, left));
    CHECK(run(options, samples) == exit_done);
    CHECK(read_text(folder.path / "worked" / "costs.csv") == costs);
  }
  std::filesystem::remove(folder.path / "worked" / "verdicts.csv");
  CHECK(run(options, samples) == exit_done);
  CHECK(read_text(folder.path / "worked" / "verdicts.csv") == verdicts);
  options.experiments = {"bad"};
  for (int k = 0; k < 2; ++k) CHECK(run(options, samples) == exit_failed);
}
