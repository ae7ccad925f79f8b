#include "scenes/scene_file.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "error.h"
#include "scenes/builder.h"
#include "scenes/choices.h"
#include "scenes/document.h"
#include "scenes/read_probes.h"
#include "validate.h"

namespace pbdcheck {
namespace {

void read_step(Keys& root, SceneFile& found) {
  auto table = root.table("step");
  if (!table) root.refuse("step", "nothing", "a table [step] with step_s, and duration_s or steps");
  Keys& keys = *table;
  found.step_s = keys.number("step_s", Range::positive);
  if (found.step_s < pbd::least_step) keys.refuse("step_s", fmt::format("a number >= {:g}", pbd::least_step));
  const bool by_count = found.counts_steps = keys.has("steps");
  if (by_count == keys.has("duration_s"))
    keys.refuse("duration_s", by_count ? "steps and duration_s" : "nothing", "one of duration_s and steps");
  if (by_count) {
    found.steps = keys.integer_or("steps", 0, 1);
  } else {
    const double steps = std::round(keys.number("duration_s", Range::positive) / found.step_s);
    if (steps < 1 || steps > 1e9)
      keys.refuse("duration_s", fmt::format("{} steps", steps), "a duration of 1 to 1e9 steps");
    found.steps = static_cast<std::int64_t>(steps);
  }
  keys.refuse_unknown();
}

pbd::Method read_method(Keys& keys, pbd::Method method) {
  method.integrator = keys.choice_or("integrator", method.integrator, integrator_choices());
  method.outer = keys.choice_or("outer", method.outer, outer_choices());
  method.relaxation = keys.choice_or("relaxation", method.relaxation, relaxation_choices());
  method.friction = keys.choice_or("friction", method.friction, friction_choices());
  method.tolerance = keys.number_or("tolerance", method.tolerance, Range::not_negative);
  method.max_outer = keys.integer_or("max_outer", method.max_outer, 1);
  method.max_sweeps = keys.integer_or("max_sweeps", method.max_sweeps, 1);
  method.inner_tolerance = keys.number_or("inner_tolerance", method.inner_tolerance, Range::not_negative);
  method.warm_start = keys.flag_or("warm_start", method.warm_start);
  method.threads = keys.integer_or("threads", method.threads, 1, 256);
  method.memory = keys.integer_or("memory", method.memory, 0, 1000);
  method.alpha = keys.number_or("alpha", method.alpha, Range::positive);
  if (keys.has("beta")) method.beta = keys.number("beta", Range::positive);
  if (keys.has("gamma")) method.gamma = keys.number("gamma", Range::positive);
  method.rho = keys.number_or("rho", method.rho, Range::not_negative);
  method.direction_blend = keys.number_or("direction_blend", method.direction_blend, Range::not_negative);
  method.stabilisation = keys.number_or("stabilisation", method.stabilisation, Range::not_negative);
  keys.refuse_unknown();
  located(keys.where(), [&] { pbd::validate(method); });
  return method;
}

void read_scene(Keys& root, SceneFile& found) {
  Builder builder;
  for (const auto read : {read_particles, read_chains, read_cloths, read_solids, read_rigid_bodies,
                          read_gravity, read_gyroscopic, read_forces, read_torques, read_anchors,
                          read_distances, read_bendings, read_joints, read_attachments, read_contact})
    read(root, builder);
  if (builder.scene.nodes() == 0) {
    root.refuse_unknown();
    throw pbd::SetupError(root.file(), "a scene without nodes",
                          "at least one of particle, particles, chain, cloth, solid, rigid_body");
  }
  const auto& mass = builder.scene.mass;
  if (std::count(mass.begin(), mass.end(), pbd::infinity) == builder.scene.nodes())
    throw pbd::SetupError(root.file(), "a scene in which every node has infinite mass",
                          "a node that can move");
  found.scene = builder.finish();
  found.script = std::move(builder.script);
  found.bodies = std::move(builder.bodies);
  found.joints = std::move(builder.joints);
}

}  // namespace

SceneFile read_scene_file(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  const toml::table document = read_document(file, settings);
  Keys root(document, "", {file.string()});
  SceneFile found;
  if (root.has("description")) found.description = root.text("description");
  for (const auto* later : {"step", "method", "probe"}) root.has(later);  // known, though read last
  read_scene(root, found);
  read_step(root, found);
  if (auto keys = root.table("method")) {
    found.method = read_method(*keys, found.method);
    for (const auto* key : {"integrator", "direction_blend", "outer", "relaxation", "beta"})
      if (keys->has(key)) found.method_where[key] = keys->where(key);
  }
  read_probes(root, found);
  root.refuse_unknown();
  located(file.string(), [&] { pbd::validate(found.scene); });
  return found;
}

pbd::Workspace SceneFile::workspace() const {
  try {
    return pbd::Workspace(scene, method);
  } catch (const pbd::SetupError& error) {
    const std::string text = error.what(), key = text.substr(0, text.find(':'));
    const auto stated = method_where.find(key);
    if (stated == method_where.end()) throw;
    throw pbd::SetupError(stated->second + text.substr(key.size()));
  }
}

std::string scene_description(const std::filesystem::path& file) {
  return read_document(file, {})["description"].value_or(std::string());
}

pbd::Method parse_method(const std::string& settings, pbd::Method base, const std::string& option) {
  std::istringstream words(settings);
  toml::table table;
  for (std::string word; words >> word;) apply_setting(table, word, option);
  Keys keys(table, "", {option, option});
  return read_method(keys, std::move(base));
}

std::string method_text(const pbd::Method& m) {
  const std::string own_family = m.beta ? fmt::format(" beta={} gamma={}", *m.beta, *m.gamma) : "";
  const std::string threads = m.threads > 1 ? fmt::format(" threads={}", m.threads) : "";
  return fmt::format(
      "integrator={} outer={} relaxation={} friction={} tolerance={} max_outer={} max_sweeps={} "
      "inner_tolerance={} warm_start={} memory={} alpha={}{} rho={} direction_blend={} stabilisation={}{}",
      m.integrator, m.outer, m.relaxation, m.friction, m.tolerance, m.max_outer, m.max_sweeps,
      m.inner_tolerance, m.warm_start, m.memory, m.alpha, own_family, m.rho, m.direction_blend,
      m.stabilisation, threads);
}

}  // namespace pbdcheck
