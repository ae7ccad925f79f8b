#include <catch2/catch.hpp>

#include "results.h"
#include "studies/experiments.h"

using namespace pbdcheck;
using namespace pbdcheck::test;

TEST_CASE("experiments write the same tables on one thread and on two, bit for bit") {
  for (const auto run : {contraction, damping}) {
    const TemporaryFolder one, two;
    for (const auto& [folder, threads] : {std::pair{&one, 1}, {&two, 2}}) {
      Context context(folder->path, Tier::quick, threads);
      run(context);
      context.write_verdicts();
    }
    std::size_t tables = 0;
    for (const auto& entry : std::filesystem::directory_iterator(one.path)) {
      INFO(entry.path().filename().string());
      CHECK(read_text(entry.path()) == read_text(two.path / entry.path().filename()));
      ++tables;
    }
    CHECK(tables >= 2);  // of results and of verdicts
  }
}
