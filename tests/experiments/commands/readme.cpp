// The commands that README.md shows do what they say.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "program.h"

using namespace pbdcheck::test;

namespace {

const std::string program = "build/release/pbdcheck";

/// The commands of README.md, with their comments; a line that ends in \ goes on.
std::vector<std::string> commands() {
  std::vector<std::string> found;
  std::istringstream in(read_text(pbdcheck::source_root() / "README.md"));
  bool goes_on = false;
  for (std::string line; std::getline(in, line); goes_on = line.ends_with('\\')) {
    if (goes_on)
      found.back() += "\n" + line;
    else if (line.starts_with(program + " "))
      found.push_back(line);
  }
  return found;
}

/// Those that take long.
const std::vector<std::string> slow{
    "run outer_convergence",  // a dozen seconds, minutes with sanitizers
    "run --all",              // hours
};

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("every quick command of the README ends well") {
  const auto all = commands();
  std::ptrdiff_t left_out = 0;
  for (std::string command : all) {
    if (std::any_of(slow.begin(), slow.end(), [&](const auto& each) {
          return command.starts_with(fmt::format("{} {} ", program, each));
        })) {
      ++left_out;
      continue;
    }
    INFO(command);
    const TemporaryFolder folder;
    replace_all(command, " -o out", " -o '" + folder.path.string() + "'");
    command.replace(0, program.size(), "'" + tested_program() + "'");
    command = fmt::format("cd '{}' && ({}\n) >'{}' 2>&1", pbdcheck::source_root().string(), command,
                          (folder.path / "log").string());
    const int status = std::system(command.c_str());
    INFO(read_text(folder.path / "log"));
    CHECK(status == 0);
  }
  CHECK(left_out == std::ssize(slow));
  CHECK(std::ssize(all) - left_out >= 8);
}
