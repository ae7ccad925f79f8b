// The tables [[probe]] of a scene file.
#pragma once

#include "keys.h"
#include "scene_file.h"

namespace pbdcheck {

/// To be called after the nodes, bodies, joints and the method were read.
void read_probes(Keys& root, SceneFile& found);

}  // namespace pbdcheck
