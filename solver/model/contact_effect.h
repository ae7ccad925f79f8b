// Contact of rigid bodies' shapes, nodes and deformable surfaces, with friction and restitution.
#pragma once

#include <string_view>

#include "geometry.h"
#include "shapes.h"

namespace pbd {

/// What two materials do where they touch: Coulomb's coefficient of friction; the share of the approaching
/// speed that comes back where they collide; compliance (m/N) and retardation time (s) of the gap.
struct ContactLaw {
  double friction = 0.5;
  double restitution = 0;
  double compliance = 0;
  double damping = 0;

  bool operator==(const ContactLaw&) const = default;
};

/// A shape that may touch others, in a frame of its rigid body. Its surface may move along itself, as a
/// conveyor's does: by the part across a contact's normal of a velocity in the shape's frame (m/s).
struct Collider {
  Shape shape;
  int body = 0;
  Frame frame{};
  int material = 0;
  Vec3 surface_velocity = Vec3::Zero();
};

/// Contact of colliders with each other, of nodes, spheres of `radius` (m, 0 for a point), with colliders,
/// and of deformable surfaces, the triangles, with each other and themselves at a distance of `thickness`,
/// with `surfaces_touch`, and with colliders and nodes of no triangle at half of it, which is not 0 then. Two
/// colliders of one body, of bodies that a joint connects, or of bodies named in `apart` do not touch, nor
/// does a node, or a triangle of it, the body that it is attached to; nodes touch each other with
/// `nodes_touch` alone. No nodes of one link, hinge, triangle or tetrahedron touch, nor a node a triangle
/// with such a node. `law` has an entry for each pair of materials, row by row of a symmetric table.
/// Triangles with a common node are of one material, which is that of the node and of their edges, too. Gaps
/// g >= 0 at the end of each step; where one begins with overlap, the shapes part by at most `recovery`
/// (m/s), surfaces in surfaces by a tenth of their thickness a step at most. Pairs take part that are nearer
/// than their motions go, and `margin` (m). `continuous`: in a solved step colliders do not pass through
/// colliders, nodes and triangles either, on straight ways and constant turns: through what they begin apart
/// from not at all, through what they begin in touch with no deeper than a tenth of its half width and out
/// again.
struct Contact {
  static constexpr std::string_view name = "contact";
  std::vector<Collider> collider;
  std::vector<int> node{};
  std::vector<double> radius{};
  std::vector<int> node_material{};
  std::vector<std::array<int, 3>> triangle{};  // of nodes
  std::vector<int> triangle_material{};        // of each; empty: all of 0
  double thickness = 1e-3;                     // m
  int materials = 1;
  std::vector<ContactLaw> law{ContactLaw{}};
  std::vector<std::array<int, 2>> apart{};
  double margin = 0;
  double recovery = infinity;
  bool continuous = false;
  bool surfaces_touch = true;
  bool nodes_touch = false;

  /// Of the material of collider, node or triangle k, each behind the ones before.
  int material(std::size_t k) const {
    if (k < collider.size()) return collider[k].material;
    if (k -= collider.size(); k < node.size()) return node_material[k];
    return triangle_material.empty() ? 0 : triangle_material[k - node.size()];
  }
  /// Of two materials.
  const ContactLaw& of_materials(int first, int second) const {
    return law[static_cast<std::size_t>(first) * materials + second];
  }
  /// Of two colliders, nodes or triangles.
  const ContactLaw& between(std::size_t first, std::size_t second) const {
    return of_materials(material(first), material(second));
  }
};

}  // namespace pbd
