// Where results come from: the program, the machine and the settings, as run.json keeps them.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace pbdcheck {

/// Whether a run.json was written by this very program: the same commit ("unknown" outside a git work tree)
/// and the same differences from it.
bool from_this_build(const nlohmann::ordered_json& record);

/// "pbdcheck VERSION (COMMIT)" and the libraries with their versions, one a line.
std::string version_text();

/// The fields every run.json begins with: commit, dirty, changes (a hash of the
/// differences from the commit), version, compiler, flags, processor, threads, seed,
/// libraries.
nlohmann::ordered_json provenance(int threads);

/// Writes JSON with two spaces of indentation; complete or not at all.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace pbdcheck
