#include "validate_body_effects.h"

#include <cmath>

#include "validate_texts.h"

namespace pbd {
namespace {

void validate_bounds(const EffectCheck& check, std::size_t count, const std::vector<ForceBounds>& bounds) {
  if (bounds.empty()) return;
  check.same_size(count, bounds, "bounds");
  for (std::size_t i = 0; i < count; ++i) {
    const auto [lower, upper] = bounds[i];
    REQUIRE(lower <= 0 && upper >= 0 && lower < upper, check.at(i, "bounds"),
            "(" + text(lower) + ", " + text(upper) + ")", "a lower one <= 0 and an upper one >= 0");
  }
}

/// Two bodies each, and one entry a joint of everything else.
template <class Joint>
void validate_joint(const EffectCheck& check, const Joint& effect) {
  const std::size_t count = effect.body.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (const int body : effect.body[i]) check.body_index(body, i);
    REQUIRE(effect.body[i][0] != effect.body[i][1], check.at(i, "body"), text(effect.body[i][0]) + " twice",
            "two different bodies");
  }
  check.same_size(count, effect.compliance, "compliance");
  check.not_negative(effect.compliance, "compliance");
  check.retardation_times(count, effect.damping);
  if constexpr (requires { effect.bounds; }) validate_bounds(check, count, effect.bounds);
  if constexpr (requires { effect.point; }) {
    check.same_size(count, effect.point, "point");
    for (std::size_t i = 0; i < count; ++i)
      for (const Vec3& point : effect.point[i])
        REQUIRE(point.allFinite(), check.at(i, "point"), text(point), "finite numbers");
  }
  if constexpr (requires { effect.axis; }) {
    check.same_size(count, effect.axis, "axis");
    for (std::size_t i = 0; i < count; ++i) check.unit(effect.axis[i], i, "axis");
  }
}

}  // namespace

void validate(const EffectCheck& check, const ExternalTorque& effect) {
  check.same_size(effect.body.size(), effect.torque, "torque");
  for (std::size_t i = 0; i < effect.body.size(); ++i) check.body_index(effect.body[i], i);
  check.finite(effect.torque, "torque");
}

void validate(const EffectCheck& check, const Gyroscopic&) {
  check.only_one<Gyroscopic>();
}

void validate(const EffectCheck& check, const PointJoint& effect) {
  validate_joint(check, effect);
}
void validate(const EffectCheck& check, const AxisJoint& effect) {
  validate_joint(check, effect);
}
void validate(const EffectCheck& check, const PerpendicularJoint& effect) {
  validate_joint(check, effect);
}
void validate(const EffectCheck& check, const LineJoint& effect) {
  validate_joint(check, effect);
}

void validate(const EffectCheck& check, const RotationJoint& effect) {
  validate_joint(check, effect);
  check.same_size(effect.body.size(), effect.rest, "rest");
  for (std::size_t i = 0; i < effect.rest.size(); ++i)
    REQUIRE(is_unit(effect.rest[i]), check.at(i, "rest"), norm_of(effect.rest[i]), "norm 1");
}

void validate(const EffectCheck& check, const BodyDistance& effect) {
  validate_joint(check, effect);
  check.same_size(effect.body.size(), effect.rest_length, "rest_length");
  check.not_negative(effect.rest_length, "rest_length");
  for (std::size_t i = 0; i < effect.rest_length.size(); ++i)
    REQUIRE(effect.rest_length[i] > 0 || effect.compliance[i] > 0, check.at(i, "rest_length"),
            "0 and compliance 0", "a rest length > 0 for a link without compliance, or a point_joint");
}

void validate(const EffectCheck& check, const AngleJoint& effect) {
  validate_joint(check, effect);
  check.same_size(effect.body.size(), effect.reference, "reference");
  check.same_size(effect.body.size(), effect.rest_angle, "rest_angle");
  check.same_size(effect.body.size(), effect.rate, "rate");
  check.finite(effect.rest_angle, "rest_angle");
  check.finite(effect.rate, "rate");
  for (std::size_t i = 0; i < effect.reference.size(); ++i) {
    check.unit(effect.reference[i], i, "reference");
    REQUIRE(std::abs(effect.reference[i][0].dot(effect.axis[i])) <= unit_slack, check.at(i, "reference"),
            text(effect.reference[i][0]), "a direction at right angles to the axis");
  }
}

void validate(const EffectCheck& check, const SlideJoint& effect) {
  validate_joint(check, effect);
  check.same_size(effect.body.size(), effect.rest_position, "rest_position");
  check.same_size(effect.body.size(), effect.rate, "rate");
  check.finite(effect.rest_position, "rest_position");
  check.finite(effect.rate, "rate");
}

void validate(const EffectCheck& check, const Attachment& effect) {
  const std::size_t count = effect.body.size();
  check.same_size(count, effect.node, "node");
  check.same_size(count, effect.point, "point");
  check.same_size(count, effect.compliance, "compliance");
  check.node_indices(effect.node);
  for (std::size_t i = 0; i < count; ++i) {
    check.body_index(effect.body[i], i);
    REQUIRE(effect.node[i] != check.scene.bodies[effect.body[i]].node, check.at(i, "node"),
            text(effect.node[i]) + ", the body's own", "another node than the body's centre of mass");
  }
  check.finite(effect.point, "point");
  check.not_negative(effect.compliance, "compliance");
  check.retardation_times(count, effect.damping);
}

}  // namespace pbd
