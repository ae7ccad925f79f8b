// Tables of what a simulation writes down.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "builder.h"
#include "choices.h"
#include "integrators.h"
#include "names.h"
#include "read_probes.h"

namespace pbdcheck {
namespace {

int named_body(Keys& keys, const SceneFile& file) {
  std::vector<std::string> names;
  for (const auto& body : file.bodies) names.push_back(body.name);
  const auto name = keys.text("body");
  if (names.empty()) keys.refuse("body", "`" + name + "`", "a [[rigid_body]], of which the scene has none");
  return static_cast<int>(std::find(names.begin(), names.end(), keys.choice_or("body", "", names)) -
                          names.begin());
}

/// The joint that `joint` names.
std::size_t named_joint(Keys& keys, const SceneFile& file) {
  std::vector<std::string> names;
  for (const auto& joint : file.joints)
    if (!joint.name.empty()) names.push_back(joint.name);
  const auto name = keys.text("joint");
  if (names.empty())
    keys.refuse("joint", "`" + name + "`", "a [[joint]] with a name, of which the scene has none");
  keys.choice_or("joint", "", names);
  const auto named = [&](const NamedJoint& joint) { return joint.name == name; };
  const auto found = std::find_if(file.joints.begin(), file.joints.end(), named);
  if (found->compliant &&
      pbd::find_named(pbd::integrators(), "integrator", file.method.integrator).explicit_forces)
    keys.refuse("joint", "a compliant joint under " + file.method.integrator,
                "a hard joint or an implicit integrator, whose steps tell the force at their end");
  return static_cast<std::size_t>(found - file.joints.begin());
}

/// Where a position or velocity is taken; returns the name of it.
std::string read_place(Keys& keys, const SceneFile& file, Probe& probe) {
  const auto& scene = file.scene;
  if (!keys.has("body")) {
    const auto nodes = select_nodes(keys, scene, numbered_nodes(scene));
    if (nodes.size() != 1)
      throw pbd::SetupError(keys.where(), fmt::format("{} nodes", nodes.size()), "one node");
    probe.node = nodes[0];
    return fmt::format("node_{}", probe.node);
  }
  probe.body = named_body(keys, file);
  const auto index = static_cast<std::size_t>(probe.body);
  const pbd::Vec3 centre = scene.initial.x.col(scene.bodies[index].node);
  probe.point = scene.initial.orientation[index].conjugate() * (keys.vector_or("point_m", centre) - centre);
  return file.bodies[index].name;
}

Probe read_probe(Keys& keys, const SceneFile& file) {
  static const auto kinds = strings(probe_kinds);
  keys.text("kind");
  Probe probe;
  probe.kind = keys.choice_or("kind", "", kinds);
  const bool named = keys.has("name");
  if (probe.kind == "position" || probe.kind == "velocity") {
    probe.name = read_place(keys, file, probe);
  } else if (probe.kind == "orientation" || probe.kind == "angular_velocity") {
    probe.body = named_body(keys, file);
    probe.name = file.bodies[static_cast<std::size_t>(probe.body)].name;
  } else if (probe.kind == "joint_force") {
    probe.joint = named_joint(keys, file);
    probe.name = file.joints[probe.joint].name;
  }
  if (named) probe.name = read_name(keys);
  keys.refuse_unknown();
  return probe;
}

}  // namespace

void read_probes(Keys& root, SceneFile& found) {
  std::set<std::pair<std::string, std::string>> seen;
  for (auto& keys : root.tables("probe")) {
    found.probes.push_back(read_probe(keys, found));
    if (!seen.emplace(found.probes.back().kind, found.probes.back().name).second)
      throw pbd::SetupError(keys.where(), "a probe with the same columns as another", "another `name`");
  }
}

}  // namespace pbdcheck
