// Small deformable bodies in contact, at rest, sliding and struck.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace pbdcheck {

/// A step that begins where the scene's initial state is.
struct DeformableContact {
  std::string name;
  pbd::Scene scene;
  double h;  // s
};

/// From scene files, with fewer cells; the solver has led them where the steps begin.
std::vector<DeformableContact> deformable_contacts();

}  // namespace pbdcheck
