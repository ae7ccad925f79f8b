// What a scene file says of its rigid bodies and joints beside the solver's own data.
#pragma once

#include <string>
#include <vector>

#include "scenes/body_shapes.h"

namespace pbdcheck {

struct NamedBody {
  std::string name;
  Shape shape;
  Eigen::Isometry3d to_body;  // from the shape's frame to the solver's, along the principal axes of inertia
};

/// A joint between two bodies as the constraints of one or two effects.
struct NamedJoint {
  std::string name;                     // may be empty
  int body = 0;                         // the second one
  pbd::Vec3 point = pbd::Vec3::Zero();  // of that one, in its frame: where the joint holds it
  bool compliant = false;               // one of its constraints is
  bool bounded = false;                 // its force is: a limit, or a motor of limited force
  std::string where{};                  // in the scene file, as errors begin
  struct Part {
    std::size_t effect, constraint;
  };
  std::vector<Part> parts;
};

}  // namespace pbdcheck
