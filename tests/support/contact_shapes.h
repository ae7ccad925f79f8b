// Random shapes and poses for the contact generators.
#pragma once

#include <random>

#include "collision/generate.h"
#include "convex_distance.h"

namespace pbd::test {

inline constexpr double accuracy = 1e-10;  // m, of distances of shapes of 1 m

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  Vec3 vector() {
    std::normal_distribution<> normal;
    const double x = normal(engine_), y = normal(engine_), z = normal(engine_);
    return {x, y, z};
  }
  Eigen::Matrix3d rotation() {
    const Vec3 v = vector();
    return Eigen::Quaterniond(std::normal_distribution<>()(engine_), v.x(), v.y(), v.z())
        .normalized()
        .toRotationMatrix();
  }
  /// Axes along the world's, in one of their 24 orders and directions.
  Eigen::Matrix3d quarter_turns() {
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    for (int i = 0; i < 4; ++i) {
      const Vec3 axis = Vec3::Unit(static_cast<int>(uniform(0, 3)));
      turned *= Eigen::AngleAxisd(std::acos(-1.0) / 2, axis).toRotationMatrix().array().round().matrix();
    }
    return turned;
  }

 private:
  std::mt19937_64 engine_;
};

/// Convex, whatever the shaking.
inline TriangleMesh shaken_octahedron(Random& random) {
  TriangleMesh mesh{Points(3, 6),
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int i = 0; i < 6; ++i) {
    Vec3 x = Vec3::Zero();
    x[i / 2] = i % 2 == 0 ? 0.8 : -0.8;
    for (int k = 0; k < 3; ++k) x[k] += random.uniform(-0.1, 0.1);
    mesh.x.col(i) = x;
  }
  return mesh;
}

inline Shape random_shape(const std::string& kind, Random& random) {
  if (kind == "node") return Sphere{0};
  if (kind == "sphere") return Sphere{random.uniform(0.1, 0.5)};
  if (kind == "capsule") return Capsule{random.uniform(0.1, 0.5), random.uniform(0.2, 1.5)};
  if (kind == "box")
    return Box{{random.uniform(0.3, 1.5), random.uniform(0.3, 1.5), random.uniform(0.3, 1.5)}};
  if (kind == "cylinder") return Cylinder{random.uniform(0.2, 0.6), random.uniform(0.2, 1.5)};
  if (kind == "hull") return ConvexHull(shaken_octahedron(random));
  if (kind == "mesh") return ClosedMesh(shaken_octahedron(random));
  return HalfSpace{};
}

/// In the world, meshes as if convex; cylinders and half spaces are none.
inline Convex convex(const Shape& shape, const Frame& at) {
  Convex made;
  const auto surface = [&](const TriangleMesh& mesh) {
    for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) made.x.push_back(at.place(mesh.x.col(i)));
    made.triangles = mesh.triangles;
  };
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    made.x = {at.origin};
    made.radius = sphere->radius;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    made.x = {at.place(Vec3(0, 0, -capsule->length / 2)), at.place(Vec3(0, 0, capsule->length / 2))};
    made.radius = capsule->radius;
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    surface(box_surface(box->size));
  } else if (const auto* hull = std::get_if<ConvexHull>(&shape)) {
    surface(hull->surface);
  } else if (const auto* mesh = std::get_if<ClosedMesh>(&shape)) {
    surface(mesh->surface);
  }
  return made;
}

/// Of the shape's point farthest along the unit vector n, in the world (m).
inline double support(const Shape& shape, const Frame& at, const Vec3& n) {
  if (std::holds_alternative<HalfSpace>(shape)) {
    const Vec3 up = at.rotation.col(2);
    return (n - up).norm() < 1e-12 ? up.dot(at.origin) : infinity;
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const double along = n.dot(at.rotation.col(2));
    return n.dot(at.origin) + std::abs(along) * cylinder->length / 2 +
           cylinder->radius * n.cross(at.rotation.col(2)).norm();
  }
  const Convex of = convex(shape, at);
  double most = -infinity;
  for (const Vec3& x : of.x) most = std::max(most, n.dot(x));
  return most + of.radius;
}

/// How far a is from b along the unit vector n from b to a: never more than their distance.
inline double apart_along(const Shape& a, const Frame& at_a, const Shape& b, const Frame& at_b,
                          const Vec3& n) {
  return -support(a, at_a, -n) - support(b, at_b, n);
}

/// How far outside the shape a point is; not negative (m).
inline double outside(const Shape& shape, const Frame& at, const Vec3& x) {
  const Vec3 own = at.rotation.transpose() * (x - at.origin);
  if (std::holds_alternative<HalfSpace>(shape)) return std::max(own.z(), 0.0);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return std::hypot(std::max(own.head<2>().norm() - cylinder->radius, 0.0),
                      std::max(std::abs(own.z()) - cylinder->length / 2, 0.0));
  return std::max(signed_distance(Convex{{x}, {}, 0}, convex(shape, at)), 0.0);
}

/// Of contact points, as the shapes stand.
inline Touching touch(const ContactPoint& contact, const Frame& a, const Frame& b) {
  return contact.swapped ? touching(contact, b, a) : touching(contact, a, b);
}

inline std::vector<ContactPoint> contacts(const Shape& a, const Frame& at_a, const Shape& b,
                                          const Frame& at_b, double margin) {
  CollisionScratch scratch;
  std::vector<ContactPoint> found;
  generate(a, at_a, b, at_b, Reach{margin}, scratch, found);
  return found;
}

}  // namespace pbd::test
