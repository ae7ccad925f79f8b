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

/// Whether a point is above or below a face with normal n, or next to nothing beside it.
inline bool is_within(const std::vector<Vec3>& corners, const Vec3& point, const Vec3& n) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 side = corners[(k + 1) % corners.size()] - corners[k];
    if (side.cross(point - corners[k]).dot(n) < -beyond * side.squaredNorm()) return false;
  }
  return true;
}

/// A surface where it stands: its corners, features and the boxes about them.
struct PlacedSurface {
  const Surface& surface;
  std::vector<Vec3> x;
  Bounds all;
  double moved = 0;  // m, since the start
  /// 0 corners, 1 edges, 2 faces.
  std::array<std::vector<Bounds>, 3> bounds;

  PlacedSurface(const Surface& own, const Placement& start, const Placement& at) : surface(own) {
    for (const Corner& corner : own.corner) {
      all.add(x.emplace_back(placed(corner, at)));
      moved = std::max(moved, (x.back() - placed(corner, start)).norm());
      bounds[0].emplace_back().add(x.back());
    }
    for (std::size_t k = 0; k < 2 && own.cylinder > 0; ++k)  // all of the rims
      for (const double sign : {-1.0, 1.0}) all.add(x[k] + Vec3::Constant(sign * own.cylinder));
    for (const auto& edge : own.edge) {
      Bounds& box = bounds[1].emplace_back();
      for (const int k : edge) box.add(x[static_cast<std::size_t>(k)]);
    }
    for (const auto& face : own.face) {
      Bounds& box = bounds[2].emplace_back();
      for (const int k : face) box.add(x[static_cast<std::size_t>(k)]);
    }
  }

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

  ContactFeature feature(int kind, std::size_t i) const {
    ContactFeature own;
    own.radius = surface.radius;
    own.deformable = surface.deformable;
    own.count = kind + 1;
    if (kind == 0) {
      own.corner[0] = surface.corner[i];
    } else if (kind == 1) {
      for (std::size_t k = 0; k < 2; ++k)
        own.corner[k] = surface.corner[static_cast<std::size_t>(surface.edge[i][k])];
    } else {
      for (std::size_t k = 0; k < 3; ++k)
        own.corner[k] = surface.corner[static_cast<std::size_t>(corner_of_face(i, k))];
    }
    return own;
  }

  /// True if the corners next to a feature, of which `from` is a point, lie along n (or across it), but for a
  /// slope. Deformable surfaces may bend as they like.
  bool lies_along(const Vec3& n, const Vec3& from, int kind, std::size_t i, double slope) const {
    if (surface.deformable || kind == 2) return true;
    const auto& beside = kind == 0 ? surface.beside_corner[i] : surface.beside_edge[i];
    return std::all_of(beside.begin(), beside.end(), [&](int k) {
      const Vec3 way = x[static_cast<std::size_t>(k)] - from;
      return n.dot(way) >= -slope * way.norm();
    });
  }

  bool within_face(std::size_t i, const Vec3& point, const Vec3& n) const {
    std::vector<Vec3> corners;
    for (const int k : surface.face[i]) corners.push_back(x[static_cast<std::size_t>(k)]);
    return is_within(corners, point, n);
  }

  Vec3 face_normal(std::size_t i) const {
    const auto corner = [&](std::size_t k) { return x[static_cast<std::size_t>(corner_of_face(i, k))]; };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  }
};

}  // namespace pbd::reference
