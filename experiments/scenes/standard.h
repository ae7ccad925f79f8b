// Scenes shared by experiments and tests. SI units; gravity is -9.81 m/s^2 along z wherever there is any.
#pragma once

#include "mesh.h"
#include "scene.h"

namespace pbdcheck {

inline constexpr double gravity = 9.81;  // m/s^2

/// Bob of 1 kg on a massless hard link of 1 m, `angle` (rad) from straight down, turning at `rate` (rad/s).
pbd::Scene pendulum(double angle, double rate);

/// Straight chain of `links` hard links over 1 m along x from the origin, 0.1 kg a node, the last one 0.1 *
/// ratio kg; the first node is fixed unless `free`.
pbd::Scene chain(int links, double ratio = 1, bool free = false);

/// Sheet of 1 x 1 m in cells x cells squares, 0.2 kg/m^2, held along one edge and released in its horizontal
/// plane. Links along all edges of its triangles (1e-5 m/N); bending (100 rad/(N m)) unless `links_only`.
pbd::Scene cloth(int cells, bool links_only = false);

/// Any solid of density 1000 kg/m^3 under gravity, its nodes at the smallest x fixed.
pbd::Scene clamped_solid(const pbd::TetMesh& mesh, const pbd::Material& material, pbd::Strain strain);

/// Beam of 1 x 1/4 x 1/4 m in cells x cells/4 x cells/4 bricks of six tetrahedra, clamped at x = 0.
pbd::Scene cantilever(int cells, const pbd::Material& material, pbd::Strain strain);

/// Cube of 1 m in bricks of six corotational tetrahedra, about so many, of 1 MPa, clamped at x = 0.
pbd::Scene clamped_cube(int tets);

/// Nodal forces (N, 3 x N); nodes of none are left out.
pbd::ExternalForce nodal_force(const pbd::Points& loads);

/// Holds the nodes at the smallest x for ever.
void clamp_smallest_x(pbd::Scene& scene);

}  // namespace pbdcheck
