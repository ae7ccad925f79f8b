#include "effects/rotation_joint.h"

#include "rows/effect_rows.h"

namespace pbd {
namespace {

/// Rotation error of b, and dc/dphi_b of c = 2 vec(error).
struct Turned {
  Eigen::Quaterniond error;
  Eigen::Matrix3d by_phi;

  Turned(const RotationJoint& effect, std::size_t i, const Pose& a, const Pose& b)
      : error(Eigen::Matrix3d(effect.rest[i].toRotationMatrix().transpose() * a.rotation.transpose() *
                              b.rotation)) {
    if (error.w() < 0) error.coeffs() *= -1;
    by_phi = (error.w() * Eigen::Matrix3d::Identity() + cross_matrix(error.vec())) * b.rotation.transpose();
  }
};
}  // namespace

void Constraint<RotationJoint>::evaluate(const RotationJoint& effect, std::size_t i, const Positions& at,
                                         Value& value, Jacobian& jacobian) {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Turned turned(effect, i, a, b);
  value = 2 * turned.error.vec();
  jacobian << Square::Zero(), -turned.by_phi * a.turn_per_arc, Square::Zero(), turned.by_phi * b.turn_per_arc;
}

/// Of b's rotation alone 2 vec(q) has the second derivative -vec(q) |phi|^2 / 2.
auto Constraint<RotationJoint>::geometric_bound(const RotationJoint& effect, std::size_t i,
                                                const Positions& at, const Value& impulse) -> NodeBounds {
  const Pose &a = *at.body[0], &b = *at.body[1];
  const Turned turned(effect, i, a, b);
  return rotation_bound(impulse.dot(turned.error.vec()) / 2 * Square::Identity(),
                        turned.by_phi.transpose() * impulse, a, b);
}

std::unique_ptr<Source> make_source(const Scene& scene, const RotationJoint& effect) {
  return std::make_unique<EffectRows<RotationJoint>>(scene, effect);
}

}  // namespace pbd
