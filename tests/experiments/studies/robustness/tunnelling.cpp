// The study of things that are thrown at each other, as a user runs it: its verdicts are of every pair of
// kinds.
#include <catch2/catch.hpp>

#include "results.h"

using namespace pbdcheck::test;

TEST_CASE("nothing passes in a solved step what it begins apart from") {
  const TemporaryFolder folder;
  const auto ran = run_program({"run", "tunnelling", "-o", folder.path});
  INFO(ran.out << ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(record_of(folder.path / "tunnelling")["verdicts"]["fails"] == 0);
}
