// Which judge states each effect of a scene. Every alternative of the variant Effect (scene.h) stands in
// exactly one list; another one does not compile.
#pragma once

#include <type_traits>
#include <variant>

#include "scene.h"

namespace pbd::reference {

template <class... E>
struct EffectList {};

/// Stated by model.cpp: forces on nodes and constraints between them.
using NodeEffects = EffectList<Gravity, ExternalForce, Anchor, Distance, Bending, TriangleStrain, TetStrain>;
/// Stated by rigid_model.cpp: forces and joints of rigid bodies.
using BodyEffects = EffectList<ExternalTorque, Gyroscopic, PointJoint, AxisJoint, PerpendicularJoint,
                               RotationJoint, LineJoint, BodyDistance, AngleJoint, SlideJoint, Attachment>;
/// Refused by name by model.cpp, which rigid_model.cpp builds on.
using RefusedEffects = EffectList<Contact>;

template <class E, class... Listed>
constexpr int times_listed(EffectList<Listed...>) {
  return (0 + ... + int(std::is_same_v<E, Listed>));
}

template <class E>
struct Judged {
  static_assert(times_listed<E>(NodeEffects{}) + times_listed<E>(BodyEffects{}) +
                        times_listed<E>(RefusedEffects{}) ==
                    1,
                "an effect without a judge: state it in model.cpp or rigid_model.cpp, or refuse it by name, "
                "and put it in that list of judged_effects.h");
  static constexpr bool value = true;
};

template <class Variant>
struct AllJudged;
template <class... E>
struct AllJudged<std::variant<E...>> {
  static constexpr bool value = (Judged<E>::value && ...);
};

/// Of a type E among the list.
template <class E, class List>
concept Among = times_listed<E>(List{})
== 1;

/// Whether `Builder` has a statement, or a refusal, of every effect of the list.
template <class Builder, class... E>
constexpr bool states(EffectList<E...>) {
  return (std::is_invocable_v<Builder&, const E&> && ...);
}

}  // namespace pbd::reference
