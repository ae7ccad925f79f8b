// A scene: masses, an initial state and the list of effects it calls for. Data only.
//
// Effects are structs of arrays, one entry per constraint. A constraint has a vector value c(x) and a
// compliance A >= 0 (an R x R matrix for R rows): energy 1/2 c^T A^-1 c where A > 0, the equation c = 0 where
// A = 0. Its damping, if the effect lists any, is Kelvin-Voigt's: c + T dc/dt + A gamma = 0 with the force
// multiplier gamma and the retardation time T (s; an R x R matrix), so that a compliant constraint has the
// damping coefficient A^-1 T, and the error of a hard one decays with T. Rest shapes are stored as positions,
// so that solver and judges each derive their own rest quantities from them. Units are SI: m, kg, s, N, Pa,
// rad.
#pragma once

#include <variant>
#include <vector>

#include "body_effects.h"
#include "contact_effect.h"
#include "point_effects.h"
#include "state.h"

namespace pbd {

/// All effects there are.
using Effect =
    std::variant<Gravity, ExternalForce, Anchor, Distance, Bending, TriangleStrain, TetStrain, ExternalTorque,
                 Gyroscopic, PointJoint, AxisJoint, PerpendicularJoint, RotationJoint, LineJoint,
                 BodyDistance, AngleJoint, SlideJoint, Attachment, Contact>;

/// Copied and destroyed in scene.cpp, not in each file that has a scene.
struct EffectList : std::vector<Effect> {
  EffectList();
  EffectList(std::initializer_list<Effect> effects);
  EffectList(const EffectList&);
  EffectList(EffectList&&) noexcept;
  EffectList& operator=(const EffectList&);
  EffectList& operator=(EffectList&&) noexcept;
  ~EffectList();
};

/// `mass` in kg, one per node; infinite mass keeps the node's velocity as it is.
/// The order of `effects` is the order of Gauss-Seidel.
struct Scene {
  std::vector<double> mass;
  State initial;
  EffectList effects;
  std::vector<RigidBody> bodies{};

  int nodes() const { return static_cast<int>(mass.size()); }
};

/// True if the effect lists damping.
template <class E>
bool damped(const E& effect) {
  if constexpr (requires { effect.damping.has_value(); })
    return effect.damping.has_value();
  else if constexpr (requires { effect.damping.empty(); })
    return !effect.damping.empty();
  return false;
}
bool damped(const Effect& effect);

/// Adds a rigid body and its node, and returns the body's index. Position of the centre of mass in m, angular
/// velocity in the body's frame, rad/s.
int add_body(Scene& scene, const Vec3& position, double mass, const Vec3& inertia,
             const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity(),
             const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero());

/// Adds a node and returns its index. Position m, mass kg, velocity m/s.
int add_node(Scene& scene, const Vec3& position, double mass, const Vec3& velocity = Vec3::Zero());

}  // namespace pbd
