// The same scene in other units.
#pragma once

#include "scene.h"

namespace pbdcheck {

/// The scene with lengths times `length` and masses times `mass`, times as they are: its motion is the same.
pbd::Scene in_units(pbd::Scene scene, double length, double mass);

}  // namespace pbdcheck
