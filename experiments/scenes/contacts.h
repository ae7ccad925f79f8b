// Scenes of rigid bodies that touch, shared by experiments and tests. SI units, z up.
#pragma once

#include "scenes/standard.h"

namespace pbdcheck {

/// The contact of a scene, null if it has none.
const pbd::Contact* contact_of(const pbd::Scene& scene);

/// Where a body stands, and how it moves.
struct Placing {
  pbd::Vec3 position = pbd::Vec3::Zero();  // m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  pbd::Vec3 velocity = pbd::Vec3::Zero();  // m/s
  pbd::Vec3 spin = pbd::Vec3::Zero();      // rad/s, own axes
};

/// A scene under construction: bodies with one collider each, gravity and gyroscopic torques.
class BodyScene {
 public:
  explicit BodyScene(const pbd::ContactLaw& law, double gravity = pbdcheck::gravity);

  /// Each returns the body's index. A fixed body never moves.
  int fixed(const pbd::Shape& shape, const Placing& at, int material = 0);
  int box(const pbd::Vec3& size, double mass, const Placing& at, int material = 0);
  int ball(double radius, double mass, const Placing& at, int material = 0);
  int cylinder(double radius, double length, double mass, const Placing& at, int material = 0);
  int hull(const pbd::ConvexHull& hull, double density, const Placing& at, int material = 0);
  int mesh(const pbd::ClosedMesh& mesh, double density, const Placing& at, int material = 0);

  /// What is below the plane through the origin that is tilted by `angle` (rad) about y: x points downhill.
  int ground(double angle = 0, int material = 0);

  /// The law of two of `materials` (`all` before) materials.
  void materials(int count, const pbd::ContactLaw& all);
  void law(int first, int second, const pbd::ContactLaw& law);

  pbd::Contact& contact() { return contact_; }
  pbd::Scene finish() const;

 private:
  int add(const pbd::Shape& shape, double mass, const pbd::Vec3& inertia, const Placing& at, int material);
  int add_filled(const pbd::Shape& shape, const pbd::TriangleMesh& surface, double density, const Placing& at,
                 int material);

  pbd::Scene scene_;
  pbd::Contact contact_;
};

/// Adds a solid whose surface takes part in the scene's contact; returns its first node.
int add_touching_solid(pbd::Scene& scene, const pbd::TetMesh& mesh, double density,
                       const pbd::Material& material, pbd::Strain strain);

/// A box of `size` and 4 kg on ground tilted by `angle` (rad) that starts downhill at `speed` (m/s) turned by
/// `heading` (rad) from there.
pbd::Scene sliding_box(double angle, double friction, double speed, double heading = 0,
                       const pbd::Vec3& size = {0.2, 0.2, 0.1});

enum class Round { ball, cylinder, hoop };

/// One of 1 kg and 0.1 m that slips along x at 1 m/s on level ground, friction 0.2; a hoop is a cylinder with
/// all its mass at the rim.
pbd::Scene slipping(Round shape);

/// `count` cubes of 0.2 m and 8 kg on each other, each `ratio` times as heavy as the one below.
pbd::Scene column(int count, double ratio = 1);

/// Cubes of 0.2 m and 8 kg in rows of `base`, `base` - 1, ... 1, each over the gap of two below.
pbd::Scene pyramid(int base);

/// A cube slides on the ground, a slab on three piled cubes; one cube leaves the ground, a ball spins on it.
pbd::Scene pile();

}  // namespace pbdcheck
