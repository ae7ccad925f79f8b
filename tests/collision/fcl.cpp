// Distances of shapes that are apart beside another library's: FCL, by libccd's GJK.
#include <fcl/fcl.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "contact_shapes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double far = 3;  // m, that shapes are apart at most

std::shared_ptr<fcl::CollisionGeometryd> geometry(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return std::make_shared<fcl::Sphered>(sphere->radius);
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    return std::make_shared<fcl::Capsuled>(capsule->radius, capsule->length);
  if (const auto* box = std::get_if<Box>(&shape)) return std::make_shared<fcl::Boxd>(box->size);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return std::make_shared<fcl::Cylinderd>(cylinder->radius, cylinder->length);
  const TriangleMesh& mesh = std::get<ConvexHull>(shape).surface;
  auto corners = std::make_shared<std::vector<Vec3>>();
  auto faces = std::make_shared<std::vector<int>>();  // each its number of corners, then those
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) corners->push_back(mesh.x.col(i));
  for (const auto& triangle : mesh.triangles)
    faces->insert(faces->end(), {3, triangle[0], triangle[1], triangle[2]});
  return std::make_shared<fcl::Convexd>(corners, static_cast<int>(mesh.triangles.size()), faces);
}

fcl::CollisionObjectd placed_at(const Shape& shape, const Frame& at) {
  return {geometry(shape), at.rotation, at.origin};
}

}  // namespace

TEST_CASE("FCL finds the same distances") {
  const auto kind = GENERATE(as<std::string>(), "sphere", "capsule", "box", "cylinder", "hull");
  const auto other = GENERATE(as<std::string>(), "sphere", "capsule", "box", "cylinder", "hull");
  Random random(11);
  fcl::DistanceRequestd request;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = 1e-14;
  double worst = 0;
  int compared = 0;
  for (int number = 0; number < 300; ++number) {
    const Shape a = random_shape(kind, random), b = random_shape(other, random);
    const Frame at_b{random.vector(), random.rotation()};
    const Frame at_a{at_b.origin + random.uniform(1, far) * random.vector().normalized(), random.rotation()};
    double least = infinity;
    for (const auto& contact : contacts(a, at_a, b, at_b, far))
      least = std::min(least, touch(contact, at_a, at_b).gap);
    if (!(least > 0.01)) continue;  // well apart: of overlaps FCL's depth is another quantity
    const fcl::CollisionObjectd one = placed_at(a, at_a), two = placed_at(b, at_b);
    fcl::DistanceResultd result;
    worst = larger(worst, std::abs(fcl::distance(&one, &two, request, result) - least));
    ++compared;
  }
  INFO(kind << " " << other << " off by " << worst << " of " << compared);
  CHECK(compared > 100);
  const double rounding = far * std::sqrt(std::numeric_limits<double>::epsilon());  // GJK compares squares
  CHECK(worst <= rounding);
}
