// Files that are either complete or not there: written beside their place and renamed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pbdcheck {

/// `<path>.partial`, what a file is called until it is complete.
std::filesystem::path partial_path(const std::filesystem::path& path);

/// Writes `text` to the file in one go; throws SetupError if it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view text);

/// Makes the folder a command writes to; throws SetupError naming `option` if `directory` is a file or cannot
/// be made or written to.
void require_writable(const std::filesystem::path& directory, std::string_view option = "-o");

/// Folder of the scenes and meshes that come with the program.
std::filesystem::path scenes_folder();

}  // namespace pbdcheck
