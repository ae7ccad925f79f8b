#include "between_surfaces.h"

#include <cmath>

#include "cylinder_features.h"
#include "passing.h"

namespace pbd::reference {
namespace {

constexpr double flat = 1e-6;  // rad: what rim_corners miss of a rim's depth is less than a tenth of that
constexpr double side_by_side = 1e-3;  // of an edge

const Vec3& end_of(const PlacedSurface& own, std::size_t edge, std::size_t which) {
  return own.x[static_cast<std::size_t>(own.surface.edge[edge][which])];
}

/// Whether features of both have a node in common.
bool share_corner(const FeaturePair& pair) {
  for (int i = 0; i < pair.a.count; ++i)
    for (int k = 0; k < pair.b.count; ++k)
      if (pair.a.corner[static_cast<std::size_t>(i)].node == pair.b.corner[static_cast<std::size_t>(k)].node)
        return true;
  return false;
}

/// What all of a surface's points may touch of another, but for what is beside edges and corners.
void all_over_faces(const PlacedSurface& a, const PlacedSurface& b, const Between& both) {
  if (a.surface.plane) return;  // it has none
  if (b.surface.cylinder > 0 && !(a.surface.cylinder > 0)) return corners_beside_cylinder(a, b, both);
  both.points_over_faces(a, feature_kind::corner, b);
  both.points_over_faces(a, feature_kind::rim, b);
}

}  // namespace

FeaturePair Between::pair_of(const PlacedSurface& a, int kind_a, std::size_t i, const PlacedSurface& b,
                             int kind_b, std::size_t k) {
  FeaturePair pair{a.feature(kind_a, i), b.feature(kind_b, k)};
  pair.surface = {a.surface.side, b.surface.side};
  pair.name = {a.surface.side, kind_a, static_cast<int>(i), b.surface.side, kind_b, static_cast<int>(k)};
  return pair;
}

/// Turns the normal so that the gap was positive where the step began, or would have been but for what passed
/// beside the features.
void Between::take_side(FeaturePair& pair) const {
  const double radii = pair.a.radius + pair.b.radius;
  const bool beside = pair.a.rim == 0 && passes_beside(pair, start, at);
  if ((nearest(pair, start).gap + radii < 0) != beside) pair.side = -pair.side;
}

/// Whether a pair of features parts surfaces about as soon as any does.
bool Between::leads_out(const FeaturePair& pair, const Vec3& normal) const {
  constexpr double same = 0.9;  // cosine: half a radian
  const double sign = pair.surface[0] < pair.surface[1] ? 1 : -1;
  return ways_out != nullptr && std::any_of(ways_out->begin(), ways_out->end(),
                                            [&](const Vec3& way) { return sign * way.dot(normal) > same; });
}

void Between::add_if(const FeaturePair& pair, double deepest) const {
  const Nearest found_at = nearest(pair, at);
  const double gap = found_at.gap;
  if (gap > reach() || gap < -deepest - moved) return;
  if (gap >= -deepest || leads_out(pair, found_at.normal) || nearest(pair, start).gap >= -deepest)
    found.push_back(pair);
}

/// True of a point that was below a rigid face's plane, but not below the face: it has slid down a side. Not
/// of one that lay in the plane: it has slid over the face.
bool Between::came_from_beside(const FeaturePair& pair, const Surface& of_face, std::size_t k) const {
  if (of_face.deformable || of_face.plane) return false;
  std::vector<Vec3> corners;
  for (const int corner : of_face.face[k])
    corners.push_back(placed(of_face.corner[static_cast<std::size_t>(corner)], start));
  const Nearest begun = nearest(pair, start);
  const double below = -(begun.gap + pair.a.radius + pair.b.radius);
  const double side = of_face.cylinder > 0 ? of_face.cylinder : (corners[1] - corners[0]).norm();
  if (below <= beyond * side) return false;
  return !is_within(of_face, corners, begun.on_a, begun.normal);
}

/// True of a sharp corner that is below a face's plane beside it: it is beside the shape, too.
bool Between::below_beside(const PlacedSurface& a, const PlacedSurface& b, std::size_t k,
                           const Nearest& found_at) const {
  constexpr double rounding = 1e-9;  // of the sides
  if (b.surface.plane || b.surface.deformable || a.surface.radius + b.surface.radius > 0) return false;
  return found_at.gap < -rounding * b.size() && !b.within_face(k, found_at.on_a, b.face_normal(k), rounding);
}

void Between::points_over_faces(const PlacedSurface& a, int kind, const PlacedSurface& b) const {
  struct Over {
    std::size_t point;
    Vec3 normal;
    double height;
  };
  std::vector<Over> over;  // rigid faces
  each_near(a, kind, b, feature_kind::face, [&](std::size_t i, std::size_t k) {
    if (kind == feature_kind::corner && a.surface.cylinder > 0 && i < 2) return;  // the middle of a cap
    if (kind == feature_kind::rim && !(a.axis().cross(b.face_normal(k)).norm() > flat)) return;
    FeaturePair pair = pair_of(a, kind, i, b, feature_kind::face, k);
    if (b.surface.deformable) {
      if (a.surface.deformable && share_corner(pair)) return;
      take_side(pair);
    }
    const Nearest found_at = nearest(pair, at);
    const Vec3 &n = found_at.normal, &x = found_at.on_a;
    if (!b.surface.plane && !b.within_face(k, x, b.face_normal(k))) return;
    if (below_beside(a, b, k, found_at)) return;
    // On the side that two triangles in one plane share it is over one of them.
    const double height = n.dot(x - b.x[static_cast<std::size_t>(b.surface.face[k][0])]);
    const auto same = [&](const Over& one) {
      return one.point == i && (one.normal - n).norm() < in_one_plane &&
             std::abs(one.height - height) < in_one_plane * b.size();
    };
    if (std::any_of(over.begin(), over.end(), same)) return;
    if (!b.surface.plane && !a.lies_along(n, x, kind, i, leaning)) return;
    if (came_from_beside(pair, b.surface, k) && !leads_out(pair, n)) return;
    if (!b.surface.deformable) over.push_back({i, n, height});
    add_if(pair, b.surface.plane ? infinity : depth);
  });
}

void Between::edges_across_edges(const PlacedSurface& a, const PlacedSurface& b) const {
  each_near(a, feature_kind::edge, b, feature_kind::edge, [&](std::size_t i, std::size_t k) {
    FeaturePair pair = pair_of(a, feature_kind::edge, i, b, feature_kind::edge, k);
    const bool both_deformable = a.surface.deformable && b.surface.deformable;
    if (both_deformable && (share_corner(pair) || (&a == &b && i > k))) return;
    const Nearest found_at = nearest(pair, at);
    if (!(found_at.crossing > parallel)) return;
    for (const auto& weight : found_at.weight)
      if (!(weight[0] >= 0 && weight[1] >= 0)) return;
    if (both_deformable) {
      take_side(pair);
      return add_if(pair, depth);
    }
    for (const double side : {1.0, -1.0}) {
      pair.side = side;
      const Vec3 n = side * found_at.normal;
      if (a.lies_along(n, end_of(a, i, 0), feature_kind::edge, i, leaning) &&
          b.lies_along(-n, end_of(b, k, 0), feature_kind::edge, k, leaning))
        add_if(pair, depth);
    }
  });
}

void Between::corners_beside(const PlacedSurface& a, const PlacedSurface& b, int kind) const {
  const bool both_deformable = a.surface.deformable && b.surface.deformable;
  const double beside = both_deformable ? side_by_side : 0;
  each_near(a, feature_kind::corner, b, kind, [&](std::size_t i, std::size_t k) {
    const FeaturePair pair = pair_of(a, feature_kind::corner, i, b, kind, k);
    const bool corners = kind == feature_kind::corner;
    if (both_deformable && (share_corner(pair) || (corners && &a == &b && i > k))) return;
    const Nearest found_at = nearest(pair, at);
    const auto& along = found_at.weight[1];
    if (!found_at.normal.allFinite() || !(along[0] >= -beside && along[1] >= -beside)) return;
    constexpr double rounding = 1e-6;
    const Vec3& first = corners ? b.x[k] : end_of(b, k, 0);
    if (a.lies_along(found_at.normal, a.x[i], feature_kind::corner, i, rounding) &&
        b.lies_along(-found_at.normal, first, kind, k, rounding))
      add_if(pair, pair.a.radius + pair.b.radius);
  });
}

void find_between(const PlacedSurface& a, const PlacedSurface& b, const Between& both) {
  const double radii = a.surface.radius + b.surface.radius;
  const bool planes = a.surface.plane || b.surface.plane;
  if (!planes && !a.all.near(b.all, both.reach() + radii)) return;
  const bool same = &a == &b;
  all_over_faces(a, b, both);
  if (!same) all_over_faces(b, a, both);
  if (planes) return;
  both.edges_across_edges(a, b);
  if (a.surface.cylinder > 0 || b.surface.cylinder > 0) return rims_across(a, b, both);
  if (!(radii > 0)) return;
  for (const int kind : {feature_kind::edge, feature_kind::corner}) {
    both.corners_beside(a, b, kind);
    if (!same && kind == feature_kind::edge) both.corners_beside(b, a, kind);
  }
}

}  // namespace pbd::reference
