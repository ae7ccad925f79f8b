#include "feature_search.h"

#include <algorithm>
#include <cmath>

#include "touching_sides.h"

namespace pbd::reference {
namespace {

constexpr double leaning = 0.2, parallel = 1e-3;  // rad
constexpr double beyond = 1e-4;                   // of a face's side

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

/// A surface where it stands: its corners, features and the boxes about them.
struct Placed {
  const Surface& surface;
  std::vector<Vec3> x;
  Bounds all;
  double moved = 0;  // m, since the start
  /// 0 corners, 1 edges, 2 faces.
  std::array<std::vector<Bounds>, 3> bounds;

  Placed(const Surface& own, const Placement& start, const Placement& at) : surface(own) {
    for (const Corner& corner : own.corner) {
      all.add(x.emplace_back(placed(corner, at)));
      moved = std::max(moved, (x.back() - placed(corner, start)).norm());
      bounds[0].emplace_back().add(x.back());
    }
    for (const auto& edge : own.edge) {
      Bounds& box = bounds[1].emplace_back();
      for (const int k : edge) box.add(x[static_cast<std::size_t>(k)]);
    }
    for (const auto& face : own.face) {
      Bounds& box = bounds[2].emplace_back();
      for (const int k : face) box.add(x[static_cast<std::size_t>(k)]);
    }
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
      const auto& face = surface.face[i];
      for (std::size_t k = 0; k < 3; ++k)  // far from each other
        own.corner[k] = surface.corner[static_cast<std::size_t>(face[k * face.size() / 3])];
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
    const auto& face = surface.face[i];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vec3& from = x[static_cast<std::size_t>(face[k])];
      const Vec3 side = x[static_cast<std::size_t>(face[(k + 1) % face.size()])] - from;
      if (side.cross(point - from).dot(n) < -beyond * side.squaredNorm()) return false;
    }
    return true;
  }

  Vec3 face_normal(std::size_t i) const {
    const auto& face = surface.face[i];
    const Vec3& first = x[static_cast<std::size_t>(face[0])];
    const auto corner = [&](std::size_t k) { return x[static_cast<std::size_t>(face[k * face.size() / 3])]; };
    return (corner(1) - first).cross(corner(2) - first).normalized();
  }
};

/// The features of two surfaces.
struct Between {
  const Placement& start;
  const Placement& at;
  std::vector<FeaturePair>& found;
  double moved = 0;  // m, by both since the start

  /// f(i, k) for the features of both that are near.
  template <class F>
  static void each_near(const Placed& a, int kind_a, const Placed& b, int kind_b, double reach, F&& f) {
    const auto near_all = [&](const Placed& own, int kind, const Placed& other) {
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

  static FeaturePair pair_of(const Placed& a, int kind_a, std::size_t i, const Placed& b, int kind_b,
                             std::size_t k) {
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

  void corners_over_faces(const Placed& a, const Placed& b, double reach, double depth) {
    if (a.surface.plane) return;  // it has none
    each_near(a, 0, b, 2, reach, [&](std::size_t i, std::size_t k) {
      const Vec3 n = b.face_normal(k);
      if (!b.surface.plane && !b.within_face(k, a.x[i], n)) return;
      FeaturePair pair = pair_of(a, 0, i, b, 2, k);
      if (b.surface.deformable) {
        if (a.surface.deformable && share_corner(pair)) return;
        take_side_of_start(pair);
      }
      if (!b.surface.plane && !a.lies_along(pair.side * n, a.x[i], 0, i, leaning)) return;
      add_if(pair, reach, b.surface.plane ? infinity : depth);
    });
  }

  void edges_across_edges(const Placed& a, const Placed& b, double reach, double depth) {
    each_near(a, 1, b, 1, reach, [&](std::size_t i, std::size_t k) {
      const auto end = [](const Placed& own, std::size_t edge, std::size_t which) -> const Vec3& {
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
  void corners_beside(const Placed& a, const Placed& b, int kind, double reach) {
    each_near(a, 0, b, kind, reach, [&](std::size_t i, std::size_t k) {
      const FeaturePair pair = pair_of(a, 0, i, b, kind, k);
      const Nearest found_at = nearest(pair, at);
      if (!found_at.normal.allFinite() || !(found_at.weight[1][0] >= 0 && found_at.weight[1][1] >= 0)) return;
      constexpr double rounding = 1e-6;
      const auto& first = kind == 1 ? b.x[static_cast<std::size_t>(b.surface.edge[k][0])] : b.x[k];
      if (a.lies_along(found_at.normal, a.x[i], 0, i, rounding) &&
          b.lies_along(-found_at.normal, first, kind, k, rounding))
        add_if(pair, reach, pair.a.radius + pair.b.radius);
    });
  }

  void find(const Placed& a, const Placed& b, double depth) {
    const double radii = a.surface.radius + b.surface.radius;
    moved = a.moved + b.moved;
    const double reach = moved + depth + radii;
    if (!a.surface.plane && !b.surface.plane && !a.all.near(b.all, reach)) return;
    const bool same = &a == &b;
    corners_over_faces(a, b, reach, depth);
    if (!same) corners_over_faces(b, a, reach, depth);
    if (a.surface.plane || b.surface.plane) return;
    edges_across_edges(a, b, reach, depth);
    if (!(radii > 0) || (a.surface.deformable && b.surface.deformable)) return;
    corners_beside(a, b, 1, reach);
    corners_beside(b, a, 1, reach);
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
      if (i == k || nodes || (a.plane && b.plane)) continue;
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
}

void FeatureSearch::find(const Placement& start, const Placement& at, std::vector<FeaturePair>& found) const {
  std::vector<Placed> placed;
  placed.reserve(surfaces_.size());
  Bounds all;
  for (const Surface& surface : surfaces_) {
    placed.emplace_back(surface, start, at);
    for (const Vec3& x : placed.back().x) all.add(x);
  }
  const double extent = (all.most - all.least).norm() / 20;
  for (const auto& [i, k] : pairs_) {
    const Placed &a = placed[i], &b = placed[k];
    Between{start, at, found}.find(a, b, std::min({a.size(), b.size(), extent}) / 50);
  }
}

}  // namespace pbd::reference
