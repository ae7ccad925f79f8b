#include "studies/robustness/generated.h"

#include <fmt/format.h>

#include "harness/experiment.h"
#include "mesh.h"
#include "studies/robustness/random.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double present = 0.4;  // probability of each effect, of hard rows a third

double compliance(Random& random) {
  return random.happens(1.0 / 3) ? 0 : random.decades(-8, 0);
}

Material material(Random& random) {
  const double young = random.decades(1, 9);
  return {young, random.uniform(0, 0.49)};
}

template <std::size_t K>
Eigen::Matrix<double, 3, K> rest_shape(Random& random, const Scene& scene, const std::array<int, K>& node) {
  Eigen::Matrix<double, 3, K> rest;
  for (std::size_t a = 0; a < K; ++a)
    rest.col(static_cast<int>(a)) = scene.initial.x.col(node[a]) + random.vector(0.1);
  return rest;
}

void add_points(Random& random, Scene& scene) {
  const int count = 2 + random.below(19);
  const double speed = random.decades(-3, 1);
  for (int i = 0; i < count; ++i) {
    const Vec3 x = random.vector(0.5), v = random.vector(speed);
    const double mass = random.decades(-4, 4);
    const bool held = random.happens(0.15) && i > 0;  // one at least can move
    add_node(scene, x, held ? infinity : mass, held ? Vec3::Zero() : v);
  }
}

void add_forces(Random& random, Scene& scene) {
  if (random.happens(0.5)) scene.effects.emplace_back(Gravity{});
  if (!random.happens(present)) return;
  ExternalForce effect;
  for (int i = 1 + random.below(3); i > 0; --i) {
    effect.node.push_back(random.below(scene.nodes()));
    effect.force.push_back(random.vector(random.decades(-4, 4)));
  }
  scene.effects.emplace_back(std::move(effect));
}

void add_anchors(Random& random, Scene& scene) {
  Anchor effect;
  for (int node = 0; node < scene.nodes(); ++node)
    if (random.happens(0.2) && std::isfinite(scene.mass[static_cast<std::size_t>(node)])) {
      effect.node.push_back(node);
      effect.target.emplace_back(scene.initial.x.col(node) + random.vector(0.1));
      effect.compliance.push_back(compliance(random));
    }
  scene.effects.emplace_back(std::move(effect));
}

void add_links(Random& random, Scene& scene) {
  Distance effect;
  for (int i = 1 + random.below(2 * scene.nodes()); i > 0; --i) {
    const auto node = random.different<2>(scene.nodes());
    const double length = (scene.initial.x.col(node[0]) - scene.initial.x.col(node[1])).norm();
    effect.node.push_back(node);
    effect.rest_length.push_back(length * random.uniform(0.5, 1.5));
    effect.compliance.push_back(compliance(random));
  }
  scene.effects.emplace_back(std::move(effect));
}

void add_hinges(Random& random, Scene& scene) {
  Bending effect;
  for (int i = 1 + random.below(scene.nodes()); i > 0; --i) {
    effect.node.push_back(random.different<4>(scene.nodes()));
    effect.rest_angle.push_back(random.uniform(-1, 1));
    effect.compliance.push_back(random.happens(1.0 / 3) ? 0 : random.decades(-6, 2));
  }
  scene.effects.emplace_back(std::move(effect));
}

void add_triangles(Random& random, Scene& scene) {
  TriangleStrain effect;
  effect.material = material(random);
  if (random.happens(1.0 / 3)) effect.material.young = infinity;
  for (int i = 1 + random.below(scene.nodes()); i > 0; --i) {
    const auto node = random.different<3>(scene.nodes());
    effect.node.push_back(node);
    effect.rest.push_back(rest_shape(random, scene, node));
  }
  scene.effects.emplace_back(std::move(effect));
}

void add_tets(Random& random, Scene& scene, Strain strain) {
  TetStrain effect{.node = {}, .rest = {}, .material = material(random), .strain = strain};
  for (int i = 1 + random.below(scene.nodes()); i > 0; --i) {
    auto node = random.different<4>(scene.nodes());
    Eigen::Matrix<double, 3, 4> rest = rest_shape(random, scene, node);
    if (tet_volume(rest) < 0) {
      std::swap(node[0], node[1]);
      rest.col(0).swap(rest.col(1));
    }
    effect.node.push_back(node);
    effect.rest.push_back(rest);
  }
  scene.effects.emplace_back(std::move(effect));
}

}  // namespace

Case generated_case(std::int64_t index) {
  Random random(seed + static_cast<std::uint64_t>(index));
  Case each;
  each.name = fmt::format("generated {}", index);
  each.h = random.decades(-3, 0);
  add_points(random, each.scene);
  add_forces(random, each.scene);
  const int nodes = each.scene.nodes();
  if (random.happens(present)) add_anchors(random, each.scene);
  if (random.happens(present)) add_links(random, each.scene);
  if (nodes >= 4 && random.happens(present)) add_hinges(random, each.scene);
  if (nodes >= 3 && random.happens(present)) add_triangles(random, each.scene);
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    if (nodes >= 4 && random.happens(present / 2)) add_tets(random, each.scene, strain);
  return each;
}

}  // namespace pbdcheck
