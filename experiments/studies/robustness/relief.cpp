#include "studies/robustness/relief.h"

#include <functional>
#include <set>

#include "mesh.h"
#include "scenes/body_shapes.h"

namespace pbdcheck {

using namespace pbd;

namespace {

/// A block about the origin, its top a grid of cells x cells squares lifted by `height` (m) of node (i, j).
ClosedMesh block(int cells, const Vec3& size, const std::function<double(int, int)>& height) {
  const TriangleMesh top =
      grid_sheet({cells, cells}, {size.x(), size.y()}, {-size.x() / 2, -size.y() / 2, size.z() / 2});
  const auto count = static_cast<int>(top.x.cols());
  TriangleMesh closed{Points(3, 2 * count), top.triangles};
  closed.x << top.x, top.x;
  closed.x.rightCols(count).row(2).setConstant(-size.z() / 2);
  for (int node = 0; node < count; ++node)
    closed.x(2, node) += height(node % (cells + 1), node / (cells + 1));
  std::set<std::array<int, 2>> passed;
  for (const auto& [a, b, c] : top.triangles) {
    closed.triangles.push_back({count + a, count + c, count + b});
    passed.insert({{a, b}, {b, c}, {c, a}});
  }
  for (const auto& [a, b] : passed)
    if (!passed.contains({b, a})) {
      closed.triangles.push_back({b, a, count + a});
      closed.triangles.push_back({b, count + a, count + b});
    }
  return ClosedMesh(std::move(closed));
}

}  // namespace

ClosedMesh plate(int cells, const Vec3& size) {
  return block(cells, size, [](int, int) { return 0.0; });
}

ClosedMesh with_relief(bool along, double sign) {
  constexpr int cells = 4;
  return block(cells, Vec3::Ones(), [=](int i, int j) {
    return i == cells / 2 && (along || j == cells / 2) ? sign * relief : 0.0;
  });
}

ConvexHull pointed(bool wedge, double depth) {
  Points x(3, wedge ? 6 : 5);
  x.leftCols(4) << -0.1, 0.1, 0.1, -0.1, -0.1, -0.1, 0.1, 0.1, 0, 0, 0, 0;
  x.row(2).setConstant(depth / 3);
  x.col(4) = Vec3(0, wedge ? -0.1 : 0, -2 * depth / 3);
  if (wedge) x.col(5) = Vec3(0, 0.1, -2 * depth / 3);
  return ConvexHull(convex_hull(x));
}

}  // namespace pbdcheck
