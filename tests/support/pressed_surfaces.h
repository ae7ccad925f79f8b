// What lies on a deformable surface of another material, and how a step leaves it.
#pragma once

#include "scene.h"
#include "scenes/standard.h"

namespace pbd::test {

enum class Pressing { node, edge, sphere };

/// A node of a triangle on a fixed triangle, its edge across an edge of that, or a sphere about a node on it.
/// It slides at 0.1 m/s along y. Nodes are of 1 kg, and nothing links them.
struct PressedSurfaces {
  static constexpr double h = 0.01, speed = 0.1, thickness = 0.01, radius = 0.05;  // s, m/s, m

  Scene scene;
  ContactLaw law;          // of the two materials
  std::vector<int> nodes;  // that press

  PressedSurfaces(Pressing pressing, const ContactLaw& stated) : law(stated) {
    const ContactLaw other{.friction = 0.6};  // of each with itself
    Contact contact;
    contact.materials = 2;
    contact.law = {other, law, law, other};
    contact.thickness = thickness;
    contact.triangle_material = {1};
    const auto triangle = [&](const std::array<Vec3, 3>& places, double mass, double own_speed) {
      auto& added = contact.triangle.emplace_back();
      for (const std::size_t k : {0, 1, 2}) added[k] = add_node(scene, places[k], mass, {0, own_speed, 0});
      return added[0];
    };
    if (pressing == Pressing::edge) {
      triangle({Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)}, infinity, 0);
      const int first = triangle({Vec3(-1, 0, thickness), Vec3(1, 0, thickness), Vec3(0, 0, 1)}, 1, speed);
      nodes = {first, first + 1};
      contact.triangle_material.push_back(0);
    } else {
      triangle({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}, infinity, 0);
      if (pressing == Pressing::node) {
        nodes = {triangle({Vec3(0, 0, thickness), Vec3(0.1, 0, 1), Vec3(0, 0.1, 1)}, 1, speed)};
        contact.triangle_material.push_back(0);
      } else {
        nodes = {add_node(scene, Vec3(0, 0, radius + thickness / 2), 1, {0, speed, 0})};
        contact.node = nodes;
        contact.radius = {radius};
        contact.node_material = {0};
      }
    }
    scene.effects = {Gravity{}, contact};
  }

  /// Lets what presses begin a fifth of the thickness too deep.
  void sink() {
    for (const int node : nodes) scene.initial.x(2, node) -= thickness / 5;
  }

  /// m/s, of a surface that has sunk on a hard one: it parts by a tenth of the thickness in the step.
  Vec3 after_sinking() const {
    const double up = thickness / 10 / h;
    return {0, speed - law.friction * (up + pbdcheck::gravity * h), up};
  }

  /// m/s, where a step leaves what presses: it falls onto the law's spring by h v = -A p/h, and what carries
  /// it, p, drags it by mu p.
  Vec3 after() const {
    using pbdcheck::gravity;
    const double mass = static_cast<double>(nodes.size()), soft = law.compliance * mass / (h * h);
    const double down = gravity * h * soft / (1 + soft);
    return {0, speed - law.friction * (gravity * h - down), -down};
  }
};

}  // namespace pbd::test
