#include "ways_apart.h"

#include <algorithm>

#include "polyhedron.h"

namespace pbd::reference {
namespace {

void add_normals(const PlacedShape& placed, double sign, std::vector<Vec3>& ways) {
  const Eigen::Matrix3d& turn = placed.frame.rotation;
  if (const auto* hull = std::get_if<ConvexHull>(placed.shape)) {
    for (const auto& face : hull->solid.faces) ways.emplace_back(sign * (turn * face.normal));
    return;
  }
  if (std::holds_alternative<Sphere>(*placed.shape)) return;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) ways.emplace_back(side * turn.col(axis));
}

/// The corners of what a shape is rounded about; of a cylinder the ends of its axis. In the world.
struct CoreOf {
  Points operator()(std::monostate) const { return Vec3::Zero(); }
  Points operator()(const Sphere&) const { return Vec3::Zero(); }
  Points operator()(const Box& shape) const { return box_surface(shape.size).x; }
  Points operator()(const Cylinder& shape) const { return axis(shape.length); }
  Points operator()(const Capsule& shape) const { return axis(shape.length); }
  Points operator()(const ClosedMesh& shape) const { return shape.surface.x; }
  Points operator()(const ConvexHull& shape) const { return shape.surface.x; }
  Points operator()(const HalfSpace&) const { return Vec3::Zero(); }

  static Points axis(double length) {
    Points ends = Points::Zero(3, 2);
    ends.row(2) << -length / 2, length / 2;
    return ends;
  }
};

Points core_of(const PlacedShape& placed) {
  return (placed.frame.rotation * std::visit(CoreOf{}, *placed.shape)).colwise() + placed.frame.origin;
}

/// The directions of a polyhedron's edges, and of the axes of what is round, in the world; parallel ones
/// once.
std::vector<Vec3> edge_directions(const PlacedShape& placed) {
  const Eigen::Matrix3d& turn = placed.frame.rotation;
  std::vector<Vec3> directions;
  if (const auto* hull = std::get_if<ConvexHull>(placed.shape)) {
    constexpr double parallel = 1e-12;  // sine: of directions that make no other normal
    for (const auto& edge : hull->solid.edges) {
      const Vec3 along =
          turn * (hull->solid.x.col(edge.node[1]) - hull->solid.x.col(edge.node[0])).normalized();
      const bool known = std::any_of(directions.begin(), directions.end(), [&](const Vec3& other) {
        return along.cross(other).norm() <= parallel;
      });
      if (!known) directions.push_back(along);
    }
  } else if (std::holds_alternative<Box>(*placed.shape)) {
    for (int axis = 0; axis < 3; ++axis) directions.push_back(turn.col(axis));
  } else if (!std::holds_alternative<Sphere>(*placed.shape)) {
    directions.push_back(turn.col(2));
  }
  return directions;
}

/// The unit vectors across an edge of each.
void add_across_edges(const PlacedShape& a, const PlacedShape& b, std::vector<Vec3>& ways) {
  const std::vector<Vec3> of_b = edge_directions(b);
  for (const Vec3& one : edge_directions(a))
    for (const Vec3& two : of_b) {
      const Vec3 across = one.cross(two);
      if (!(across.norm() > 0)) continue;
      ways.push_back(across.normalized());
      ways.push_back(-ways.back());
    }
}

}  // namespace

std::vector<Vec3> ways_apart(const PlacedShape& a, const PlacedShape& b) {
  if (is_half_space(*b.shape)) return {b.frame.rotation.col(2)};
  if (is_half_space(*a.shape)) return {-a.frame.rotation.col(2)};
  std::vector<Vec3> ways;
  const Vec3 between = a.frame.origin - b.frame.origin;
  if (between.norm() > 0) ways.push_back(between.normalized());
  add_normals(a, -1, ways);
  add_normals(b, 1, ways);
  // What is apart along one of these is not in each other: the others are not needed.
  if (!(separation(a, b, ways) < 0)) return ways;
  if (const DistanceBounds cores = distance(core_of(a), core_of(b)); cores.proved > 0)
    ways.push_back(cores.along);
  else
    add_across_edges(a, b, ways);
  return ways;
}

}  // namespace pbd::reference
