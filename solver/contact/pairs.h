// The generators for pairs of kinds of shapes; `generate` chooses among them.
#pragma once

#include "contact/writer.h"

namespace pbd {

/// Directions that differ by less than asin(0.1) make no crossing: where edges cross depends on it too much.
inline constexpr double crossing_sine = 0.1;
/// Lengths up to this part of the sizes are rounding.
inline constexpr double rounding = 1e-9;

/// Spheres, capsules, boxes, hulls.
void core_core(const Core& a, const Core& b, const Roles& roles);

/// The same and a half space.
void core_plane(const Core& a, const Roles& roles);

void cylinder_plane(const Cylinder& a, const Roles& roles);
void cylinder_cylinder(const Cylinder& a, const Cylinder& b, const Roles& roles);
void cylinder_core(const Core& a, const Cylinder& b, const Roles& roles);

/// In the mesh's frame, so is a.
void core_mesh(const Core& a, const ClosedMesh& b, const Roles& roles);
void cylinder_mesh(const Cylinder& a, const ClosedMesh& b, const Roles& roles);
/// a as it is placed in b's frame, and b in a's.
void mesh_mesh(const Core& a, const ClosedMesh& mesh_a, const Core& b, const ClosedMesh& mesh_b,
               const Roles& in_b, const Roles& in_a);

/// Where the part of a that faces b's face f is above that face, gaps at least `floor` (m).
void face_manifold(const Core& a, const Core& b, int f, double floor, const Roles& roles);

}  // namespace pbd
