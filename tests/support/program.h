// A folder that is removed again, and the built program run in a shell.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "harness/files.h"

namespace pbdcheck::test {

/// The built program, as a path.
std::string tested_program();

inline const std::filesystem::path experiments_folder = source_root() / "experiments",
                                   scenes = scenes_folder();

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Names, sorted.
inline std::vector<std::string> files_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct TemporaryFolder {
  std::filesystem::path path;

  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pbdcheck_XXXXXX").string();
    path = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

struct Ran {
  int exit_code;
  std::string out;
  std::string err;
};

inline Ran run_program(const std::vector<std::string>& arguments, const std::string& before = "") {
  const TemporaryFolder folder;
  std::string command = before + " '" + tested_program() + "'";
  for (const auto& argument : arguments) command += " '" + argument + "'";
  command += " >'" + (folder.path / "out").string() + "' 2>'" + (folder.path / "err").string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder.path / "out"),
          read_text(folder.path / "err")};
}

}  // namespace pbdcheck::test
