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
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry.h"
#include "shapes.h"

namespace pbd {

/// Positions x (m) and velocities v (m/s) of all nodes, 3 x N each, at `time` (s). Of each rigid body the
/// orientation, which takes its frame to the world's, and the angular velocity in its own frame (3 x B,
/// rad/s).
struct State {
  double time = 0;
  Points x;
  Points v;
  std::vector<Eigen::Quaterniond> orientation{};
  Points spin = Points(3, 0);
};

/// A rigid body. Its centre of mass is a node of the scene, whose mass is the body's; its frame has its
/// origin there and its axes along the principal axes of inertia. `inertia` holds the principal moments
/// (kg m^2); infinite ones keep the angular velocity as it is.
struct RigidBody {
  int node = 0;
  Vec3 inertia = Vec3::Ones();
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

/// Constant torques on rigid bodies, N m in the world's axes, as they are where a step begins.
struct ExternalTorque {
  static constexpr std::string_view name = "external_torque";
  std::vector<int> body;
  std::vector<Vec3> torque;
};

/// The torque -w x I w that turns a rigid body's angular velocity w; without it, w stays as it is in the
/// body's frame. Explicit: as it is where a step begins. Implicit: where its forces act, as those of
/// constraints do.
struct Gyroscopic {
  static constexpr std::string_view name = "gyroscopic";
  bool implicit = true;
};

// Joints of two rigid bodies a, b: points p (m) and unit axes u are given in the bodies' frames, y = x + R p
// and R u are theirs in the world. Each removes what its value states; a hinge is a point_joint and an
// axis_joint, a slider a line_joint and a rotation_joint, a universal joint a point_joint and a
// perpendicular_joint, a weld a point_joint and a rotation_joint. A body of infinite mass and inertia stands
// for the world.

/// Bounds of the force gamma (N, or N m) of a constraint of one row: where gamma is at the lower one, c may
/// be positive, at the upper one negative. {0, infinity} is a limit from below, c >= 0; {-t, t} a motor of
/// at most t N m.
using ForceBounds = std::array<double, 2>;

/// c = y_b - y_a (3 rows, m). Compliance in m/N.
struct PointJoint {
  static constexpr std::string_view name = "point_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = t . R_b u_b for two unit vectors t of body a, at right angles to u_a and each other (2 rows, rad where
/// small): the axes are parallel. Compliance in rad/(N m).
struct AxisJoint {
  static constexpr std::string_view name = "axis_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> axis;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = R_a u_a . R_b u_b (1 row, rad where small): the axes are at right angles.
struct PerpendicularJoint {
  static constexpr std::string_view name = "perpendicular_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> axis;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = 2 vec(r^-1 q_a^-1 q_b), its scalar part not negative (3 rows, rad where small): the orientation of b
/// in a's frame is r.
struct RotationJoint {
  static constexpr std::string_view name = "rotation_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<Eigen::Quaterniond> rest;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = t . (y_b - y_a) for two unit vectors t of body a, at right angles to the axis u_a and each other (2
/// rows, m): y_b stays on the line through y_a along u_a.
struct LineJoint {
  static constexpr std::string_view name = "line_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<Vec3> axis;  // u_a
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// c = |y_b - y_a| - rest_length (1 row, m).
struct BodyDistance {
  static constexpr std::string_view name = "body_distance";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<double> rest_length;
  std::vector<double> compliance;
  std::vector<double> damping{};
  std::vector<ForceBounds> bounds{};  // empty: none
};

/// c = angle - (rest_angle + rate t) modulo 2 pi in (-pi, pi] (1 row, rad): the angle that body b is turned
/// by about a's axis u_a, from the reference direction of a to that of b, both at right angles to the axis.
/// With compliance a spring; a rate (rad/s) makes it a motor.
struct AngleJoint {
  static constexpr std::string_view name = "angle_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<Vec3> axis;                      // u_a
  std::vector<std::array<Vec3, 2>> reference;  // unit vectors
  std::vector<double> rest_angle;
  std::vector<double> rate;
  std::vector<double> compliance;
  std::vector<double> damping{};
  std::vector<ForceBounds> bounds{};  // empty: none
};

/// c = R_a u_a . (y_b - y_a) - (rest_position + rate t) (1 row, m). With compliance a spring; a rate (m/s)
/// makes it a motor.
struct SlideJoint {
  static constexpr std::string_view name = "slide_joint";
  std::vector<std::array<int, 2>> body;
  std::vector<std::array<Vec3, 2>> point;
  std::vector<Vec3> axis;  // u_a
  std::vector<double> rest_position;
  std::vector<double> rate;
  std::vector<double> compliance;
  std::vector<double> damping{};
  std::vector<ForceBounds> bounds{};  // empty: none
};

/// c = x_node - y (3 rows, m): a node held by a point of a rigid body.
struct Attachment {
  static constexpr std::string_view name = "attachment";
  std::vector<int> body;
  std::vector<int> node;
  std::vector<Vec3> point;
  std::vector<double> compliance;
  std::vector<double> damping{};
};

/// What two materials do where they touch: Coulomb's coefficient of friction; the share of the approaching
/// speed that comes back where they collide; compliance (m/N) and retardation time (s) of the gap.
struct ContactLaw {
  double friction = 0.5;
  double restitution = 0;
  double compliance = 0;
  double damping = 0;
};

/// A shape that may touch others, in a frame of its rigid body.
struct Collider {
  Shape shape;
  int body = 0;
  Frame frame{};
  int material = 0;
};

/// Contact of colliders with each other, of nodes, spheres of `radius` (m, 0 for a point), with colliders,
/// and of deformable surfaces, the triangles, with each other and themselves at a distance of `thickness`.
/// Two colliders of one body, of bodies that a joint connects, or of bodies named in `apart` do not touch.
/// `law` has an entry for each pair of materials, row by row of a symmetric table. Gaps g >= 0 at the end of
/// each step; where one begins with overlap, the shapes part by at most `recovery` (m/s). Pairs take part
/// that are nearer than their motions go, and `margin` (m).
struct Contact {
  static constexpr std::string_view name = "contact";
  std::vector<Collider> collider;
  std::vector<int> node{};
  std::vector<double> radius{};
  std::vector<int> node_material{};
  std::vector<std::array<int, 3>> triangle{};  // of nodes
  double thickness = 1e-3;                     // m
  int surface_material = 0;
  int materials = 1;
  std::vector<ContactLaw> law{ContactLaw{}};
  std::vector<std::array<int, 2>> apart{};
  double margin = 0;
  double recovery = infinity;

  /// Of the material of collider or node k, nodes behind the colliders.
  int material(std::size_t k) const {
    return k < collider.size() ? collider[k].material : node_material[k - collider.size()];
  }
  const ContactLaw& between(std::size_t first, std::size_t second) const {
    const auto row = static_cast<std::size_t>(material(first)),
               column = static_cast<std::size_t>(material(second));
    return law[row * static_cast<std::size_t>(materials) + column];
  }
};

using Effect =
    std::variant<Gravity, ExternalForce, Anchor, Distance, Bending, TriangleStrain, TetStrain, ExternalTorque,
                 Gyroscopic, PointJoint, AxisJoint, PerpendicularJoint, RotationJoint, LineJoint,
                 BodyDistance, AngleJoint, SlideJoint, Attachment, Contact>;

/// `mass` in kg, one per node; infinite mass keeps the node's velocity as it is.
/// The order of `effects` is the order of Gauss-Seidel.
struct Scene {
  std::vector<double> mass;
  State initial;
  std::vector<Effect> effects;
  std::vector<RigidBody> bodies{};

  int nodes() const { return static_cast<int>(mass.size()); }
};

/// True if the effect lists damping.
bool damped(const Effect& effect);

/// Adds a rigid body and its node, and returns the body's index. Position of the centre of mass in m, angular
/// velocity in the body's frame, rad/s.
int add_body(Scene& scene, const Vec3& position, double mass, const Vec3& inertia,
             const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity(),
             const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero());

/// Adds a node and returns its index. Position m, mass kg, velocity m/s.
int add_node(Scene& scene, const Vec3& position, double mass, const Vec3& velocity = Vec3::Zero());

}  // namespace pbd
