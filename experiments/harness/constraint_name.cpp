#include "harness/constraint_name.h"

#include <fmt/format.h>

namespace pbdcheck {

std::string constraint_name(const SceneFile& file, const pbd::ConstraintIndex& index,
                            const std::vector<pbd::ContactForce>& contacts) {
  const pbd::Effect& effect = file.scene.effects[index.effect];
  const auto kind = std::visit([](const auto& stated) { return std::string(stated.name); }, effect);
  for (const NamedJoint& joint : file.joints)
    for (const auto& part : joint.parts)
      if (part.effect == index.effect && part.constraint == index.constraint)
        return fmt::format("the {} of {}", kind, joint.name.empty() ? joint.where : "joint " + joint.name);
  const auto* contact = std::get_if<pbd::Contact>(&effect);
  if (contact == nullptr || index.constraint >= contacts.size())
    return fmt::format("{} {}", kind, index.constraint);
  const auto side = [&](int k) -> std::string {
    const auto colliders = static_cast<int>(contact->collider.size()),
               nodes = static_cast<int>(contact->node.size());
    if (k < colliders)
      return file.bodies[static_cast<std::size_t>(contact->collider[static_cast<std::size_t>(k)].body)].name;
    const int node = k - colliders < nodes ? contact->node[static_cast<std::size_t>(k - colliders)]
                                           : k - colliders - nodes;
    return fmt::format("node {}", node);
  };
  const auto& [first, second] = contacts[index.constraint].collider;
  return fmt::format("a contact of {} and {}", side(first), side(second));
}

}  // namespace pbdcheck
