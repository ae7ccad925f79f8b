#include "mesh_depth.h"

#include <algorithm>
#include <numbers>

#include "mesh_points.h"

namespace pbd::reference {
namespace {

/// What a shape holds about `centre` in its frame, m.
struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// What a ball in the mesh's frame is deep in the mesh; `floor` where it is no deeper.
double depth_of_ball(const ClosedMesh& mesh, const Ball& ball, double floor) {
  if (mesh.box.exteriorDistance(ball.centre) > ball.radius) return floor;
  const double apart = distance_of_mesh(mesh, ball.centre);
  if (ball.radius + apart <= floor) return floor;
  return std::max(floor, ball.radius + (holds(mesh, ball.centre) ? apart : -apart));
}

/// Balls that the shape holds, in its frame.
struct Balls {
  std::vector<Ball> operator()(std::monostate) const { return {}; }
  std::vector<Ball> operator()(const Sphere& shape) const { return {{Vec3::Zero(), shape.radius}}; }
  std::vector<Ball> operator()(const Capsule& shape) const {
    return along(shape.length, [&](double) { return shape.radius; });
  }
  std::vector<Ball> operator()(const Cylinder& shape) const {
    return along(shape.length,
                 [&](double z) { return std::min(shape.radius, shape.length / 2 - std::abs(z)); });
  }
  std::vector<Ball> operator()(const Box& shape) const { return of(box_surface(shape.size)); }
  std::vector<Ball> operator()(const ClosedMesh& shape) const { return of(shape.surface); }
  std::vector<Ball> operator()(const ConvexHull& shape) const { return of(shape.surface); }
  std::vector<Ball> operator()(const HalfSpace&) const { return {}; }

  /// Four to each half of an axis.
  template <class Radius>
  static std::vector<Ball> along(double length, Radius radius) {
    std::vector<Ball> balls;
    for (int k = -4; k <= 4; ++k) balls.push_back({k * length / 8 * Vec3::UnitZ(), radius(k * length / 8)});
    return balls;
  }
  static std::vector<Ball> of(const TriangleMesh& surface) {
    std::vector<Ball> balls;
    for (const auto& node : surface.x.colwise()) balls.push_back({node});
    for (const auto& [i, j, k] : surface.triangles)
      balls.push_back({(surface.x.col(i) + surface.x.col(j) + surface.x.col(k)) / 3});
    return balls;
  }
};

std::vector<Segment> edges_of(const Shape& shape) {
  const auto of = [](const Polyhedron& solid) {
    std::vector<Segment> edges;
    for (const Polyhedron::Edge& edge : solid.edges)
      edges.push_back({solid.x.col(edge.node[0]), solid.x.col(edge.node[1])});
    return edges;
  };
  if (const auto* box = std::get_if<Box>(&shape)) return of(plane_faces(box_surface(box->size)));
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) return of(hull->solid);
  if (const auto* mesh = std::get_if<ClosedMesh>(&shape)) return of(mesh->solid);
  return {};
}

/// What a point in a convex shape's frame is deep in it; not positive where it is not.
struct DepthOfPoint {
  const Vec3& x;

  double operator()(std::monostate) const { return 0; }
  double operator()(const ClosedMesh&) const { return 0; }
  double operator()(const HalfSpace&) const { return 0; }
  double operator()(const Sphere& shape) const { return shape.radius - x.norm(); }
  double operator()(const Box& shape) const { return (shape.size / 2 - x.cwiseAbs()).minCoeff(); }
  double operator()(const Cylinder& shape) const {
    return std::min(shape.radius - x.head<2>().norm(), shape.length / 2 - std::abs(x.z()));
  }
  double operator()(const Capsule& shape) const {
    const double beyond = std::max(0.0, std::abs(x.z()) - shape.length / 2);
    return shape.radius - std::hypot(x.x(), x.y(), beyond);
  }
  double operator()(const ConvexHull& shape) const {
    double least = infinity;
    for (const Polyhedron::Face& face : shape.solid.faces)
      least = std::min(least, face.offset - face.normal.dot(x));
    return least;
  }
};

/// Of a concave function from 0 to `end`.
template <class Function>
double largest(const Function& f, double end) {
  constexpr int narrowings = 40;  // each to 0.618 of the way: to 1e-8 of it
  constexpr double golden = 1 / std::numbers::phi;
  double from = 0, to = end, left = to - golden * end, right = golden * end;
  double at_left = f(left), at_right = f(right);
  for (int k = 0; k < narrowings; ++k) {
    if (at_left > at_right) {
      to = right, right = left, at_right = at_left;
      left = to - golden * (to - from), at_left = f(left);
    } else {
      from = left, left = right, at_left = at_right;
      right = from + golden * (to - from), at_right = f(right);
    }
  }
  return std::max({f(0), f(end), at_left, at_right});
}

/// A bound of what points of a triangle in a convex shape's frame are deep in it.
struct BoundOfTriangle {
  const std::array<Vec3, 3>& corner;

  template <class Other>
  double operator()(const Other& shape) const {
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3;
    double reach = 0;
    for (const Vec3& x : corner) reach = std::max(reach, (x - middle).norm());
    return DepthOfPoint{middle}(shape) + reach;
  }
  double operator()(const Box& shape) const {
    double bound = infinity;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0})
        bound = std::min(bound, below(side * Vec3::Unit(axis), shape.size[axis] / 2));
    return bound;
  }
  double operator()(const ConvexHull& shape) const {
    double bound = infinity;
    for (const Polyhedron::Face& face : shape.solid.faces)
      bound = std::min(bound, below(face.normal, face.offset));
    return bound;
  }

  double below(const Vec3& normal, double offset) const {
    return offset - std::min({normal.dot(corner[0]), normal.dot(corner[1]), normal.dot(corner[2])});
  }
};

/// What the mesh's triangles are deep in a shape a, which is convex: the depth of a point is concave.
double depth_of_triangles(const ClosedMesh& mesh, const Shape& a, const Frame& to_a, double floor) {
  double most = floor;
  for (const auto& triangle : mesh.surface.triangles) {
    std::array<Vec3, 3> corner = corners(mesh, triangle);
    for (Vec3& x : corner) x = to_a.place(x);
    if (std::visit(BoundOfTriangle{corner}, a) <= most) continue;
    const Vec3 one = corner[1] - corner[0], two = corner[2] - corner[0];
    const auto along = [&](double u) {
      return largest([&](double v) { return std::visit(DepthOfPoint{corner[0] + u * one + v * two}, a); },
                     1 - u);
    };
    most = std::max(most, largest(along, 1));
  }
  return most;
}

/// What points of a prove, the triangles of the mesh b in a convex a among them.
double depth_in_mesh(const PlacedShape& a, const PlacedShape& b, const ClosedMesh& mesh, double floor) {
  const Eigen::Matrix3d turn = b.frame.rotation.transpose() * a.frame.rotation;
  const Frame to_b{b.frame.rotation.transpose() * (a.frame.origin - b.frame.origin), turn};
  double most = floor;
  for (const Ball& ball : std::visit(Balls{}, *a.shape))
    most = depth_of_ball(mesh, {to_b.place(ball.centre), ball.radius}, most);
  for (const Segment& edge : edges_of(*a.shape)) {
    const Segment placed{to_b.place(edge.from), to_b.place(edge.to)};
    const std::vector<double> shares = crossings(mesh, placed);
    if (shares.size() == 2) continue;  // its ends, which are nodes
    for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
      const double middle = (shares[i] + shares[i + 1]) / 2;
      most = depth_of_ball(mesh, {placed.from + middle * (placed.to - placed.from)}, most);
    }
  }
  if (!is_convex(*a.shape)) return most;
  return depth_of_triangles(mesh, *a.shape, {-(turn.transpose() * to_b.origin), turn.transpose()}, most);
}

}  // namespace

double proved_depth(const PlacedShape& a, const PlacedShape& b, double floor) {
  double most = floor;
  if (const auto* mesh = std::get_if<ClosedMesh>(b.shape)) most = depth_in_mesh(a, b, *mesh, most);
  if (const auto* mesh = std::get_if<ClosedMesh>(a.shape)) most = depth_in_mesh(b, a, *mesh, most);
  return most;
}

double proved_depth(const PlacedShape& placed, const std::array<Vec3, 3>& triangle, double radius) {
  const auto& mesh = std::get<ClosedMesh>(*placed.shape);
  std::array<Vec3, 3> corner;
  AxisBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = placed.frame.rotation.transpose() * (triangle[k] - placed.frame.origin);
    box.extend(corner[k]);
  }
  double most = depth_of_ball(mesh, {(corner[0] + corner[1] + corner[2]) / 3, radius}, 0);
  for (const Vec3& x : corner) most = depth_of_ball(mesh, {x, radius}, most);
  for (std::size_t k = 0; k < 3; ++k)
    if (crossings(mesh, {corner[k], corner[(k + 1) % 3]}).size() > 2) most = std::max(most, radius);
  box.min().array() -= radius;
  box.max().array() += radius;
  mesh.tree.find(box, [&](int near) {
    const auto& nodes = mesh.surface.triangles[static_cast<std::size_t>(near)];
    for (std::size_t k = 0; k < 3; ++k) {  // each node is the first one of a side
      const Segment edge{mesh.surface.x.col(nodes[k]), mesh.surface.x.col(nodes[(k + 1) % 3])};
      const double apart = crossing(edge, corner) < 1 ? 0.0 : distance_of_triangle(edge.from, corner);
      most = std::max(most, radius - apart);
    }
  });
  return most;
}

}  // namespace pbd::reference
