// A surface (touching_surface.h) where it stands.
#pragma once

#include <algorithm>

#include "touching_features.h"

namespace pbd::reference {

/// A box along the world's axes.
struct Bounds {
  Vec3 least = Vec3::Constant(infinity), most = Vec3::Constant(-infinity);

  void add(const Vec3& x) {
    least = least.cwiseMin(x);
    most = most.cwiseMax(x);
  }
  bool near(const Bounds& other, double reach) const {
    return (least.array() - reach <= other.most.array()).all() &&
           (other.least.array() - reach <= most.array()).all();
  }
};

/// Lengths of no account beside a face, of its sides.
constexpr double beyond = 1e-4;

constexpr double leaning = 0.2, parallel = 1e-3;  // rad, as feature_search.h says

/// Whether a point is above or below a face of a surface with these corners and normal n, or beside it by
/// `slack` of its sides: of a cylinder's cap by its disc.
inline bool is_within(const Surface& surface, const std::vector<Vec3>& corners, const Vec3& point,
                      const Vec3& n, double slack = beyond) {
  if (surface.cylinder > 0) {
    const Vec3 from = point - (corners[0] + corners[corners.size() / 2]) / 2;
    return (from - n.dot(from) * n).norm() <= (1 + slack) * surface.cylinder;
  }
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 side = corners[(k + 1) % corners.size()] - corners[k];
    if (side.cross(point - corners[k]).dot(n) < -slack * side.squaredNorm()) return false;
  }
  return true;
}

/// Kinds of features, as their names count them.
namespace feature_kind {
inline constexpr int corner = 0, edge = 1, face = 2, rim = 3;
}

/// A surface where it stands: its corners, features and the boxes about them.
struct PlacedSurface {
  const Surface& surface;
  std::vector<Vec3> x;
  Bounds all;
  double moved = 0;  // m, since the start
  /// By kind.
  std::array<std::vector<Bounds>, 4> bounds;

  PlacedSurface(const Surface& own, const Placement& start, const Placement& at);

  Vec3 axis() const { return (x[1] - x[0]).normalized(); }  // of a cylinder

  /// Three of a face's corners, far from each other.
  int corner_of_face(std::size_t i, std::size_t k) const {
    const auto& face = surface.face[i];
    return face[k * face.size() / 3];
  }

  /// Infinite of planes and points.
  double size() const {
    const double own = (all.most - all.least).norm() + 2 * surface.radius;
    return surface.plane || own == 0 ? infinity : own;
  }

  ContactFeature feature(int kind, std::size_t i) const;

  /// True if the corners next to a feature, of which `from` is a point, lie along n (or across it), but for a
  /// slope; of a point on a rim if its cylinder does, and the rim there. Deformable surfaces may bend as they
  /// like.
  bool lies_along(const Vec3& n, const Vec3& from, int kind, std::size_t i, double slope) const;

  bool within_face(std::size_t i, const Vec3& point, const Vec3& n, double slack = beyond) const {
    std::vector<Vec3> corners;
    for (const int k : surface.face[i]) corners.push_back(x[static_cast<std::size_t>(k)]);
    return is_within(surface, corners, point, n, slack);
  }

  Vec3 face_normal(std::size_t i) const {
    const auto corner = [&](std::size_t k) { return x[static_cast<std::size_t>(corner_of_face(i, k))]; };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  }
};

}  // namespace pbd::reference
