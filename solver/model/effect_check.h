// What checks of effects have in common. Each throws SetupError unless what it is named after holds.
#pragma once

#include <string>
#include <string_view>

#include "scene.h"

namespace pbd {

/// `name` is the effect's position and kind in the scene, as in "effects[2] distance".
struct EffectCheck {
  const Scene& scene;
  std::string name;

  /// Where entry i of a field stands.
  std::string at(std::size_t i, std::string_view field) const;

  void entries(std::size_t expected, std::size_t count, std::string_view field) const;
  template <class Entries>
  void same_size(std::size_t expected, const Entries& listed, std::string_view field) const {
    entries(expected, listed.size(), field);
  }
  template <class E>
  void only_one() const {
    int count = 0;
    for (const Effect& effect : scene.effects) count += std::holds_alternative<E>(effect);
    one_in_a_scene(count);
  }

  void node_indices(const std::vector<int>& node) const;
  /// Of each constraint, different ones.
  template <std::size_t K>
  void node_indices(const std::vector<std::array<int, K>>& node) const {
    for (std::size_t i = 0; i < node.size(); ++i)
      for (std::size_t a = 0; a < K; ++a) {
        node_index(node[i][a], i);
        for (std::size_t b = 0; b < a; ++b) different_nodes(node[i][a], node[i][b], i);
      }
  }
  void body_index(int body, std::size_t i) const;

  void not_negative(const std::vector<double>& values, std::string_view field) const;
  void finite(const std::vector<double>& values, std::string_view field) const;
  void finite(const std::vector<Vec3>& values, std::string_view field) const;
  void unit(const Vec3& vector, std::size_t i, std::string_view field) const;
  void unit(const std::array<Vec3, 2>& pair, std::size_t i, std::string_view field) const;

  void material(const Material& stated, bool may_be_rigid) const;
  void retardation_times(std::size_t constraints, const std::vector<double>& damping) const;
  void viscosity(const std::optional<Material>& damping, const Material& elastic) const;

  /// Nodes, compliance, damping and the finite value at rest of each constraint.
  template <class OfNodes, class Values>
  void of_nodes(const OfNodes& effect, const Values& rest, std::string_view field) const {
    const std::size_t count = effect.node.size();
    same_size(count, rest, field);
    same_size(count, effect.compliance, "compliance");
    node_indices(effect.node);
    finite(rest, field);
    not_negative(effect.compliance, "compliance");
    retardation_times(count, effect.damping);
  }

 private:
  void one_in_a_scene(int count) const;
  void node_index(int node, std::size_t i) const;
  void different_nodes(int node, int other, std::size_t i) const;
};

}  // namespace pbd
