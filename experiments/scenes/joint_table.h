// A table of a joint between two bodies being read: what all kinds of joints state, and the constraints they
// add. Places and axes are given in the world as the scene starts.
#pragma once

#include <Eigen/Geometry>
#include <tuple>

#include "scenes/builder.h"

namespace pbdcheck {

/// An effect that joints make, and the line of the first one.
template <class Effect>
struct Slot {
  Effect effect;
  int line = 0;
};

/// The effects that joints make.
struct JointEffects {
  std::tuple<Slot<pbd::PointJoint>, Slot<pbd::AxisJoint>, Slot<pbd::PerpendicularJoint>,
             Slot<pbd::RotationJoint>, Slot<pbd::LineJoint>, Slot<pbd::BodyDistance>, Slot<pbd::AngleJoint>,
             Slot<pbd::SlideJoint>>
      slots;

  void place(Builder& builder) {
    const auto add = [&](auto& slot) {
      if (!slot.effect.body.empty()) builder.add(slot.line, std::move(slot.effect));
    };
    std::apply([&](auto&... slot) { (add(slot), ...); }, slots);
  }
};

struct JointTable {
  Keys& keys;
  Builder& builder;
  JointEffects& effects;
  NamedJoint joint{};
  std::array<int, 2> body{};
  std::array<Eigen::Quaterniond, 2> orientation{};
  std::array<pbd::Vec3, 2> centre{}, point{};  // m, in the world; m, in the bodies' frames
  double damping = 0;                          // s
  std::optional<Closing<pbd::Vec3>> closing;   // of the points, in the first body's frame

  JointTable(Keys& table, Builder& scene, JointEffects& made);

  double positions() { return read_compliance(keys); }
  double rotations() { return read_compliance(keys, "compliance_rad_per_n_m", "stiffness_n_m_per_rad"); }

  /// A direction of the world, and a place in it, in the frame of body k.
  pbd::Vec3 own(std::size_t k, const pbd::Vec3& direction) const {
    return orientation[k].conjugate() * direction;
  }
  pbd::Vec3 own_point(std::size_t k, const pbd::Vec3& place) const { return own(k, place - centre[k]); }

  /// A constraint of `Effect` with all that every joint states.
  template <class Effect>
  Effect& add(double compliance) {
    auto& [effect, line] = std::get<Slot<Effect>>(effects.slots);
    if (effect.body.empty()) line = keys.line();
    joint.parts.push_back({pbd::Effect(Effect{}).index(), effect.body.size()});
    effect.body.push_back(body);
    effect.compliance.push_back(compliance);
    set_damping(effect, effect.body.size() - 1, damping);
    joint.compliant = joint.compliant || compliance > 0;
    return effect;
  }

  /// Bounds of the last constraint's force; an effect without any stays without.
  template <class Effect>
  void set_bounds(Effect& effect, const pbd::ForceBounds& bounds) {
    constexpr pbd::ForceBounds none{-pbd::infinity, pbd::infinity};
    joint.bounded = joint.bounded || bounds != none;
    if (bounds == none && effect.bounds.empty()) return;
    effect.bounds.resize(effect.body.size(), none);
    effect.bounds.back() = bounds;
  }

  /// The place of both, or those of each, which close within a time.
  void read_point();

  /// The distance vector of the two places.
  pbd::Vec3 read_points();

  /// A motor's rate, and its factor over time.
  std::optional<Course> read_rate(std::string_view key, std::vector<double>& rates);
};

}  // namespace pbdcheck
