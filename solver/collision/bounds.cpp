#include "collision/bounds.h"

#include <algorithm>
#include <cmath>

#include "mass_properties.h"

namespace pbd {
namespace {

double farthest(const Points& points) {
  return points.colwise().norm().maxCoeff();
}

struct Radius {
  double operator()(std::monostate) const { return 0; }
  double operator()(const Sphere& shape) const { return shape.radius; }
  double operator()(const Box& shape) const { return shape.size.norm() / 2; }
  double operator()(const Cylinder& shape) const { return std::hypot(shape.radius, shape.length / 2); }
  double operator()(const Capsule& shape) const { return shape.radius + shape.length / 2; }
  double operator()(const ClosedMesh& shape) const { return farthest(shape.surface.x); }
  double operator()(const ConvexHull& shape) const { return farthest(shape.surface.x); }
  double operator()(const HalfSpace&) const { return infinity; }
};

struct RoundRadius {
  double operator()(const Box& shape) const { return shape.size.minCoeff() / 2; }
  double operator()(const Cylinder& shape) const { return std::min(shape.radius, shape.length / 2); }
  double operator()(const Capsule& shape) const { return shape.radius; }
  double operator()(const ClosedMesh& shape) const { return of_surface(shape.surface); }
  double operator()(const ConvexHull& shape) const { return of_surface(shape.surface); }
  double operator()(const auto& shape) const { return Radius{}(shape); }

  static double of_surface(const TriangleMesh& surface) {
    const auto axes = principal_inertia(surface_properties(surface, 1).inertia).axes;
    const Points along = axes.toRotationMatrix().transpose() * surface.x;
    return (along.rowwise().maxCoeff() - along.rowwise().minCoeff()).minCoeff() / 2;
  }
};

/// Half the box's size about the frame's origin; nothing for shapes whose points are listed.
struct HalfSize {
  const Eigen::Matrix3d& rotation;

  Vec3 operator()(std::monostate) const { return Vec3::Zero(); }
  Vec3 operator()(const Sphere& shape) const { return Vec3::Constant(shape.radius); }
  Vec3 operator()(const Box& shape) const { return rotation.cwiseAbs() * shape.size / 2; }
  Vec3 operator()(const Cylinder& shape) const {
    const Vec3 axis = rotation.col(2);
    return shape.length / 2 * axis.cwiseAbs() +
           shape.radius * (1 - axis.array().square()).max(0).sqrt().matrix();
  }
  Vec3 operator()(const Capsule& shape) const {
    return shape.length / 2 * rotation.col(2).cwiseAbs() + Vec3::Constant(shape.radius);
  }
  Vec3 operator()(const HalfSpace&) const { return Vec3::Constant(infinity); }
  Vec3 operator()(const ClosedMesh& shape) const { return of_points(shape.surface.x); }
  Vec3 operator()(const ConvexHull& shape) const { return of_points(shape.surface.x); }
  Vec3 of_points(const Points& points) const { return (rotation * points).cwiseAbs().rowwise().maxCoeff(); }
};

/// About the frame's origin, `direction` in the frame.
struct LeastAlong {
  Vec3 direction;

  double operator()(std::monostate) const { return 0; }
  double operator()(const Sphere& shape) const { return -shape.radius; }
  double operator()(const Box& shape) const { return -direction.cwiseAbs().dot(shape.size) / 2; }
  double operator()(const Cylinder& shape) const {
    return -shape.length / 2 * std::abs(direction.z()) - shape.radius * direction.head<2>().norm();
  }
  double operator()(const Capsule& shape) const {
    return -shape.length / 2 * std::abs(direction.z()) - shape.radius;
  }
  double operator()(const HalfSpace&) const { return -infinity; }
  double operator()(const ClosedMesh& shape) const { return of_points(shape.surface.x); }
  double operator()(const ConvexHull& shape) const { return of_points(shape.surface.x); }
  double of_points(const Points& points) const { return (direction.transpose() * points).minCoeff(); }
};

}  // namespace

double bounding_radius(const Shape& shape) {
  return std::visit(Radius{}, shape);
}

double round_radius(const Shape& shape) {
  return std::visit(RoundRadius{}, shape);
}

double least_along(const Shape& shape, const Frame& at, const Vec3& direction) {
  return direction.dot(at.origin) + std::visit(LeastAlong{at.rotation.transpose() * direction}, shape);
}

Eigen::AlignedBox3d bounds_of(const Shape& shape, const Frame& at) {
  const Vec3 half = std::visit(HalfSize{at.rotation}, shape);
  return {at.origin - half, at.origin + half};
}

}  // namespace pbd
