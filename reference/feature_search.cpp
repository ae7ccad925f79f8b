#include "feature_search.h"

#include <algorithm>
#include <cmath>

#include "cylinder_features.h"
#include "placed_surface.h"
#include "touching_sides.h"

namespace pbd::reference {
namespace {

constexpr double leaning = 0.2, parallel = 1e-3;  // rad
constexpr double side_by_side = 1e-3;             // of an edge

/// The features of two surfaces.
struct Between {
  const Placement& start;
  const Placement& at;
  std::vector<FeaturePair>& found;
  double moved = 0;  // m, by both since the start

  /// f(i, k) for the features of both that are near.
  template <class F>
  static void each_near(const PlacedSurface& a, int kind_a, const PlacedSurface& b, int kind_b, double reach,
                        F&& f) {
    const auto near_all = [&](const PlacedSurface& own, int kind, const PlacedSurface& other) {
      std::vector<std::size_t> list;
      const auto& boxes = own.bounds[static_cast<std::size_t>(kind)];
      for (std::size_t i = 0; i < boxes.size(); ++i)
        if (other.surface.plane || own.surface.plane || boxes[i].near(other.all, reach)) list.push_back(i);
      return list;
    };
    const auto list_b = near_all(b, kind_b, a);
    for (const std::size_t i : near_all(a, kind_a, b))
      for (const std::size_t k : list_b)
        if (b.surface.plane || a.bounds[static_cast<std::size_t>(kind_a)][i].near(
                                   b.bounds[static_cast<std::size_t>(kind_b)][k], reach))
          f(i, k);
  }

  static bool share_corner(const FeaturePair& pair) {
    for (int i = 0; i < pair.a.count; ++i)
      for (int k = 0; k < pair.b.count; ++k)
        if (pair.a.corner[static_cast<std::size_t>(i)].node ==
            pair.b.corner[static_cast<std::size_t>(k)].node)
          return true;
    return false;
  }

  static FeaturePair pair_of(const PlacedSurface& a, int kind_a, std::size_t i, const PlacedSurface& b,
                             int kind_b, std::size_t k) {
    FeaturePair pair{a.feature(kind_a, i), b.feature(kind_b, k)};
    pair.surface = {a.surface.side, b.surface.side};
    pair.name = {a.surface.side, kind_a, static_cast<int>(i), b.surface.side, kind_b, static_cast<int>(k)};
    return pair;
  }

  /// Turns the normal so that the gap was positive where the step began.
  void take_side_of_start(FeaturePair& pair) const {
    const double radii = pair.a.radius + pair.b.radius;
    if (nearest(pair, start).gap + radii < 0) pair.side = -pair.side;
  }

  /// What is deeper than `depth` counts if it has come so deep since the start.
  void add_if(const FeaturePair& pair, double reach, double depth) {
    const double gap = nearest(pair, at).gap;
    if (gap + pair.a.radius + pair.b.radius > reach || gap < -depth - moved) return;
    if (gap >= -depth || nearest(pair, start).gap >= -depth) found.push_back(pair);
  }

  /// True of a corner that was below a rigid face's plane, but not below the face: it has slid down a side.
  bool came_from_beside(const FeaturePair& pair, const Surface& of_face, std::size_t k) const {
    if (of_face.deformable || of_face.plane) return false;
    std::vector<Vec3> corners;
    for (const int corner : of_face.face[k])
      corners.push_back(placed(of_face.corner[static_cast<std::size_t>(corner)], start));
    const Nearest begun = nearest(pair, start);
    if (begun.gap + pair.a.radius + pair.b.radius >= 0) return false;
    return !is_within(corners, placed(pair.a.corner[0], start), begun.normal);
  }

  void corners_over_faces(const PlacedSurface& a, const PlacedSurface& b, double reach, double depth) {
    if (a.surface.plane) return;  // it has none
    struct Over {
      std::size_t corner;
      Vec3 normal;
      double height;
    };
    std::vector<Over> over;  // rigid faces
    each_near(a, 0, b, 2, reach, [&](std::size_t i, std::size_t k) {
      const Vec3 n = b.face_normal(k);
      if (!b.surface.plane && !b.within_face(k, a.x[i], n)) return;
      // On the side that two triangles in one plane share it is over one of them.
      const double height = n.dot(a.x[i] - b.x[static_cast<std::size_t>(b.surface.face[k][0])]);
      const auto same = [&](const Over& one) {
        return one.corner == i && (one.normal - n).norm() < in_one_plane &&
               std::abs(one.height - height) < in_one_plane * b.size();
      };
      if (std::any_of(over.begin(), over.end(), same)) return;
      FeaturePair pair = pair_of(a, 0, i, b, 2, k);
      if (b.surface.deformable) {
        if (a.surface.deformable && share_corner(pair)) return;
        take_side_of_start(pair);
      }
      if (!b.surface.plane && !a.lies_along(pair.side * n, a.x[i], 0, i, leaning)) return;
      if (came_from_beside(pair, b.surface, k)) return;
      if (!b.surface.deformable) over.push_back({i, n, height});
      add_if(pair, reach, b.surface.plane ? infinity : depth);
    });
  }

  void edges_across_edges(const PlacedSurface& a, const PlacedSurface& b, double reach, double depth) {
    each_near(a, 1, b, 1, reach, [&](std::size_t i, std::size_t k) {
      const auto end = [](const PlacedSurface& own, std::size_t edge, std::size_t which) -> const Vec3& {
        return own.x[static_cast<std::size_t>(own.surface.edge[edge][which])];
      };
      const Vec3 u = end(a, i, 1) - end(a, i, 0), v = end(b, k, 1) - end(b, k, 0);
      if (!(u.cross(v).norm() > parallel * u.norm() * v.norm())) return;
      FeaturePair pair = pair_of(a, 1, i, b, 1, k);
      const bool both_deformable = a.surface.deformable && b.surface.deformable;
      if (both_deformable && (share_corner(pair) || (&a == &b && i > k))) return;
      const Nearest found_at = nearest(pair, at);
      for (const auto& weight : found_at.weight)
        if (!(weight[0] >= 0 && weight[1] >= 0)) return;
      if (both_deformable) {
        take_side_of_start(pair);
        return add_if(pair, reach, depth);
      }
      for (const double side : {1.0, -1.0}) {
        pair.side = side;
        const Vec3 n = side * found_at.normal;
        if (a.lies_along(n, end(a, i, 0), 1, i, leaning) && b.lies_along(-n, end(b, k, 0), 1, k, leaning))
          add_if(pair, reach, depth);
      }
    });
  }

  /// Corners beside edges (kind 1) or corners (0), n being the way between them.
  void corners_beside(const PlacedSurface& a, const PlacedSurface& b, int kind, double reach) {
    const bool both_deformable = a.surface.deformable && b.surface.deformable;
    const double beside = both_deformable ? side_by_side : 0;
    each_near(a, 0, b, kind, reach, [&](std::size_t i, std::size_t k) {
      const FeaturePair pair = pair_of(a, 0, i, b, kind, k);
      if (both_deformable && (share_corner(pair) || (kind == 0 && &a == &b && i > k))) return;
      const Nearest found_at = nearest(pair, at);
      const auto& along = found_at.weight[1];
      if (!found_at.normal.allFinite() || !(along[0] >= -beside && along[1] >= -beside)) return;
      constexpr double rounding = 1e-6;
      const auto& first = kind == 1 ? b.x[static_cast<std::size_t>(b.surface.edge[k][0])] : b.x[k];
      if (a.lies_along(found_at.normal, a.x[i], 0, i, rounding) &&
          b.lies_along(-found_at.normal, first, kind, k, rounding))
        add_if(pair, reach, pair.a.radius + pair.b.radius);
    });
  }

  void find(const PlacedSurface& a, const PlacedSurface& b, double depth) {
    const double radii = a.surface.radius + b.surface.radius;
    moved = a.moved + b.moved;
    const double reach = moved + depth + radii;
    if (!a.surface.plane && !b.surface.plane && !a.all.near(b.all, reach)) return;
    if (a.surface.cylinder > 0) return find_beside_cylinder({start, at, b, a, moved, depth}, found);
    if (b.surface.cylinder > 0) return find_beside_cylinder({start, at, a, b, moved, depth}, found);
    const bool same = &a == &b;
    corners_over_faces(a, b, reach, depth);
    if (!same) corners_over_faces(b, a, reach, depth);
    if (a.surface.plane || b.surface.plane) return;
    edges_across_edges(a, b, reach, depth);
    if (!(radii > 0)) return;
    corners_beside(a, b, 1, reach);
    if (!same) corners_beside(b, a, 1, reach);
    corners_beside(a, b, 0, reach);
  }
};

}  // namespace

FeatureSearch::FeatureSearch(const Scene& scene, const Contact& contact)
    : surfaces_(surfaces_of(scene, contact)) {
  const auto side_of = [](const Surface& surface) {
    return Side{surface.corner.front().body, surface.corner.front().node};
  };
  const auto fixed = [&](const Surface& surface) {
    if (surface.deformable) return false;
    const Corner& corner = surface.corner.front();
    const bool turns =
        corner.body >= 0 && scene.bodies[static_cast<std::size_t>(corner.body)].inertia.allFinite();
    return std::isinf(scene.mass[static_cast<std::size_t>(corner.node)]) && !turns;
  };
  const std::size_t count = surfaces_.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i; k < count; ++k) {
      const Surface &a = surfaces_[i], &b = surfaces_[k];
      if (a.corner.empty() || b.corner.empty() || (fixed(a) && fixed(b))) continue;
      if (a.deformable && b.deformable) {
        if (contact.surfaces_touch) pairs_.push_back({i, k});
        continue;
      }
      const bool nodes = a.corner.front().body < 0 && b.corner.front().body < 0;
      const bool apart = nodes && (!contact.nodes_touch || b.deformable);
      if (i == k || apart || (a.plane && b.plane)) continue;
      if (!b.deformable) {
        if (may_touch(scene, contact, side_of(a), side_of(b))) pairs_.push_back({i, k});
        continue;
      }
      std::vector<std::array<int, 3>> free;  // triangles with no node attached to the body
      for (const auto& triangle : contact.triangle)
        if (std::all_of(triangle.begin(), triangle.end(), [&](int node) {
              return may_touch(scene, contact, side_of(a), Side{-1, node});
            }))
          free.push_back(triangle);
      if (free.size() == contact.triangle.size()) {
        pairs_.push_back({i, k});
      } else if (!free.empty()) {
        pairs_.push_back({i, surfaces_.size()});
        surfaces_.push_back(surface_of(free, b.radius, b.side));
      }
    }
  for (const auto& [i, k] : pairs_) require_beside_cylinder(surfaces_[i], surfaces_[k]);
}

void FeatureSearch::find(const Placement& start, const Placement& at, std::vector<FeaturePair>& found) const {
  std::vector<PlacedSurface> placed;
  placed.reserve(surfaces_.size());
  Bounds all;
  for (const Surface& surface : surfaces_) {
    placed.emplace_back(surface, start, at);
    for (const Vec3& x : placed.back().x) all.add(x);
  }
  const double extent = (all.most - all.least).norm() / 20;
  for (const auto& [i, k] : pairs_) {
    const PlacedSurface &a = placed[i], &b = placed[k];
    Between{start, at, found}.find(a, b, std::min({a.size(), b.size(), extent}) / 50);
  }
}

bool FeatureSearch::on_both(const FeaturePair& pair, const Placement& at) const {
  const Nearest found = nearest(pair, at);
  const auto between_corners = [&](const std::array<double, 3>& weight) {
    return *std::min_element(weight.begin(), weight.end()) >= -beyond;
  };
  if (!between_corners(found.weight[0])) return false;
  if (pair.b.count < 3 || pair.b.deformable) return between_corners(found.weight[1]);
  const auto surface = std::find_if(surfaces_.begin(), surfaces_.end(),
                                    [&](const Surface& own) { return own.side == pair.name[3]; });
  if (surface->plane) return true;
  if (surface->cylinder > 0) return over_cap(*surface, at, placed(pair.a.corner[0], at));
  const PlacedSurface face(*surface, at, at);
  const auto number = static_cast<std::size_t>(pair.name[5]);
  return face.within_face(number, placed(pair.a.corner[0], at), face.face_normal(number));
}

}  // namespace pbd::reference
