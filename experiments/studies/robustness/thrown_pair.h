// Two things of given kinds, thrown at each other.
#pragma once

#include <cstdint>
#include <string_view>

#include "scene.h"
#include "studies/robustness/passage.h"

namespace pbdcheck {

/// `point` and `ball` are nodes, without a radius and with one; a mesh is closed and may have hollows, a
/// static one is wide and fixed.
enum class Thing { sphere, box, cylinder, capsule, hull, mesh, point, ball, sheet, half_space, static_mesh };
inline constexpr std::array<std::string_view, 11> thing_names{"sphere", "box",        "cylinder",   "capsule",
                                                              "hull",   "mesh",       "point",      "ball",
                                                              "cloth",  "half space", "static mesh"};

/// All pairs that continuous contact is about.
std::vector<std::array<Thing, 2>> thrown_pairs();

struct ThrownPair {
  pbd::Scene scene;
  std::array<Core, 2> whole, core;  // a half space last
  double apart = 0;                 // m, that they begin apart at least
  double h = 0.01;                  // s
  int steps = 1;
};

/// Scene `index` of a pair of kinds. The first one begins apart from the second one by a thousandth of the
/// smaller one's radius or more; the second one is fixed, or up to a thousand times as light or as heavy.
/// They go against each other by 1 to 100 times the smaller one's size a step, towards any place within 1.1
/// times the second one's radius, and turn by up to 3 rad a step; half of all shapes are plates, discs or
/// rods as thin as a hundredth. Cloth has 8 triangles, held by its border or free. One to three steps.
ThrownPair thrown_pair(const std::array<Thing, 2>& kinds, std::int64_t index, bool continuous);

}  // namespace pbdcheck
