// The two features of a contact of surfaces, by brute force.
#pragma once

#include "collision/surface_contact.h"
#include "contact_shapes.h"

namespace pbd::test {

/// That the contact's points lie within its features.
inline bool within(const SurfaceTouching& t, SurfaceContact::Kind kind) {
  const auto& w = t.weight;
  return kind != SurfaceContact::Kind::node_triangle ? w[0] >= 0 && w[1] >= 0 && w[2] <= 0 && w[3] <= 0
                                                     : w[1] <= 0 && w[2] <= 0 && w[3] <= 0;
}

/// m, of the two features themselves.
inline double distance(const Points& x, SurfaceContact::Kind kind) {
  const auto at = [&](int k) -> Vec3 { return x.col(k); };
  if (kind == SurfaceContact::Kind::node_edge) return between_segments({at(0), at(0)}, {at(2), at(3)});
  return kind == SurfaceContact::Kind::edge_edge ? between_segments({at(0), at(1)}, {at(2), at(3)})
                                                 : to_triangle(at(0), at(1), at(2), at(3));
}

}  // namespace pbd::test
