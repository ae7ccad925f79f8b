// Random shapes and poses for the contact generators.
#pragma once

#include <random>

#include "contact/generate.h"
#include "convex_distance.h"

namespace pbd::test {

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

/// In the world; cylinders, meshes and half spaces are none.
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
  }
  return made;
}

/// Of contact points, as the shapes stand.
inline Touching touch(const ContactPoint& contact, const Frame& a, const Frame& b) {
  return contact.swapped ? touching(contact, b, a) : touching(contact, a, b);
}

inline std::vector<ContactPoint> contacts(const Shape& a, const Frame& at_a, const Shape& b,
                                          const Frame& at_b, double margin) {
  std::vector<ContactPoint> found;
  generate(a, at_a, b, at_b, margin, found);
  return found;
}

}  // namespace pbd::test
