// Tables of contact: [contact] with its pairs of materials and of bodies that stay apart, and the sub-tables
// `contact` of nodes.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scenes/builder.h"
#include "scenes/choices.h"
#include "validate.h"

namespace pbdcheck {
namespace {

/// What the keys state; the rest is as in `law`.
pbd::ContactLaw read_law(Keys& keys, pbd::ContactLaw law) {
  law.friction = keys.number_or("friction", law.friction, Range::not_negative);
  if (law.friction > pbd::most_friction)
    keys.refuse("friction", fmt::format("a number from 0 to {:g}", pbd::most_friction));
  law.restitution = keys.number_or("restitution", law.restitution, Range::finite);
  if (law.restitution < 0 || law.restitution > 1) keys.refuse("restitution", "a number from 0 to 1");
  const bool soft = keys.has("compliance_m_per_n"), stiff = keys.has("stiffness_n_per_m");
  if (soft || stiff) law.compliance = read_compliance(keys);
  law.damping = keys.number_or("damping_s", law.damping, Range::not_negative);
  return law;
}

void read_material_pairs(Keys& contact, ContactParts& parts, const pbd::ContactLaw& all) {
  const std::vector<std::string> known(parts.materials.begin() + 1, parts.materials.end());
  const auto count = static_cast<std::size_t>(parts.effect.materials);
  std::set<std::array<std::size_t, 2>> seen;
  for (auto& keys : contact.tables("pair")) {
    std::array<std::size_t, 2> pair{};
    const auto names = keys.texts("materials", 2);
    for (const std::size_t k : {0, 1}) {
      const auto found = std::find(known.begin(), known.end(), names[k]);
      if (found == known.end())
        keys.refuse("materials", "`" + names[k] + "`", allowed_names(names[k], known));
      pair[k] = 1 + static_cast<std::size_t>(found - known.begin());
    }
    std::sort(pair.begin(), pair.end());
    if (!seen.insert(pair).second)
      keys.refuse("materials", "`" + names[0] + "` and `" + names[1] + "` twice", "each pair once");
    const auto law = read_law(keys, all);
    parts.effect.law[pair[0] * count + pair[1]] = parts.effect.law[pair[1] * count + pair[0]] = law;
    keys.refuse_unknown();
  }
}

void read_apart(Keys& contact, Builder& builder) {
  const auto& touching = builder.contact.bodies;
  for (auto& keys : contact.tables("apart")) {
    std::array<int, 2> pair{};
    const auto names = keys.texts("bodies", 2);
    for (const std::size_t k : {0, 1}) {
      pair[k] = builder.body(keys, "bodies", names[k]);
      const auto takes_part = [&](const ContactParts::Body& one) { return one.body == pair[k]; };
      if (std::none_of(touching.begin(), touching.end(), takes_part))
        keys.refuse("bodies", "`" + names[k] + "`, which touches nothing",
                    "bodies that take part in contact");
    }
    if (pair[0] == pair[1]) keys.refuse("bodies", "`" + names[0] + "` twice", "two different bodies");
    builder.contact.effect.apart.push_back(pair);
    keys.refuse_unknown();
  }
}

void add_surface(pbd::Contact& effect, int material, int first,
                 const std::vector<std::array<int, 3>>& surface) {
  for (const auto& [i, j, k] : surface) effect.triangle.push_back({first + i, first + j, first + k});
  effect.triangle_material.resize(effect.triangle.size(), material);
}

/// Numbers of the nodes of a surface, or of all in the range, in the scene.
std::vector<int> outer_nodes(const NodeRange& range, const std::vector<std::array<int, 3>>& surface) {
  std::set<int> found;
  for (const auto& triangle : surface)
    for (const int node : triangle) found.insert(range.first + node);
  for (int node = range.first; surface.empty() && node < range.first + range.count; ++node)
    found.insert(node);
  return {found.begin(), found.end()};
}

}  // namespace

int Builder::material(Keys& keys) {
  if (!keys.has("material")) return 0;
  contact.mentioned = keys.where();
  const auto name = read_name(keys, "material");
  auto& names = contact.materials;
  const auto index = std::find(names.begin(), names.end(), name) - names.begin();
  if (index == std::ssize(names)) names.push_back(name);
  return static_cast<int>(index);
}

void read_node_contact(Keys& owner, Builder& builder, const NodeRange& range,
                       const std::vector<std::array<int, 3>>& surface) {
  auto table = owner.table("contact");
  if (!table) return;
  Keys& keys = *table;
  pbd::Contact& effect = builder.contact.effect;
  const int material = builder.material(keys);
  builder.contact.mentioned = keys.where();
  if (!surface.empty() && keys.flag_or("surface", false)) {  // its nodes take part by their triangles
    add_surface(effect, material, range.first, surface);
    return keys.refuse_unknown();
  }
  const double radius = keys.number_or("radius_m", 0, Range::not_negative);
  const auto nodes =
      chooses_nodes(keys) ? select_nodes(keys, builder.scene, range) : outer_nodes(range, surface);
  for (const int node : nodes) {
    effect.node.push_back(node);
    effect.radius.push_back(radius);
    effect.node_material.push_back(material);
  }
  keys.refuse_unknown();
}

void read_contact(Keys& root, Builder& builder) {
  auto table = root.table("contact");
  ContactParts& parts = builder.contact;
  if (!table) {
    if (!parts.mentioned.empty())
      throw pbd::SetupError(parts.mentioned, "contact in a scene without a table [contact]",
                            "a table [contact], or neither `contact` nor `material`");
    return;
  }
  Keys& keys = *table;
  pbd::Contact& effect = parts.effect;
  if (parts.bodies.empty() && effect.node.empty() && effect.triangle.empty())
    throw pbd::SetupError(keys.where(), "contact in a scene where nothing touches",
                          "a rigid body with a shape, or nodes with a sub-table `contact`");
  effect.margin = keys.number_or("margin_m", effect.margin, Range::not_negative);
  if (keys.has("recovery_m_s")) effect.recovery = keys.number("recovery_m_s", Range::not_negative);
  effect.thickness = keys.number_or("thickness_m", effect.thickness, Range::not_negative);
  if (effect.thickness == 0 && !effect.triangle.empty() && !parts.bodies.empty())
    keys.refuse("thickness_m", "a number > 0 where surfaces and bodies take part: a point has no side");
  effect.surfaces_touch = keys.flag_or("surfaces_touch", effect.surfaces_touch);
  effect.nodes_touch = keys.flag_or("nodes_touch", effect.nodes_touch);
  effect.continuous = keys.flag_or("continuous", effect.continuous);
  const auto law = read_law(keys, {});
  effect.materials = static_cast<int>(parts.materials.size());
  effect.law.assign(parts.materials.size() * parts.materials.size(), law);
  read_material_pairs(keys, parts, law);
  read_apart(keys, builder);
  keys.refuse_unknown();
  for (const auto& [body, material, surface_velocity] : parts.bodies) {
    const auto& [name, shape, to_body] = builder.bodies[static_cast<std::size_t>(body)];
    effect.collider.push_back(
        {shape, body, {to_body.translation(), to_body.linear()}, material, surface_velocity});
  }
  builder.add(keys.line(), std::move(effect));
}

}  // namespace pbdcheck
