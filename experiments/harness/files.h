// Files that are either complete or not there: written beside their place and renamed.
#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace pbdcheck {

/// A file written to `<path>.partial` (`<path>.1.partial`, ... where there is such a file) until complete()
/// puts it in its place; without that nothing is left of it. Every failure is a SetupError naming the path.
class PartialFile {
 public:
  explicit PartialFile(std::filesystem::path path);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  void write(std::string_view text);
  void complete();

  const std::filesystem::path& path() const { return path_; }

 private:
  void make_partial();
  [[noreturn]] void refuse(int error) const;

  std::filesystem::path path_;
  std::string partial_;
  std::ofstream out_;
  std::atomic<const char*>* listed_ = nullptr;  // where remove_partial_files finds it
};

/// Removes what is not complete; a signal handler may call it right before it ends the program.
void remove_partial_files() noexcept;

/// Writes `text` to the file in one go; throws SetupError if it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Makes the folder a command writes to; throws SetupError naming `option` if `directory` is a file or cannot
/// be made or written to.
void require_writable(const std::filesystem::path& directory, std::string_view option = "-o");

/// Folder of the sources that this program was built from, with its scenes, problems and plots.
std::filesystem::path source_root();
std::filesystem::path scenes_folder();

}  // namespace pbdcheck
