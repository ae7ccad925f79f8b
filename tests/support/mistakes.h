// Scenes with a mistake, and what the program says of them.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "program.h"

namespace pbdcheck::test {

struct Mistake {
  std::string text;
  std::vector<std::string> message;  // parts of it
};

inline void check_refused(const Ran& ran, const std::vector<std::string>& message) {
  CHECK(ran.exit_code == 2);
  CHECK(ran.out.empty());
  for (const auto& part : message) CHECK_THAT(ran.err, Catch::Contains(part));
}

}  // namespace pbdcheck::test
