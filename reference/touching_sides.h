// The two sides of a contact as a claim counts them: what carries them, and how they move.
#pragma once

#include "step_claim.h"
#include "step_equations.h"
#include "support.h"

namespace pbd::reference {

/// A collider or node of a scene's contact.
struct Side {
  int body = -1, node = -1;  // a body and its node, or a node; neither: of a surface
  bool of_surface() const { return node < 0; }
};

/// Whether the scene lets bodies or nodes touch: `AllowedPairs` of a judge. Nodes of one element do not.
bool may_touch(const Scene& scene, const Contact& contact, const Side& a, const Side& b);

/// The contact's triangles that a body or a node may touch, by their numbers: those without a node that is
/// attached to the body; of a node, which is of no triangle, those without a node of its elements.
std::vector<std::size_t> free_triangles(const Scene& scene, const Contact& contact, const Side& side);

/// What a finding calls a pair.
inline std::string name_of(int a, int b) {
  return "contact of " + std::to_string(a) + " and " + std::to_string(b);
}

class Sides {
 public:
  Sides(const StepClaim& claim, const Contact& contact);

  /// Colliders, then the effect's nodes.
  int count() const { return static_cast<int>(shapes_.size()); }
  Side side(int k) const;
  PlacedShape placed(int k, const State& state) const;
  /// A side of a contact that met, in a world whose origin is where it touched.
  PlacedShape placed_as_met(const ClaimedContact& contact, std::size_t side) const;
  bool is_node(int k) const { return k >= static_cast<int>(contact_.collider.size()); }

  /// m/s, of what touches of side 0 or 1 of a contact where the step ends, or where it met on the way, by the
  /// velocities of `state`.
  Vec3 velocity(const ClaimedContact& contact, std::size_t side, const State& state) const;
  /// m/s, of a side's surface along itself where the step ends, or where it met on the way, beside that of
  /// its points: the part of it across a normal counts.
  Vec3 surface_velocity(const ClaimedContact& contact, std::size_t side) const;
  /// Largest change of a point's velocity by an impulse of 1 N s there, 1/kg; of the centre alone with lever
  /// 0.
  double inverse_mass(int k, double lever) const;
  /// Least change of the normal velocity by an impulse of 1 N s, times 3 of a surface, whose three weights
  /// may be equal.
  double least_inverse_mass(int k) const;
  double lever(const ClaimedContact& contact, std::size_t side) const;
  /// The longest lever of k (m) at which a contact of both acts where the step begins: at one of their points
  /// nearest to each other or between them; against a half space at the other's point.
  double longest_lever(int k, int other) const;
  const ContactLaw& law(int a, int b) const;
  /// Of a surface's node.
  int of_node(int node) const { return count() + node; }

 private:
  PlacedShape placed(int k, Frame carrier) const;

  const StepClaim& claim_;
  const Contact& contact_;
  std::vector<Shape> shapes_;
  std::vector<int> surface_material_;                                        // of each node of the scene
  double surface_inverse_mass_ = 0, least_surface_inverse_mass_ = infinity;  // 1/kg, of its nodes
};

}  // namespace pbd::reference
