// What scenes with a mistake begin with.
#pragma once

#include <string>

namespace pbdcheck::test {

/// Lines 1 to 14 of a scene.
inline const std::string two_bodies = R"([[rigid_body]]
name = "arm"
shape = "sphere"
radius_m = 0.5
mass_kg = 2
[[rigid_body]]
name = "hand"
mass_kg = 1
inertia_kg_m2 = [1, 2, 2.5]
position_m = [1, 0, 0]
[step]
step_s = 0.01
steps = 2

)";

inline std::string body(const std::string& rest) {
  return "[[rigid_body]]\n" + rest;
}

/// Line 15 to 17 and what follows.
inline std::string joint(const std::string& kind, const std::string& rest) {
  return "[[joint]]\nbodies = [\"arm\", \"hand\"]\nkind = \"" + kind + "\"\n" + rest;
}

inline const std::string sphere = "name = \"third\"\nshape = \"sphere\"\n";
inline const std::string wall = body("name = \"wall\"\nheld = \"fixed\"\n");

}  // namespace pbdcheck::test
