#include "mass_properties.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <numbers>

#include "error.h"

using namespace pbd;

namespace {

/// Moments by the midpoint rule on a grid of n^3 points of the box [-reach, reach]: order 1 in 1/n for a
/// shape with a border, whose cells on it are counted whole or not.
template <class Inside>
MassProperties sampled(const Vec3& reach, int n, Inside inside) {
  MassProperties sum;
  const Vec3 cell = 2 * reach / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vec3 x = -reach + Vec3(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(cell);
        if (!inside(x)) continue;
        sum.mass += cell.prod();
        sum.inertia += cell.prod() * (x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose());
      }
  return sum;
}

void check_close(const MassProperties& found, const MassProperties& expected, double relative) {
  CHECK(found.mass == Approx(expected.mass).epsilon(relative));
  CHECK((found.inertia - expected.inertia).cwiseAbs().maxCoeff() < relative * expected.inertia.trace());
}

/// The surface of a box, from the outer triangles of its six faces.
TriangleMesh box_surface(const Vec3& size, const Vec3& origin) {
  TriangleMesh surface;
  surface.x.resize(3, 8);
  for (int k = 0; k < 8; ++k) surface.x.col(k) = origin + size.cwiseProduct(Vec3(k & 1, k >> 1 & 1, k >> 2));
  surface.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return surface;
}

}  // namespace

TEST_CASE("mass and inertia of solids equal sums over a fine grid") {
  // n cells across make errors of the order 1/n at the border, both signs: 60 gives below 1 %.
  constexpr int n = 60;
  constexpr double coarse = 0.01;
  check_close(sphere_properties(0.5, 1),
              sampled(Vec3::Constant(0.5), n, [](const Vec3& x) { return x.norm() < 0.5; }), coarse);
  check_close(cylinder_properties(0.3, 1.2, 1),
              sampled(Vec3(0.3, 0.3, 0.6), n, [](const Vec3& x) { return x.head<2>().norm() < 0.3; }),
              coarse);
  check_close(capsule_properties(0.3, 0.8, 1),
              sampled(Vec3(0.3, 0.3, 0.7), n,
                      [](const Vec3& x) {
                        const double beyond = std::max(0.0, std::abs(x.z()) - 0.4);
                        return Vec3(x.x(), x.y(), beyond).norm() < 0.3;
                      }),
              coarse);
}

TEST_CASE("a sphere is a capsule without length") {
  check_close(capsule_properties(0.4, 0, 3), sphere_properties(0.4, 3), 1e-14);
}

TEST_CASE("a box, by its formula and by its surface, wherever it stands") {
  const Vec3 size(0.3, 0.5, 0.7), origin(10, -20, 5);
  const auto formula = box_properties(size, 2);
  CHECK(formula.mass == Approx(2 * 0.3 * 0.5 * 0.7));
  CHECK(formula.inertia(0, 0) == Approx(formula.mass / 12 * (0.25 + 0.49)));
  const auto found = surface_properties(box_surface(size, origin), 2);
  check_close(found, formula, 1e-12);
  CHECK((found.centre - origin - size / 2).norm() < 1e-12);
  CHECK(with_mass(formula, 7).inertia.isApprox(formula.inertia * 7 / formula.mass, 1e-14));
}

TEST_CASE("an open surface and one turned inside out are refused") {
  TriangleMesh open = box_surface(Vec3::Ones(), Vec3::Zero());
  open.triangles.pop_back();
  CHECK_THROWS_AS(surface_properties(open, 1), SetupError);
  TriangleMesh inside_out = box_surface(Vec3::Ones(), Vec3::Zero());
  for (auto& triangle : inside_out.triangles) std::swap(triangle[0], triangle[1]);
  CHECK_THROWS_WITH(surface_properties(inside_out, 1), Catch::Contains("got volume -1 m^3"));
}

TEST_CASE("principal axes rebuild the inertia, and stay where it is diagonal") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d inertia = turn * Vec3(1, 2, 2.5).asDiagonal() * turn.transpose();
  const auto [moments, axes] = principal_inertia(inertia);
  const Eigen::Matrix3d r = axes.toRotationMatrix();
  CHECK((r * moments.asDiagonal() * r.transpose() - inertia).norm() < 1e-14 * inertia.norm() * 10);
  CHECK(r.determinant() == Approx(1));
  CHECK(principal_inertia(Vec3(3, 1, 2).asDiagonal()).moments == Vec3(3, 1, 2));
}

TEST_CASE("a pyramid, whose nodes' mean is not its centre") {
  // Of base a and height h: h/4 above its base; m a^2/10 about its axis, m (a^2/20 + 3 h^2/80) across it.
  constexpr double a = 2, h = 3, density = 5;
  TriangleMesh surface;
  surface.x.resize(3, 5);
  surface.x << 0, a, a, 0, a / 2, 0, 0, a, a, a / 2, 0, 0, 0, 0, h;
  surface.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const MassProperties found = surface_properties(surface, density);
  const double mass = density * a * a * h / 3, across = mass * (a * a / 20 + 3 * h * h / 80);
  CHECK(found.mass == Approx(mass).epsilon(1e-14));
  CHECK((found.centre - Vec3(a / 2, a / 2, h / 4)).norm() < 1e-14 * h);
  const Vec3 moments(across, across, mass * a * a / 10);
  CHECK((found.inertia - Eigen::Matrix3d(moments.asDiagonal())).cwiseAbs().maxCoeff() <
        1e-13 * moments.sum());
}
