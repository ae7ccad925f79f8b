// Checks of the effects on rigid bodies; each throws SetupError (validate.h).
#pragma once

#include "effect_check.h"

namespace pbd {

void validate(const EffectCheck& check, const ExternalTorque& effect);
void validate(const EffectCheck& check, const Gyroscopic& effect);
void validate(const EffectCheck& check, const PointJoint& effect);
void validate(const EffectCheck& check, const AxisJoint& effect);
void validate(const EffectCheck& check, const PerpendicularJoint& effect);
void validate(const EffectCheck& check, const RotationJoint& effect);
void validate(const EffectCheck& check, const LineJoint& effect);
void validate(const EffectCheck& check, const BodyDistance& effect);
void validate(const EffectCheck& check, const AngleJoint& effect);
void validate(const EffectCheck& check, const SlideJoint& effect);
void validate(const EffectCheck& check, const Attachment& effect);

}  // namespace pbd
