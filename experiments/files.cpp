#include "files.h"

#include <fstream>
#include <system_error>

#include "error.h"

namespace pbdcheck {

std::filesystem::path partial_path(const std::filesystem::path& path) {
  return path.string() + ".partial";
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  const auto partial = partial_path(path);
  {
    std::ofstream out(partial, std::ios::binary);
    out << text;
    if (!out.flush())
      throw pbd::SetupError(path.string(), "a file that cannot be written", "a writable place");
  }
  std::filesystem::rename(partial, path);
}

void require_writable(const std::filesystem::path& directory, std::string_view option) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  const std::string where = std::string(option) + " " + directory.string();
  if (!std::filesystem::is_directory(directory, failure))
    throw pbd::SetupError(where, "no directory, and none can be made there", "a directory");
  const auto trial = directory / ".pbdcheck_trial";
  if (!std::ofstream(trial))
    throw pbd::SetupError(where, "a directory that cannot be written to", "a writable one");
  std::filesystem::remove(trial, failure);
}

std::filesystem::path scenes_folder() {
  return PBDCHECK_SCENES;
}

}  // namespace pbdcheck
