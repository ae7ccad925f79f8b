// Mass, centre of mass and inertia of homogeneous shapes.
//
//   inertia = integral of density (|x|^2 1 - x x^T) about the centre of mass
#pragma once

#include "polyhedron.h"

namespace pbd {

struct MassProperties {
  double mass = 0;                                    // kg
  Vec3 centre = Vec3::Zero();                         // m, in the shape's frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, about the centre, along the shape's axes
};

/// Solid shapes about the origin of `density` kg/m^3; lengths in m. Cylinder and capsule lie along z; a
/// capsule's length is that of its cylindrical part.
MassProperties sphere_properties(double radius, double density);
MassProperties box_properties(const Vec3& size, double density);
MassProperties cylinder_properties(double radius, double length, double density);
MassProperties capsule_properties(double radius, double length, double density);

/// What a closed surface holds, by Gauss's theorem: the sum over its triangles of the tetrahedra they make
/// with the origin. Throws SetupError naming an edge that is not shared by two triangles passing it in
/// opposite directions, and for a volume that is not positive: its normals point inwards.
MassProperties surface_properties(const TriangleMesh& surface, double density);

/// The same shape with another mass.
MassProperties with_mass(MassProperties properties, double mass);

/// Principal moments (kg m^2) and the rotation that takes their axes to the shape's frame: the identity
/// where the inertia is diagonal to 1e-12 of its trace.
struct PrincipalInertia {
  Vec3 moments;
  Eigen::Quaterniond axes;
};
PrincipalInertia principal_inertia(const Eigen::Matrix3d& inertia);

}  // namespace pbd
