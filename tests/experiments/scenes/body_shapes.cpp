#include "scenes/body_shapes.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace pbdcheck;

namespace {

constexpr double pi = std::numbers::pi;

double volume(const pbd::TriangleMesh& surface) {
  return pbd::surface_properties(surface, 1).mass;
}

}  // namespace

TEST_CASE("surfaces of round shapes are closed and inscribed") {
  const double sides = 32, chord = std::cos(pi / sides);
  const pbd::TriangleMesh cylinder = surface_of(Cylinder{0.5, 2});
  CHECK(volume(cylinder) == Approx(2 * sides / 2 * 0.25 * std::sin(2 * pi / sides)));
  CHECK(volume(surface_of(Box{{1, 2, 3}})) == Approx(6));
  for (const Shape& shape : {Shape(Sphere{0.5}), Shape(Capsule{0.5, 2})}) {
    const auto surface = surface_of(shape);
    const double full = shape_properties(shape, 1).mass;
    CHECK(volume(surface) < full);
    CHECK(volume(surface) > std::pow(chord, 6) * full);  // a sphere of radius chord^2 r fits in
    CHECK(volume(convex_hull(surface.x)) == Approx(volume(surface)));
  }
}
