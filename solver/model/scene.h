// A scene: masses, an initial state and the list of effects it calls for. Data only; nothing here computes.
//
// Effects are structs of arrays, one entry per constraint. A constraint has a vector value c(x) and a
// compliance A >= 0 (an R x R matrix for R rows): energy 1/2 c^T A^-1 c where A > 0, the equation c = 0 where
// A = 0. Its damping, if the effect lists any, is Kelvin-Voigt's: c + T dc/dt + A gamma = 0 with the force
// multiplier gamma and the retardation time T (s; an R x R matrix), so that a compliant constraint has the
// damping coefficient A^-1 T, and the error of a hard one decays with T. Rest shapes are stored as positions,
// so that solver and judges each derive their own rest quantities from them. Units are SI: m, kg, s, N, Pa,
// rad.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace pbd {

using Vec3 = Eigen::Vector3d;
using Points = Eigen::Matrix3Xd;  // one column a node

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Positions x (m) and velocities v (m/s) of all nodes, 3 x N each, at `time` (s).
struct State {
  double time = 0;
  Points x;
  Points v;
};

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

using Effect = std::variant<Gravity, ExternalForce, Anchor, Distance, Bending, TriangleStrain, TetStrain>;

/// `mass` in kg, one per node; infinite mass keeps the node's velocity as it is.
/// The order of `effects` is the order of Gauss-Seidel.
struct Scene {
  std::vector<double> mass;
  State initial;
  std::vector<Effect> effects;

  int nodes() const { return static_cast<int>(mass.size()); }
};

/// True if the effect lists damping.
bool damped(const Effect& effect);

/// Adds a node and returns its index. Position m, mass kg, velocity m/s.
int add_node(Scene& scene, const Vec3& position, double mass, const Vec3& velocity = Vec3::Zero());

}  // namespace pbd
