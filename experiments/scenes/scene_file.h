// Scene files: everything a simulation needs, as TOML. The format is documented in README.md beside this
// file.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene.h"
#include "scenes/named.h"
#include "scenes/script.h"
#include "step/step.h"

namespace pbdcheck {

/// What `simulate` writes down after every step, of a node, a point of a rigid body, a joint or the scene.
struct Probe {
  std::string kind;  // one of probe_kinds
  std::string name;  // begins the names of its columns
  int node = 0;
  int body = -1;                        // none
  int other = -1;                       // of contact with this body alone
  pbd::Vec3 point = pbd::Vec3::Zero();  // in the body's frame
  std::size_t joint = 0;
};
inline constexpr std::array<std::string_view, 10> probe_kinds{
    "position",    "velocity", "orientation",      "angular_velocity", "energy",
    "joint_force", "momentum", "constraint_error", "contact_force",    "contacts"};

struct SceneFile {
  std::string description;  // one line, shown by `pbdcheck list scenes`
  pbd::Scene scene;
  Script script;                  // what of the scene changes with time
  std::vector<NamedBody> bodies;  // one a rigid body of the scene
  std::vector<NamedJoint> joints;
  double step_s = 0;
  std::int64_t steps = 0;
  bool counts_steps = false;  // the file states `steps`, not `duration_s`
  pbd::Method method;
  std::map<std::string, std::string> method_where;  // of its keys the file states, as errors begin
  std::vector<Probe> probes;

  /// Throws SetupError where the scene does not allow the method.
  pbd::Workspace workspace() const;
};

/// Reads and validates a scene; `settings` are "KEY=VALUE" as of `--set`. Throws SetupError with file and
/// line (or setting), key, value and what is allowed.
SceneFile read_scene_file(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

/// The file's `description` alone, empty if it has none.
std::string scene_description(const std::filesystem::path& file);

/// `base` with the settings of "KEY=VALUE KEY=VALUE ..." (keys of the scene file's [method]); throws
/// SetupError naming `option`.
pbd::Method parse_method(const std::string& settings, pbd::Method base, const std::string& option);

/// The method as the text `parse_method` reads.
std::string method_text(const pbd::Method& method);

}  // namespace pbdcheck
