// Tables of particles, chains and what acts on single nodes: gravity, forces, anchors, links, hinges.
#include <fmt/format.h>

#include "error.h"
#include "mesh.h"
#include "scenes/builder.h"

namespace pbdcheck {
namespace {

/// Refuses node indices beyond the scene and a node twice in one constraint.
void check_nodes(const Keys& keys, const std::vector<int>& nodes, const pbd::Scene& scene) {
  const int count = numbered_nodes(scene).count;
  if (count == 0)
    keys.refuse("nodes", "a choice in a scene without nodes", "a scene with one; rigid bodies have names");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] >= count)
      keys.refuse("nodes", std::to_string(nodes[i]), fmt::format("a node index from 0 to {}", count - 1));
    for (std::size_t j = 0; j < i; ++j)
      if (nodes[i] == nodes[j])
        keys.refuse("nodes", fmt::format("node {} twice", nodes[i]), "different nodes");
  }
}

int body_node(Keys& keys, Builder& builder) {
  return builder.scene.bodies[static_cast<std::size_t>(builder.body(keys, "body"))].node;
}

void read_particle_arrays(Keys& keys, Builder& builder) {
  const auto x = keys.vectors("position_m");
  const auto mass = keys.numbers_or_one("mass_kg", x.size(), Range::positive_or_infinite);
  const bool moving = keys.has("velocity_m_s");
  const auto v =
      moving ? keys.vectors("velocity_m_s") : std::vector<pbd::Vec3>(x.size(), pbd::Vec3::Zero().eval());
  if (v.size() != x.size())
    keys.refuse("velocity_m_s", fmt::format("{} velocities", v.size()), fmt::format("{}", x.size()));
  const NodeRange range{builder.scene.nodes(), static_cast<int>(x.size())};
  for (std::size_t i = 0; i < x.size(); ++i) pbd::add_node(builder.scene, x[i], mass[i], v[i]);
  read_node_contact(keys, builder, range);
  keys.refuse_unknown();
}

struct Chain {
  int links;
  double length;
  double mass;
  double tip_mass;
  pbd::Vec3 start;
  pbd::Vec3 direction;
  pbd::Vec3 velocity;
  double compliance;
  double damping;
  std::string hold;
};

Chain read_chain(Keys& keys, Builder& builder) {
  Chain chain;
  chain.links = keys.integer_or("links", 20, 1);
  if (keys.has("links")) builder.reserve(keys, "links", chain.links);
  chain.length = keys.number("length_m", Range::positive);
  chain.mass = keys.number("mass_kg", Range::positive);
  chain.tip_mass = keys.number_or("tip_mass_kg", chain.mass, Range::positive);
  chain.start = keys.vector_or("start_m", pbd::Vec3::Zero());
  chain.direction = keys.vector_or("direction", pbd::Vec3::UnitX());
  if (chain.direction.isZero(0)) keys.refuse("direction", "the zero vector", "a direction of any length");
  chain.velocity = keys.vector_or("velocity_m_s", pbd::Vec3::Zero());
  chain.compliance = read_compliance(keys);
  chain.damping = read_damping(keys);
  chain.hold = keys.choice_or("start", "anchored", {"anchored", "fixed", "free"});
  return chain;
}

void add_chain(const Keys& keys, const Chain& chain, Builder& builder) {
  const bool fixed = chain.hold == "fixed";
  const bool held = chain.hold != "free";
  const double rest_length = chain.length / chain.links;
  const pbd::Vec3 step = chain.direction.stableNormalized() * rest_length;
  pbd::Distance distance;
  const int first = builder.scene.nodes();
  for (int i = 0; i <= chain.links; ++i) {
    const double mass = i == chain.links ? chain.tip_mass : chain.mass;
    pbd::add_node(builder.scene, chain.start + i * step, i == 0 && fixed ? pbd::infinity : mass,
                  i == 0 && held ? pbd::Vec3::Zero().eval() : chain.velocity);
    if (i == 0) continue;
    distance.node.push_back({first + i - 1, first + i});
    distance.rest_length.push_back(rest_length);
    distance.compliance.push_back(chain.compliance);
  }
  set_damping(distance, 0, chain.damping);
  if (chain.hold == "anchored") {
    pbd::Anchor anchor;
    builder.anchor(keys, {first}, 0, anchor);
    builder.add(keys.line(), std::move(anchor));
  }
  builder.add(keys.line(), std::move(distance));
}

}  // namespace

void read_particles(Keys& root, Builder& builder) {
  for (auto& keys : root.tables("particle")) {
    const int node = pbd::add_node(builder.scene, keys.vector("position_m"),
                                   keys.number("mass_kg", Range::positive_or_infinite),
                                   keys.vector_or("velocity_m_s", pbd::Vec3::Zero()));
    read_node_contact(keys, builder, {node, 1});
    keys.refuse_unknown();
  }
  for (auto& keys : root.tables("particles")) read_particle_arrays(keys, builder);
}

void read_chains(Keys& root, Builder& builder) {
  for (auto& keys : root.tables("chain")) {
    const Chain chain = read_chain(keys, builder);
    const NodeRange range{builder.scene.nodes(), chain.links + 1};
    add_chain(keys, chain, builder);
    read_node_contact(keys, builder, range);
    keys.refuse_unknown();
  }
}

void read_gravity(Keys& root, Builder& builder) {
  auto keys = root.table("gravity");
  if (!keys) return;
  builder.add(keys->line(), pbd::Gravity{keys->vector_or("acceleration_m_s2", pbd::Gravity{}.acceleration)});
  keys->refuse_unknown();
}

void read_forces(Keys& root, Builder& builder) {
  auto tables = root.tables("force");
  if (tables.empty()) return;
  pbd::ExternalForce effect;
  for (auto& keys : tables) {
    const pbd::Vec3 force = keys.vector("force_n");
    const auto nodes = keys.has("body") ? std::vector<int>{body_node(keys, builder)}
                                        : select_nodes(keys, builder.scene, numbered_nodes(builder.scene));
    const auto course = read_course(keys);
    for (const int node : nodes) {
      if (course) builder.script.force(effect.node.size(), *course);
      effect.node.push_back(node);
      effect.force.push_back(force);
    }
    keys.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(effect));
}

void read_anchors(Keys& root, Builder& builder) {
  auto tables = root.tables("anchor");
  if (tables.empty()) return;
  pbd::Anchor effect;
  for (auto& keys : tables) {
    const double compliance = read_compliance(keys), damping = read_damping(keys);
    const bool moved = keys.has("target_m");
    const auto nodes = select_nodes(keys, builder.scene, numbered_nodes(builder.scene));
    builder.anchor(keys, nodes, compliance, effect);
    set_damping(effect, effect.node.size() - nodes.size(), damping);
    if (moved) {
      if (nodes.size() != 1) keys.refuse("target_m", "one target for several nodes", "one node");
      effect.target.back() = keys.vector("target_m");
    }
    keys.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(effect));
}

void read_distances(Keys& root, Builder& builder) {
  auto tables = root.tables("distance");
  if (tables.empty()) return;
  const auto& x = builder.scene.initial.x;
  pbd::Distance effect;
  for (auto& keys : tables) {
    const auto links = keys.integer_lists("nodes", 2, 0);
    const double compliance = read_compliance(keys), damping = read_damping(keys);
    std::vector<double> rest_length;
    if (keys.has("rest_length_m"))
      rest_length = keys.numbers_or_one("rest_length_m", links.size(), Range::not_negative);
    for (std::size_t i = 0; i < links.size(); ++i) {
      check_nodes(keys, links[i], builder.scene);
      effect.node.push_back({links[i][0], links[i][1]});
      effect.rest_length.push_back(rest_length.empty() ? (x.col(links[i][1]) - x.col(links[i][0])).norm()
                                                       : rest_length[i]);
      effect.compliance.push_back(compliance);
      if (effect.rest_length.back() == 0 && compliance == 0)
        throw pbd::SetupError(keys.where(), fmt::format("link {} hard and of rest length 0", i),
                              "a rest length or a compliance > 0");
    }
    set_damping(effect, effect.node.size() - links.size(), damping);
    keys.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(effect));
}

void read_bendings(Keys& root, Builder& builder) {
  auto tables = root.tables("bending");
  if (tables.empty()) return;
  const auto& x = builder.scene.initial.x;
  pbd::Bending effect;
  for (auto& keys : tables) {
    const double compliance = keys.number_or("compliance_rad_per_n_m", 0, Range::not_negative);
    const std::size_t first = effect.node.size();
    for (const auto& hinge : keys.integer_lists("nodes", 4, 0)) {
      check_nodes(keys, hinge, builder.scene);
      Eigen::Matrix<double, 3, 4> at;
      for (int i = 0; i < 4; ++i) at.col(i) = x.col(hinge[static_cast<std::size_t>(i)]);
      effect.node.push_back({hinge[0], hinge[1], hinge[2], hinge[3]});
      effect.rest_angle.push_back(keys.number_or("rest_angle_rad", pbd::dihedral_angle(at), Range::finite));
      effect.compliance.push_back(compliance);
    }
    set_damping(effect, first, read_damping(keys));
    keys.refuse_unknown();
  }
  builder.add(tables[0].line(), std::move(effect));
}

}  // namespace pbdcheck
