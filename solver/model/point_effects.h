// Effects on nodes: given forces, links, hinges and elastic elements (scene.h says what all constraints
// share).
#pragma once

#include <optional>
#include <string_view>

#include "geometry.h"

namespace pbd {

/// Linear elastic constants: Young's modulus (Pa) and Poisson's ratio (-1 < poisson < 1/2).
struct Material {
  double young = 1e6;
  double poisson = 0.3;
};

/// Uniform acceleration of every node with finite mass, m/s^2.
struct Gravity {
  static constexpr std::string_view name = "gravity";
  Vec3 acceleration{0, 0, -9.81};
};

/// Constant forces on nodes, N.
struct ExternalForce {
  static constexpr std::string_view name = "external_force";
  std::vector<int> node;
  std::vector<Vec3> force;
};

/// c = x - target (3 rows, m); compliance in m/N, 0 holds the node exactly. Damping: T of each constraint in
/// s.
struct Anchor {
  static constexpr std::string_view name = "anchor";
  std::vector<int> node;
  std::vector<Vec3> target;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = |x1 - x0| - rest_length (1 row, m); compliance in m/N, the inverse of a spring's stiffness. Damping: T
/// of each constraint in s.
struct Distance {
  static constexpr std::string_view name = "distance";
  std::vector<std::array<int, 2>> node;
  std::vector<double> rest_length;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = theta - rest_angle (1 row, rad): theta is the signed dihedral angle at the edge (x0, x1) of the
/// triangles (x0, x1, x2) and (x1, x0, x3), zero where they are coplanar with x2 and x3 on opposite sides of
/// the edge, positive where their normals n_a = (x1-x0) x (x2-x0) and n_b = (x0-x1) x (x3-x1) turn apart
/// about the edge: theta = atan2((n_a x n_b) . e, n_a . n_b) with e the unit vector from x0 to x1. The
/// difference is taken modulo 2 pi in (-pi, pi]. Compliance in rad/(N m). Damping: T of each constraint in s.
struct Bending {
  static constexpr std::string_view name = "bending";
  std::vector<std::array<int, 4>> node;
  std::vector<double> rest_angle;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = Green strain (uu, vv, 2 uv) of a flat triangle (3 rows, dimensionless), u along the rest edge x0 x1.
/// Plane stress: C = thickness Y/(1-nu^2) [1 nu 0; nu 1 0; 0 0 (1-nu)/2], A = C^-1 / rest area.
/// `material.young` may be infinite: the triangle then keeps its shape exactly (A = 0). Damping: the moduli
/// of the stress C_d dc/dt, young in Pa s; T = C^-1 C_d.
struct TriangleStrain {
  static constexpr std::string_view name = "triangle_strain";
  std::vector<std::array<int, 3>> node;
  std::vector<Eigen::Matrix3d> rest;  // rest positions, one column a node, m
  Material material;
  double thickness = 1e-3;  // m
  std::optional<Material> damping{};
};

enum class Strain { green, corotational, linear };
inline constexpr std::array<std::string_view, 3> strain_names{"green", "corotational", "linear"};

/// c = strain (xx, yy, zz, 2 xy, 2 yz, 2 zx) of a linear tetrahedron (6 rows, dimensionless), with F its
/// deformation gradient: green (F^T F - I)/2; linear (F + F^T)/2 - I; corotational S - I where F = R S and R
/// is the nearest proper rotation. A = C^-1 / rest volume, C the isotropic elasticity matrix with engineering
/// shear. Damping: the moduli of the stress C_d dc/dt, young in Pa s; T = C^-1 C_d.
struct TetStrain {
  static constexpr std::string_view name = "tet_strain";
  std::vector<std::array<int, 4>> node;
  std::vector<Eigen::Matrix<double, 3, 4>> rest;  // rest positions, one column a node, m
  Material material;
  Strain strain = Strain::corotational;
  std::optional<Material> damping{};
};

}  // namespace pbd
