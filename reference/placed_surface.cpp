#include "placed_surface.h"

#include <cmath>

namespace pbd::reference {

PlacedSurface::PlacedSurface(const Surface& own, const Placement& start, const Placement& at) : surface(own) {
  for (const Corner& corner : own.corner) {
    all.add(x.emplace_back(placed(corner, at)));
    moved = std::max(moved, (x.back() - placed(corner, start)).norm());
    bounds[feature_kind::corner].emplace_back().add(x.back());
  }
  const auto add = [&](int kind, const auto& corners) {
    Bounds& box = bounds[static_cast<std::size_t>(kind)].emplace_back();
    for (const int k : corners) box.add(x[static_cast<std::size_t>(k)]);
  };
  for (const auto& corners : own.edge) add(feature_kind::edge, corners);
  for (const auto& corners : own.face) add(feature_kind::face, corners);
  if (!(own.cylinder > 0)) return;
  const Vec3 reach = own.cylinder * (1 - axis().array().square()).cwiseMax(0).sqrt();
  for (std::size_t end = 0; end < 2; ++end) {
    Bounds& box = bounds[feature_kind::rim].emplace_back();
    for (const double sign : {-1.0, 1.0}) {
      box.add(x[end] + sign * reach);
      all.add(x[end] + sign * reach);
    }
    bounds[feature_kind::face][end] = box;
  }
  bounds[feature_kind::edge] = {all};
}

ContactFeature PlacedSurface::feature(int kind, std::size_t i) const {
  ContactFeature own;
  own.radius = surface.radius;
  own.deformable = surface.deformable;
  own.count = kind == feature_kind::rim ? 1 : kind + 1;
  const auto take = [&](std::size_t k, int corner) {
    own.corner[k] = surface.corner[static_cast<std::size_t>(corner)];
  };
  if (kind == feature_kind::corner || kind == feature_kind::rim) take(0, static_cast<int>(i));
  if (kind == feature_kind::edge) {
    for (std::size_t k = 0; k < 2; ++k) take(k, surface.edge[i][k]);
    own.radius += surface.cylinder;
  }
  if (kind == feature_kind::face)
    for (std::size_t k = 0; k < 3; ++k) take(k, corner_of_face(i, k));
  if (kind == feature_kind::rim) {
    own.rim = surface.cylinder;
    own.axis = (own.corner[0].place - surface.corner[1 - i].place).normalized();
  }
  return own;
}

bool PlacedSurface::lies_along(const Vec3& n, const Vec3& from, int kind, std::size_t i, double slope) const {
  if (surface.deformable || kind == feature_kind::face) return true;
  if (surface.cylinder > 0 && kind != feature_kind::edge) {
    const std::size_t end = kind == feature_kind::rim ? i : (i - 2) / rim_corners;
    const Vec3 inward = (x[end] - from) / surface.cylinder, along = end == 0 ? axis() : Vec3(-axis());
    if (std::abs(n.dot(along.cross(inward))) > slope) return false;
    return n.dot(inward) >= -slope && n.dot(along) >= -slope;
  }
  const auto& beside = kind == feature_kind::corner ? surface.beside_corner[i] : surface.beside_edge[i];
  return std::all_of(beside.begin(), beside.end(), [&](int k) {
    const Vec3 way = x[static_cast<std::size_t>(k)] - from;
    return n.dot(way) >= -slope * way.norm();
  });
}

}  // namespace pbd::reference
