#include "harness/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "error.h"

namespace pbdcheck {
namespace {

// The partial files there are: a signal handler reaches nothing but globals, and may do no more than unlink.
std::array<std::atomic<const char*>, 64> partial_files;
static_assert(std::atomic<const char*>::is_always_lock_free);

/// A free place of the list, taken by `path`; null if there is none.
std::atomic<const char*>* listed(const char* path) {
  for (auto& place : partial_files) {
    const char* none = nullptr;
    if (place.compare_exchange_strong(none, path)) return &place;
  }
  return nullptr;
}

}  // namespace

PartialFile::PartialFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) refuse(EISDIR);
  if (std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored))
    refuse(EINVAL);  // a device or a pipe would be replaced
  if (std::filesystem::is_symlink(path_, ignored) && std::filesystem::exists(path_, ignored))
    path_ = std::filesystem::canonical(path_, ignored);
  make_partial();
  out_.open(partial_, std::ios::binary);
  if (!out_) {
    const int error = errno;
    ::unlink(partial_.c_str());
    refuse(error);
  }
  listed_ = listed(partial_.c_str());
}

/// A new file: one of that name is somebody else's, or what a killed run left.
void PartialFile::make_partial() {
  constexpr int most = 1000;
  int made = -1;
  for (int k = 0; k < most && made < 0; ++k) {
    partial_ = path_.string() + (k > 0 ? "." + std::to_string(k) : "") + ".partial";
    made = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0666);
    if (made < 0 && errno != EEXIST) break;
  }
  if (made < 0) refuse(errno);
  ::close(made);
}

PartialFile::~PartialFile() {
  if (out_.is_open()) ::unlink(partial_.c_str());
  if (listed_ != nullptr) *listed_ = nullptr;
}

void PartialFile::write(std::string_view text) {
  if (!(out_ << text)) refuse(errno);
}

void PartialFile::complete() {
  if (!out_.flush()) refuse(errno);
  std::error_code failure;
  std::filesystem::rename(partial_, path_, failure);
  if (failure) refuse(failure.value());
  out_.close();
}

void PartialFile::refuse(int error) const {
  throw pbd::SetupError(path_.string(),
                        "a file that cannot be written (" + std::generic_category().message(error) + ")",
                        "a place for a file, with space");
}

void remove_partial_files() noexcept {
  for (const auto& place : partial_files)
    if (const char* path = place) ::unlink(path);
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  PartialFile file(path);
  file.write(text);
  file.complete();
}

void require_writable(const std::filesystem::path& directory, std::string_view option) {
  std::error_code failure;
  std::filesystem::create_directories(directory, failure);
  const std::string where(option), name = "`" + directory.string() + "`";
  if (!std::filesystem::is_directory(directory, failure))
    throw pbd::SetupError(where, name + ", no directory, and none can be made there", "a directory");
  const auto trial = directory / ".pbdcheck_trial";
  if (!std::ofstream(trial))
    throw pbd::SetupError(where, name + ", a directory that cannot be written to", "a writable one");
  std::filesystem::remove(trial, failure);
}

std::filesystem::path source_root() {
  return PBDCHECK_ROOT;
}

std::filesystem::path scenes_folder() {
  return source_root() / "experiments" / "scenes";
}

}  // namespace pbdcheck
