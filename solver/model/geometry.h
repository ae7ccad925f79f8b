// Points, frames and surfaces.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pbd {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The larger one; NaN if one of them is.
inline double larger(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

using Vec3 = Eigen::Vector3d;
using Points = Eigen::Matrix3Xd;  // one column a node

/// Takes a body's (or a shape's) frame to the world's (or the body's): x = origin + rotation x'.
struct Frame {
  Vec3 origin = Vec3::Zero();  // m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();

  Vec3 place(const Vec3& point) const { return origin + rotation * point; }
};

/// Triangles, anticlockwise seen from the side of the normal. Positions in m.
struct TriangleMesh {
  Points x;
  std::vector<std::array<int, 3>> triangles;
};

}  // namespace pbd
