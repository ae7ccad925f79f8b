#include "scenes/body_shapes.h"

#include <numbers>

namespace pbdcheck {
namespace {

constexpr int sides = 32;
using std::numbers::pi;

/// Distance from the axis, height (m).
using Profile = std::vector<Eigen::Vector2d>;

/// The surface that a profile sweeps about z. Its first point, the lowest, and its last one lie on the axis,
/// the others do not.
pbd::TriangleMesh revolved(const Profile& profile) {
  const auto rings = static_cast<int>(profile.size()) - 2;
  const int top = 1 + rings * sides;
  pbd::TriangleMesh mesh{pbd::Points(3, top + 1), {}};
  mesh.x.col(0) = pbd::Vec3(0, 0, profile.front().y());
  mesh.x.col(top) = pbd::Vec3(0, 0, profile.back().y());
  const auto node = [](int ring, int side) { return 1 + ring * sides + side % sides; };
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      const auto& point = profile[static_cast<std::size_t>(ring) + 1];
      const double angle = 2 * pi * side / sides;
      mesh.x.col(node(ring, side)) =
          pbd::Vec3(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
    }
  for (int side = 0; side < sides; ++side) {
    mesh.triangles.push_back({0, node(0, side + 1), node(0, side)});
    for (int ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.push_back({node(ring, side), node(ring, side + 1), node(ring + 1, side + 1)});
      mesh.triangles.push_back({node(ring, side), node(ring + 1, side + 1), node(ring + 1, side)});
    }
    mesh.triangles.push_back({top, node(rings - 1, side), node(rings - 1, side + 1)});
  }
  return mesh;
}

/// Half circles from the lowest to the highest point, `length` between their centres.
Profile rounded(double radius, double length) {
  Profile profile{{0, -length / 2 - radius}};
  constexpr int quarter = sides / 4;
  for (int i = 1; i < 2 * quarter; ++i) {
    const double angle = pi * i / (2 * quarter) - pi / 2;
    const Eigen::Vector2d point(radius * std::cos(angle), radius * std::sin(angle));
    if (i <= quarter) profile.emplace_back(point.x(), point.y() - length / 2);
    if (i > quarter || (i == quarter && length > 0)) profile.emplace_back(point.x(), point.y() + length / 2);
  }
  profile.emplace_back(0, length / 2 + radius);
  return profile;
}

struct Properties {
  double density;

  pbd::MassProperties operator()(std::monostate) const { return {}; }
  pbd::MassProperties operator()(HalfSpace) const { return {}; }
  pbd::MassProperties operator()(const Sphere& s) const { return pbd::sphere_properties(s.radius, density); }
  pbd::MassProperties operator()(const Box& s) const { return pbd::box_properties(s.size, density); }
  pbd::MassProperties operator()(const Cylinder& s) const {
    return pbd::cylinder_properties(s.radius, s.length, density);
  }
  pbd::MassProperties operator()(const Capsule& s) const {
    return pbd::capsule_properties(s.radius, s.length, density);
  }
  template <class Surface>
  pbd::MassProperties operator()(const Surface& s) const {
    return pbd::surface_properties(s.surface, density);
  }
};

struct SurfaceOf {
  pbd::TriangleMesh operator()(std::monostate) const { return {pbd::Points(3, 0), {}}; }
  pbd::TriangleMesh operator()(HalfSpace) const { return {pbd::Points(3, 0), {}}; }
  pbd::TriangleMesh operator()(const Sphere& s) const { return revolved(rounded(s.radius, 0)); }
  pbd::TriangleMesh operator()(const Box& s) const { return pbd::box_surface(s.size); }
  pbd::TriangleMesh operator()(const Cylinder& s) const {
    const double z = s.length / 2;
    return revolved({{0, -z}, {s.radius, -z}, {s.radius, z}, {0, z}});
  }
  pbd::TriangleMesh operator()(const Capsule& s) const { return revolved(rounded(s.radius, s.length)); }
  template <class Surface>
  pbd::TriangleMesh operator()(const Surface& s) const {
    return s.surface;
  }
};

}  // namespace

pbd::MassProperties shape_properties(const Shape& shape, double density) {
  return std::visit(Properties{density}, shape);
}

pbd::TriangleMesh surface_of(const Shape& shape) {
  return std::visit(SurfaceOf{}, shape);
}

}  // namespace pbdcheck
