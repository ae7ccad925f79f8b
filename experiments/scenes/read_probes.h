// The tables [[probe]] of a scene file.
#pragma once

#include "scenes/keys.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

/// To be called after the nodes, bodies, joints and the method were read.
void read_probes(Keys& root, SceneFile& found);

}  // namespace pbdcheck
