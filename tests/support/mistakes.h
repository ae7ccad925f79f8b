// Scenes with a mistake, and what the program says of them.
#pragma once

#include <algorithm>
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

/// Each scene is `start` and the mistake. It is refused in one line, and nothing is written.
inline void check_mistakes(const TemporaryFolder& folder, const std::string& start,
                           const std::vector<Mistake>& mistakes) {
  const auto out = folder.path / "out";
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.text);
    const auto scene = folder.write("scene.toml", start + mistake.text);
    const auto ran = run_program({"simulate", scene, "-o", out});
    check_refused(ran, mistake.message);
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(out));
  }
}

}  // namespace pbdcheck::test
