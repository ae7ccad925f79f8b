// Tables of nodes that bodies hold.
#include <fmt/format.h>

#include <set>

#include "scenes/builder.h"

namespace pbdcheck {

void read_attachments(Keys& root, Builder& builder) {
  auto tables = root.tables("attachment");
  if (tables.empty()) return;
  pbd::Attachment effect;
  std::set<std::array<int, 2>> known;
  for (auto& keys : tables) {
    const int body = builder.body(keys, "body");
    const double compliance = read_compliance(keys), damping = read_damping(keys);
    const auto& scene = builder.scene;
    const auto index = static_cast<std::size_t>(body);
    const std::size_t first = effect.node.size();
    for (const int node : select_nodes(keys, scene, numbered_nodes(scene))) {
      if (!known.insert({body, node}).second)
        throw pbd::SetupError(keys.where(), fmt::format("node {} attached twice to one body", node), "once");
      if (!builder.moves(body) && scene.mass[static_cast<std::size_t>(node)] == pbd::infinity)
        throw pbd::SetupError(keys.where(), fmt::format("node {} and a body that nothing moves", node),
                              "a node of finite mass or a body with held = \"free\"");
      effect.body.push_back(body);
      effect.node.push_back(node);
      effect.point.push_back(scene.initial.orientation[index].conjugate() *
                             (scene.initial.x.col(node) - scene.initial.x.col(scene.bodies[index].node)));
      effect.compliance.push_back(compliance);
    }
    set_damping(effect, first, damping);
    keys.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(effect));
}

}  // namespace pbdcheck
