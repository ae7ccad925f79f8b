// Solids of the ledger: loads and supports.
#pragma once

#include "ledger/motion.h"
#include "mesh.h"
#include "scenes/standard.h"

namespace pbdcheck::ledger {

/// A unit cube of `cells`^3 bricks of six tetrahedra, 1000 kg/m^3.
pbd::Scene unit_cube(int cells, const pbd::Material& material, pbd::Strain strain);

/// Sum of the forces (N) along x and y by which hard anchors at the affine map F x hold the nodes of
/// unit_cube(1, ...) that `chosen` picks by their rest place: on a face of it, the nominal stress (Pa).
pbd::Vec3 held_force(const pbd::Method& method, const pbd::Material& material, const Eigen::Matrix3d& f,
                     const std::function<bool(const pbd::Vec3&)>& chosen);

/// Step (s) of equilibria: 1e3 times the period of what is slow here.
inline constexpr double static_step = 1e3;

}  // namespace pbdcheck::ledger
