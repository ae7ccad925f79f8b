// Rigid bodies as columns. Beside the three velocities of its centre of mass a body has three of rotation,
//   eta = r w,  r = sqrt(I / m) (m, one a principal axis: radii of gyration),
// w (rad/s) its angular velocity in its own frame: in eta its kinetic energy is m |eta|^2 / 2, so that every
// column has one mass, that of a body's rotation the body's own. The columns of rotation stand behind those
// of the nodes, body b's at nodes + b. Their positions are arcs from where the step begins:
//   R(x) = R_l exp([x/r]x),
// which leaves the integrators' affine map x = x0 + d v as it is, with x_l = 0 (the tangent space at the
// frame's start; simo1991unconditionally). Impulses act along dc/dphi R(x)/r, phi a rotation of the body as
// it stands: the torque they give is the one at x, not the gradient by the arc, which differs by d w / 2
// times the ratio of the radii that w mixes.
#pragma once

#include <vector>

#include "scene.h"

namespace pbd {

/// Where a rigid body stands.
struct Pose {
  Vec3 x;                        // m, centre of mass
  Eigen::Matrix3d rotation;      // body to world
  Eigen::Matrix3d turn_per_arc;  // R/r, 1/m: from eta to the angular velocity in the world
};

/// What a constraint is evaluated at.
struct Configuration {
  const Points& x;  // of all columns
  const std::vector<Pose>& pose;
  double time;  // s
};

/// [a]x b = a x b
Eigen::Matrix3d cross_matrix(const Vec3& a);

/// exp([angle]x) as a quaternion; angle a rotation vector in rad.
Eigen::Quaterniond rotation_by(const Vec3& angle);

class Bodies {
 public:
  explicit Bodies(const Scene& scene);

  int count() const { return static_cast<int>(radius_.size()); }
  int nodes() const { return nodes_; }
  int columns() const { return nodes_ + count(); }
  Eigen::Index column(int body) const { return nodes_ + body; }
  int node(int body) const { return node_[body]; }

  /// Masses of the columns: nodes, then rotations; 1/kg, 0 for infinite mass.
  std::vector<double> inverse_masses(const Scene& scene) const;

  /// Columns of a state: arcs are zero there.
  void begin(const State& state, Points& x, Points& v);
  void end(const Points& x, const Points& v, State& state) const;

  /// Poses at positions x of all columns, since the last `begin`.
  void place(const Points& x, std::vector<Pose>& poses) const;

  /// A body's angular velocity at v, and the largest one, rad/s.
  double spin(int body, const Points& v) const;
  double largest_spin(const Points& v) const;

  /// Of gyration, m; 0 if there is no body.
  double largest_radius() const;

  /// eta of what acts as a torque in the world, as accelerations, m/s^2.
  Vec3 acceleration(int body, const Vec3& torque, const Pose& pose) const;

  /// -w x I w as an acceleration of eta, m/s^2, and its derivative by eta.
  Vec3 gyroscopic(int body, const Vec3& eta) const;
  Eigen::Matrix3d gyroscopic_gradient(int body, const Vec3& eta) const;

  /// Takes eta from `free` to eta = free + s gyroscopic(eta), by Newton's method with step halving; the
  /// length of what eta misses of it is returned, 0 where that is rounding.
  double add_gyroscopic(int body, double s, Vec3& eta) const;

  /// A bound of what an outer iteration leaves of an error, since it takes the directions at x and the
  /// gyroscopic torque of the last iterate: d/2 |r [w]x r^-1| to first order in d w, and s times the norm of
  /// the torque's gradient.
  double contraction(const Points& v, double d, double s, bool implicit_gyroscopic) const;

 private:
  int nodes_ = 0;
  std::vector<int> node_;
  std::vector<Vec3> radius_;               // m
  std::vector<double> inverse_mass_;       // of rotations, 1/kg
  std::vector<Eigen::Quaterniond> start_;  // where the step begins
};

}  // namespace pbd
