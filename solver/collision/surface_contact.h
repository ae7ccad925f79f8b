// Contact of deformable surfaces: a node against a triangle, or an edge against an edge. With weights w that
// sum to zero, one a node, gap = n . sum_k w_k x_k - thickness, and its derivative by x_k is w_k n^T:
//   node 0 against triangle 1 2 3   n = +- (x2 - x1) x (x3 - x1) normalised, w = (1, -b1, -b2, -b3), b the
//                                   barycentric coordinates of x0's projection
//   edge 0 1 against edge 2 3       n = +- (x1 - x0) x (x3 - x2) normalised, w = (1 - s, s, t - 1, -t) of the
//                                   nearest points of the two lines
// The sign keeps the side on which the step begins.
#pragma once

#include <array>
#include <vector>

#include "box_tree.h"
#include "geometry.h"

namespace pbd {

struct SurfaceContact {
  std::array<int, 4> node{};
  bool edges = false;
  double side = 1;
  double thickness = 0;  // m, at which surfaces touch
};

struct SurfaceTouching {
  double gap = 0;  // m
  Vec3 normal = Vec3::UnitZ();
  Eigen::Vector4d weight = Eigen::Vector4d::Zero();
  Vec3 point = Vec3::Zero();  // m, of the side with positive weights
};

SurfaceTouching touching(const SurfaceContact& contact, const Points& x);

/// Finds what may touch; keeps triangles' edges and scratch from step to step.
class SurfaceSearch {
 public:
  explicit SurfaceSearch(const std::vector<std::array<int, 3>>& triangles);

  const std::vector<int>& nodes() const { return nodes_; }

  /// Appends node-triangle and edge-edge pairs without a common node whose gap at x is below what their nodes
  /// move by together (`reach`, m, one a node of the scene), and whose nearest points lie on them. Edges that
  /// are parallel are left to their nodes.
  void find(const Points& x, const std::vector<double>& reach, double thickness,
            std::vector<SurfaceContact>& out);

 private:
  void find_nodes(const Points& x, const std::vector<double>& reach, double thickness,
                  std::vector<SurfaceContact>& out);
  void find_edges(const Points& x, const std::vector<double>& reach, double thickness,
                  std::vector<SurfaceContact>& out);

  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<int> nodes_;
  std::vector<AxisBox> boxes_;
  BoxTree tree_;
};

}  // namespace pbd
