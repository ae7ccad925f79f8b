// Tables of what a simulation writes down.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "names.h"
#include "scenes/builder.h"
#include "scenes/choices.h"
#include "scenes/contacts.h"
#include "scenes/read_probes.h"
#include "step/integrators.h"

namespace pbdcheck {
namespace {

int named_body(Keys& keys, const SceneFile& file, std::string_view key = "body") {
  std::vector<std::string> names;
  for (const auto& body : file.bodies) names.push_back(body.name);
  if (names.empty())
    keys.refuse(key, "`" + keys.text(key) + "`", "a [[rigid_body]], of which the scene has none");
  return static_cast<int>(std::find(names.begin(), names.end(), keys.choice(key, names)) - names.begin());
}

int touching_body(Keys& keys, const SceneFile& file, std::string_view key) {
  const int body = named_body(keys, file, key);
  for (const auto& collider : contact_of(file.scene)->collider)
    if (collider.body == body) return body;
  keys.refuse(key, "`" + keys.text(key) + "`, which touches nothing", "a body that takes part in contact");
}

/// The bodies of `body` and `other`, if the latter is there; returns the name of them.
std::string read_touching(Keys& keys, const SceneFile& file, Probe& probe) {
  probe.body = touching_body(keys, file, "body");
  auto name = file.bodies[static_cast<std::size_t>(probe.body)].name;
  if (!keys.has("other")) return name;
  probe.other = touching_body(keys, file, "other");
  if (probe.other == probe.body) keys.refuse("other", "`" + name + "` twice", "another body");
  return name + "_" + file.bodies[static_cast<std::size_t>(probe.other)].name;
}

/// The joint that `joint` names.
std::size_t named_joint(Keys& keys, const SceneFile& file) {
  std::vector<std::string> names;
  for (const auto& joint : file.joints)
    if (!joint.name.empty()) names.push_back(joint.name);
  if (names.empty())
    keys.refuse("joint", "`" + keys.text("joint") + "`",
                "a [[joint]] with a name, of which the scene has none");
  const auto name = keys.choice("joint", names);
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
  Probe probe;
  probe.kind = keys.choice("kind", kinds);
  const bool named = keys.has("name");
  if (probe.kind.starts_with("contact") && contact_of(file.scene) == nullptr)
    keys.refuse("kind", "`" + probe.kind + "`", "another kind: the scene has no table [contact]");
  if (probe.kind == "position" || probe.kind == "velocity") {
    probe.name = read_place(keys, file, probe);
  } else if (probe.kind == "orientation" || probe.kind == "angular_velocity") {
    probe.body = named_body(keys, file);
    probe.name = file.bodies[static_cast<std::size_t>(probe.body)].name;
  } else if (probe.kind == "joint_force") {
    probe.joint = named_joint(keys, file);
    probe.name = file.joints[probe.joint].name;
  } else if (probe.kind == "contact_force") {
    probe.name = read_touching(keys, file, probe);
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
