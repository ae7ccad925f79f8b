// Whether an edge is nearest to another shape, or its faces are.
#pragma once

#include <algorithm>

#include "polyhedron.h"

namespace pbd {

/// That the distance does not fall from an edge into its faces, `apart` from the edge to the other shape,
/// when that has turned by `turn` (rad); by no more than half the angle of the faces' normals, beyond which a
/// face is nearer than the edge: `MeshPair::look_away` rests on that.
template <class Normal>
bool minimum(const Polyhedron::Edge& edge, const Vec3& along, const Vec3& apart, double turn,
             Normal&& normal) {
  double slope = 0;
  if (turn > 0 && edge.face[0] >= 0 && edge.face[1] >= 0)
    slope = std::min(turn, (normal(edge.face[0]) - normal(edge.face[1])).norm() / 2) * apart.norm();
  for (const std::size_t side : {0U, 1U}) {
    if (edge.face[side] < 0) continue;
    if ((side == 0 ? 1 : -1) * normal(edge.face[side]).cross(along).dot(apart) > slope) return false;
  }
  return true;
}

}  // namespace pbd
