#include "surface_depth.h"

#include <algorithm>

#include "box_tree.h"
#include "mesh_points.h"

namespace pbd::reference {
namespace {

using Pair = SurfaceOverlap::Kind;

bool has(const std::array<int, 3>& triangle, int node) {
  return std::find(triangle.begin(), triangle.end(), node) != triangle.end();
}

std::size_t count_of(Pair kind) {
  if (kind == Pair::through) return 5;
  return kind == Pair::node_edge ? 3 : 4;
}

/// m, of the lines' nearest points; infinite where these are not both on the segments.
double distance_across(const Segment& a, const Segment& b) {
  const Vec3 along_a = a.to - a.from, along_b = b.to - b.from, apart = b.from - a.from;
  const Vec3 across = along_a.cross(along_b);
  const double squared = across.squaredNorm();
  if (!(squared > 0)) return infinity;
  const double s = apart.cross(along_b).dot(across) / squared, t = apart.cross(along_a).dot(across) / squared;
  const bool on_both = s >= 0 && s <= 1 && t >= 0 && t <= 1;
  return on_both ? std::abs(across.dot(apart)) / std::sqrt(squared) : infinity;
}

double distance_of_segments(const Segment& a, const Segment& b) {
  double least = distance_across(a, b);
  for (const Vec3& x : {a.from, a.to}) least = std::min(least, distance_of_segment(x, b));
  for (const Vec3& x : {b.from, b.to}) least = std::min(least, distance_of_segment(x, a));
  return least;
}

/// m, by which an edge has to move at least to go no longer through the triangle: an end to the plane, or all
/// of it to a side. Negative where it does not go through by more than rounding, as what lies in one plane.
double way_out(const Segment& edge, const std::array<Vec3, 3>& corner) {
  constexpr double rounding = 1e-12;  // of a coordinate
  if (!(crossing(edge, corner) < 1)) return -infinity;
  const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  double least = infinity, size = 0;
  for (const Vec3& x : {edge.from, edge.to}) {
    least = std::min(least, std::abs(normal.dot(x - corner[0])));
    size = std::max(size, x.cwiseAbs().maxCoeff());
  }
  for (std::size_t k = 0; k < 3; ++k)
    least = std::min(least, distance_of_segments(edge, {corner[k], corner[(k + 1) % 3]}));
  return least > rounding * size ? least : -infinity;
}

class Overlaps {
 public:
  Overlaps(std::span<const std::array<int, 3>> triangles, const Points& x, double thickness, double floor)
      : triangles_(triangles), x_(x), thickness_(thickness), floor_(floor) {
    for (const auto& [a, b, c] : triangles)
      for (const auto& [p, q] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
        edges_.push_back({std::min(p, q), std::max(p, q)});
        nodes_.push_back({p});
      }
    sort_once(nodes_);
    sort_once(edges_);
  }

  std::vector<SurfaceOverlap> find() {
    each_pair(nodes_, triangles_, Pair::node_triangle, [&](const auto& at) {
      return is_over(at(0), {at(1), at(2), at(3)});
    });
    each_pair(edges_, edges_, Pair::edges, [&](const auto& at) {
      return distance_across({at(0), at(1)}, {at(2), at(3)}) < infinity;
    });
    each_pair(nodes_, edges_, Pair::node_edge, [](const auto&) { return true; });
    std::erase_if(found_, [&](const SurfaceOverlap& found) {
      return found.kind == Pair::node_edge && triangle_is_nearer(found);
    });
    each_pair(edges_, triangles_, Pair::through, [](const auto&) { return true; });
    for (SurfaceOverlap& found : found_)
      found.crease = found.kind == Pair::node_edge &&
                     (joined(found.node[0], found.node[1]) || joined(found.node[0], found.node[2]));
    return std::move(found_);
  }

 private:
  template <class T>
  static void sort_once(std::vector<T>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  /// True where the surface comes nearer to a node than by an edge, or to that place of the edge than by the
  /// node: by a triangle of the edge, or of the end that is nearest, or of the node.
  bool triangle_is_nearer(const SurfaceOverlap& found) const {
    constexpr double rounding = 1e-9;
    const int node = found.node[0], from = found.node[1], to = found.node[2];
    const Vec3 x = x_.col(node), first = x_.col(from), along = x_.col(to) - first;
    const double share = std::clamp((x - first).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vec3 nearest = first + share * along;
    const double to_edge = (x - nearest).norm(), nearer = (1 - rounding) * to_edge;
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const std::array<int, 3>& triangle) {
      const auto corner = [&](std::size_t k) -> Vec3 { return x_.col(triangle[k]); };
      const auto distance = [&](const Vec3& of) {
        return distance_of_triangle(of, {corner(0), corner(1), corner(2)});
      };
      if (has(triangle, node))
        return !has(triangle, from) && !has(triangle, to) && distance(nearest) < nearer;
      const bool about =
          (has(triangle, from) || share > 1 - rounding) && (has(triangle, to) || share < rounding);
      return about && distance(x) < nearer;
    });
  }

  bool joined(int a, int b) const {
    return std::binary_search(edges_.begin(), edges_.end(), std::array{std::min(a, b), std::max(a, b)});
  }

  template <class Nodes>
  AxisBox about(const Nodes& nodes) const {
    AxisBox box;
    for (const int node : nodes) box.extend(Vec3(x_.col(node)));
    const Vec3 reach = Vec3::Constant(thickness_ / 2);
    return {box.min() - reach, box.max() + reach};
  }

  /// Adds the pairs of two lists of features, by their nodes, that `meet` and are deep.
  template <class First, class Second, class Meet>
  void each_pair(const First& first, const Second& second, Pair kind, Meet meet) {
    std::vector<AxisBox> boxes;
    for (const auto& nodes : second) boxes.push_back(about(nodes));
    BoxTree tree;
    tree.build(boxes);
    for (const auto& one : first)
      tree.find(about(one), [&](int k) {
        const auto& other = second[static_cast<std::size_t>(k)];
        SurfaceOverlap pair{kind};
        std::copy(other.begin(), other.end(), std::copy(one.begin(), one.end(), pair.node.begin()));
        if (kind == Pair::edges && pair.node[0] >= pair.node[2]) return;
        auto nodes = pair.node;
        const auto end = nodes.begin() + static_cast<std::ptrdiff_t>(count_of(kind));
        std::sort(nodes.begin(), end);
        if (std::adjacent_find(nodes.begin(), end) != end) return;
        if (!meet([&](std::size_t i) -> Vec3 { return x_.col(pair.node[i]); })) return;
        pair.depth = depth_of(pair, x_, thickness_);
        if (pair.depth > floor_) found_.push_back(pair);
      });
  }

  std::span<const std::array<int, 3>> triangles_;
  const Points& x_;
  double thickness_, floor_;  // m
  std::vector<std::array<int, 1>> nodes_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<SurfaceOverlap> found_;
};

}  // namespace

std::string SurfaceOverlap::name() const {
  std::string name = kind == Pair::node_triangle ? "node and triangle"
                     : kind == Pair::edges       ? "edges"
                     : kind == Pair::node_edge   ? "node and edge"
                                                 : "edge through triangle";
  for (std::size_t k = 0; k < count_of(kind); ++k)
    name += (k > 0 ? ", " : " of nodes ") + std::to_string(node[k]);
  return name;
}

double depth_of(const SurfaceOverlap& overlap, const Points& x, double thickness) {
  const auto at = [&](std::size_t k) -> Vec3 { return x.col(overlap.node[k]); };
  switch (overlap.kind) {
    case Pair::node_triangle:
      return thickness - distance_of_triangle(at(0), {at(1), at(2), at(3)});
    case Pair::edges:
      return thickness - distance_of_segments({at(0), at(1)}, {at(2), at(3)});
    case Pair::node_edge:
      return thickness - distance_of_segment(at(0), {at(1), at(2)});
    case Pair::through:
      break;
  }
  return thickness + way_out({at(0), at(1)}, {at(2), at(3), at(4)});
}

std::vector<SurfaceOverlap> surface_overlaps(std::span<const std::array<int, 3>> triangles, const Points& x,
                                             double thickness, double floor) {
  return Overlaps(triangles, x, thickness, floor).find();
}

}  // namespace pbd::reference
