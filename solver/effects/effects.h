// The list of effects the solver can compute. Every alternative of `Effect` but contact (contact.h) must be
// one of the two kinds; a new one that states neither Constraint<> nor Force<> does not compile.
#pragma once

#include "effects/anchor.h"
#include "effects/angle_joint.h"
#include "effects/attachment.h"
#include "effects/axis_joint.h"
#include "effects/bending.h"
#include "effects/body_distance.h"
#include "effects/distance.h"
#include "effects/external_force.h"
#include "effects/external_torque.h"
#include "effects/gravity.h"
#include "effects/gyroscopic.h"
#include "effects/line_joint.h"
#include "effects/perpendicular_joint.h"
#include "effects/point_joint.h"
#include "effects/rotation_joint.h"
#include "effects/slide_joint.h"
#include "effects/tet_strain.h"
#include "effects/triangle_strain.h"

namespace pbd {

template <class Effect>
inline constexpr bool is_stated =
    (RowEffect<Effect> != ForceEffect<Effect>) || std::is_same_v<Effect, Contact>;
template <class Variant>
inline constexpr bool every_effect_is_stated = false;
template <class... Effects>
inline constexpr bool every_effect_is_stated<std::variant<Effects...>> = (is_stated<Effects> && ...);
static_assert(every_effect_is_stated<Effect>, "an effect needs either Constraint<> or Force<>");

}  // namespace pbd
