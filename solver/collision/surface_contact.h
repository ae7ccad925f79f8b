// Contact of deformable surfaces with each other and with spheres about nodes: a node against a triangle or
// an edge, or an edge against an edge. With weights w that sum to zero, one a node,
// gap = n . sum_k w_k x_k - thickness, and its derivative by x_k is w_k n^T:
//   node 0 against triangle 1 2 3   n = +- (x2 - x1) x (x3 - x1) normalised, w = (1, -b1, -b2, -b3), b the
//                                   barycentric coordinates of x0's projection
//   edge 0 1 against edge 2 3       n = +- (x1 - x0) x (x3 - x2) normalised, w = (1 - s, s, t - 1, -t) of the
//                                   nearest points of the two lines
//   node 0 against edge 2 3         n from the edge's nearest point to x0, w = (1, 0, t - 1, -t); where the
//                                   surface ends or is folded, its triangles away from the node; the nearest
//                                   point may be an end, which is how nodes touch nodes
//   sphere 0 against sphere 2       the same of an edge without length, nodes 2 and 3 being one, w = (1, 0,
//                                   -1, 0), the thickness the sum of their radii
// The sign keeps the side on which the step begins. A node and an edge have none: a node that comes out on
// the other side within one step, by more than the thickness, goes through. What met on the way of a step,
// from beside each other, has n and w of where that was, whatever turns or slides later.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "geometry.h"

namespace pbd {

struct SurfaceContact {
  enum class Kind : std::uint8_t { node_triangle, edge_edge, node_edge };

  std::array<int, 4> node{};  // of a node and an edge the node twice
  Kind kind = Kind::node_triangle;
  double side = 1;
  Vec3 toward = Vec3::Zero();                  // n of what met on the way, and of a node that is on its edge
  double thickness = 0;                        // m, at which they touch
  double radius = 0;                           // m, of a sphere about node 0
  std::optional<std::array<double, 4>> met{};  // w, of what met on the way; n is `toward`

  std::pair<Kind, std::array<int, 4>> features() const { return {kind, node}; }
  bool same_features(const SurfaceContact& other) const { return features() == other.features(); }
  bool of_spheres() const { return kind == Kind::node_edge && node[2] == node[3]; }
};

struct SurfaceTouching {
  double gap = 0;  // m
  Vec3 normal = Vec3::UnitZ();
  Eigen::Vector4d weight = Eigen::Vector4d::Zero();
  Vec3 point = Vec3::Zero();  // m, of the side with positive weights
};

/// m, of a contact's nodes.
using NodePlaces = std::array<Vec3, 4>;

/// Of x, one column a node of the scene.
NodePlaces places(const SurfaceContact& contact, const Points& x);

SurfaceTouching touching(const SurfaceContact& contact, const NodePlaces& x);
SurfaceTouching touching(const SurfaceContact& contact, const Points& x);

/// Of the nearest points of a node and a triangle, of a node and an edge, or of two edges, themselves:
/// without a normal where edges or a node and an edge have a point in common.
SurfaceTouching nearest_touching(const SurfaceContact& contact, const NodePlaces& x);

/// Of the thickness at which features touch: in a step surfaces that overlap part by no more, and what came
/// over each other from beside is not pushed farther along the normal that it has at the end. Where surfaces
/// crumple, what was beside a triangle and near comes over it; to be out of it at once would take energy that
/// nothing has. A tenth takes a hundredth of that.
inline constexpr double parted = 0.1;

/// Of a feature: what lies between two that meet is on both.
inline constexpr double between_features = 1e-9;

/// True of directions that span a plane: their product is more than rounding.
bool crossed(const Vec3& e, const Vec3& f);

/// True if the nearest points lie on the features, or no farther `beside` them than that share of them.
bool on_features(const SurfaceTouching& touching, SurfaceContact::Kind kind, double beside = 0);

}  // namespace pbd
