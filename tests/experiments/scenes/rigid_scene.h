// Scene files of rigid bodies, read from a text.
#pragma once

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "read_scene.h"

namespace pbdcheck::test {

/// The effect of the scene that is an E.
template <class E>
const E& only(const pbd::Scene& scene) {
  const E* found = nullptr;
  for (const auto& effect : scene.effects)
    if (const auto* typed = std::get_if<E>(&effect)) {
      REQUIRE(found == nullptr);
      found = typed;
    }
  REQUIRE(found != nullptr);
  return *found;
}

inline Eigen::Matrix3d turned(const pbd::Vec3& rotation) {
  return Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
}

inline const std::string box =
    "[[rigid_body]]\nname = \"box\"\nshape = \"box\"\nsize_m = [0.2, 0.3, 0.4]\ndensity_kg_m3 = 500\n";
inline const std::string placed =
    "position_m = [1, 2, 3]\nrotation_rad = [0.3, -0.4, 0.5]\nvelocity_m_s = [1, 0, 2]\n"
    "angular_velocity_rad_s = [3, -2, 1]\n";

}  // namespace pbdcheck::test
