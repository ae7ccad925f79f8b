// Where results come from: the program, the machine and the settings, as run.json keeps them.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pbdcheck {

/// The commit this program was built from ("unknown" outside a git work tree), and whether files differed
/// from it.
std::string build_commit();
bool build_dirty();

/// "pbdcheck VERSION (COMMIT)" and the libraries with their versions, one a line.
std::string version_text();

/// The fields every run.json begins with: commit, dirty, version, compiler, flags, processor, threads, seed,
/// libraries.
nlohmann::ordered_json provenance(int threads);

/// Writes JSON with two spaces of indentation; complete or not at all.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace pbdcheck
