// What the checks of a scene say.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>
#include <string>

#include "error.h"
#include "geometry.h"

namespace pbd {

template <class T>
std::string text(const T& value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}

inline std::string text(const Vec3& value) {
  return "(" + text(value.x()) + ", " + text(value.y()) + ", " + text(value.z()) + ")";
}

/// Throws the SetupError of these arguments unless it holds. A macro, so that the texts of errors are made
/// where one occurs and nowhere else: every workspace validates its scene.
#define REQUIRE(holds, ...)                      \
  do {                                           \
    if (!(holds)) throw SetupError(__VA_ARGS__); \
  } while (false)

/// How far lengths and products of unit vectors may be from 1 and 0: numbers given to ten digits pass.
inline constexpr double unit_slack = 1e-9;

inline bool is_unit(const Eigen::Quaterniond& q) {
  return std::abs(q.norm() - 1) <= unit_slack;
}

inline std::string norm_of(const Eigen::Quaterniond& q) {
  return "a quaternion of norm " + text(q.norm());
}

}  // namespace pbd
