// Steps of cylinders on boxes, hulls, meshes, capsules and each other, by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "judged_contact.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;
using pbdcheck::BodyScene;
using std::numbers::pi;

namespace {

constexpr double tube_radius = 0.1, tube_length = 0.3;
constexpr double rounding = 1e-12;  // m

Eigen::Quaterniond turned(double angle, const Vec3& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

const Eigen::Quaterniond along_y = turned(pi / 2, Vec3::UnitX());

void check_at_rest(const BodyScene& build) {
  const auto still = judged(build.finish());
  CHECK(still.v.cwiseAbs().maxCoeff() <= by_hand);
  CHECK(still.spin.cwiseAbs().maxCoeff() <= by_hand / tube_radius);
}

/// The least value of f over a circle's angles: sampled, then by golden sections.
template <class F>
double least_over_circle(F&& f) {
  constexpr int samples = 1000;
  int best = 0;
  for (int k = 1; k < samples; ++k)
    if (f(2 * pi * k / samples) < f(2 * pi * best / samples)) best = k;
  double low = 2 * pi * (best - 1) / samples, high = 2 * pi * (best + 1) / samples;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  while (high - low > rounding) {
    const double one = high - golden * (high - low), two = low + golden * (high - low);
    (f(one) < f(two) ? high : low) = f(one) < f(two) ? two : one;
  }
  return f((low + high) / 2);
}

/// The least of `distance` (m) from the points of the lower rim of a tube.
template <class F>
double least_of_rim(const ContactJudgement& j, int body, F&& distance) {
  const Eigen::Quaterniond& turn = j.orientation[static_cast<std::size_t>(body)];
  const Vec3 centre = j.x.col(body);
  return least_over_circle([&](double angle) {
    return distance(
        centre + turn * Vec3(tube_radius * std::cos(angle), tube_radius * std::sin(angle), -tube_length / 2));
  });
}

/// A tube that comes down askew, its lower rim above `place`.
pbdcheck::Placing falling_on(const Vec3& place, const Vec3& askew, double height) {
  return {.position = place + Vec3(0, 0, height),
          .orientation = turned(askew.norm(), askew),
          .velocity = {0, 0, -5}};
}

/// The shapes that a box can be.
std::vector<Shape> boxes(const Vec3& size) {
  const TriangleMesh surface = box_surface(size);
  return {Box{size}, ConvexHull(surface), ClosedMesh(surface)};
}

}  // namespace

TEST_CASE("a cylinder stands on boxes that its centre is over, wherever their edges cross its rim") {
  // Turned so that of the points on its rim that stand on the box none is on its centre's side of the edge.
  const Eigen::Quaterniond away = turned(pi / 8, Vec3::UnitZ());
  for (const Shape& box : boxes({0.4, 0.5, 0.2})) {
    BodyScene build({.friction = 0.5}, gravity);
    build.fixed(box, {.position = {-0.2 + 0.02, 0, -0.1}});
    build.cylinder(tube_radius, tube_length, 2, {.position = {0, 0, tube_length / 2}, .orientation = away});
    check_at_rest(build);
  }
  for (const Shape& narrow : boxes({0.05, 0.06, 0.2})) {
    BodyScene build({.friction = 0.5}, gravity);
    build.fixed(narrow, {.position = {0.02, 0, -0.1}});
    build.cylinder(tube_radius, tube_length, 2, {.position = {0, 0, tube_length / 2}});
    check_at_rest(build);
  }
}

TEST_CASE("a cylinder stands on rails") {
  const Shape rail = Capsule{0.02, 1};
  BodyScene on_rails({.friction = 0.5}, gravity);
  for (const double x : {-0.03, 0.05})
    on_rails.fixed(rail, {.position = {x, 0.1, -0.02}, .orientation = along_y});
  on_rails.cylinder(tube_radius, tube_length, 2, {.position = {0, 0, tube_length / 2}});
  check_at_rest(on_rails);
}

TEST_CASE("a cylinder that lies on a wide or a narrow box slips and turns as by hand") {
  const double friction = 0.2, slowed = friction * gravity * judged_step_s;
  for (const double width : {1.0, 0.2})
    for (const Shape& box : boxes({1, width, 0.2})) {
      BodyScene build({.friction = friction}, gravity);
      build.fixed(box, {.position = {0, 0, -0.1}});
      build.cylinder(tube_radius, tube_length, 2,
                     {.position = {0, 0.03, tube_radius}, .orientation = along_y, .velocity = {1, 0, 0}});
      const auto j = judged(build.finish());
      CHECK((j.v.col(1) - Vec3(1 - slowed, 0, 0)).norm() <= by_hand);
      const Vec3 spin = j.orientation[1] * Vec3(j.spin.col(1));
      CHECK((spin - Vec3(0, 2 * slowed / tube_radius, 0)).norm() <= by_hand / tube_radius);  // I = m R^2/2
    }
}

TEST_CASE("a cylinder that lies on a box beside a parallel edge stays where it is") {
  for (const double beside : {5e-4, 3e-3})
    for (const Shape& box : boxes({0.4, 0.5, 0.2})) {
      BodyScene build({.friction = 0.5}, gravity);
      build.fixed(box, {.position = {-0.2 + beside, 0, -0.1}});
      build.cylinder(tube_radius, tube_length, 2, {.position = {0, 0, tube_radius}, .orientation = along_y});
      check_at_rest(build);
    }
}

TEST_CASE("cylinders end on each other's sides where their axes are both radii apart") {
  const double other_radius = 0.06;
  for (const double skew : {0.0, 0.7, pi / 2}) {
    INFO(skew);
    BodyScene build({.friction = 0}, 0);
    build.fixed(Cylinder{tube_radius, tube_length}, {.position = Vec3::Zero(), .orientation = along_y});
    build.cylinder(other_radius, 0.4, 2,
                   {.position = {0, 0, tube_radius + other_radius + 0.01},
                    .orientation = turned(skew, Vec3::UnitZ()) * along_y,
                    .velocity = {0.2, 0.1, -2}});
    const auto j = judged(build.finish());
    const Vec3 end = j.x.col(1), axis = j.orientation[1] * Vec3::UnitZ();
    const double apart =
        skew > 0 ? end.dot(Vec3::UnitY().cross(axis).normalized().cwiseAbs()) : std::hypot(end.x(), end.z());
    CHECK(std::abs(apart - tube_radius - other_radius) <= rounding);
  }
}

TEST_CASE("a cylinder's rim ends on another's side at its radius from the axis") {
  BodyScene build({.friction = 0.3}, gravity);
  build.fixed(Cylinder{0.2, 1}, {.position = Vec3::Zero(), .orientation = along_y});
  build.cylinder(tube_radius, tube_length, 2, falling_on({0.08, 0, 0.2}, {0.5, 0.4, 0}, 0.21));
  const auto j = judged(build.finish());
  CHECK(j.contacts == 1);
  const double least = least_of_rim(j, 1, [](const Vec3& x) { return std::hypot(x.x(), x.z()); });
  CHECK(std::abs(least - 0.2) <= rounding);
}

TEST_CASE("an upright cylinder's rim ends on the side of one that lies along it") {
  BodyScene build({.friction = 0}, 0);
  build.fixed(Cylinder{0.1, 1}, {.position = {0.2, 0, -0.2}, .orientation = along_y});
  build.cylinder(tube_radius, tube_length, 2, {.position = {0, 0, 0}, .velocity = {2, 0, 0}});
  const auto j = judged(build.finish());
  CHECK(j.contacts == 1);
  const auto from_axis = [](const Vec3& x) { return std::hypot(x.x() - 0.2, x.z() + 0.2); };
  CHECK(std::abs(least_of_rim(j, 1, from_axis) - 0.1) <= rounding);
}

TEST_CASE("a cylinder's rim ends on a box's edge and on another's rim") {
  BodyScene on_edge({.friction = 0.3}, gravity);
  on_edge.fixed(Box{{0.4, 1, 0.2}}, {.position = {-0.2, 0, -0.1}});
  on_edge.cylinder(tube_radius, tube_length, 2, falling_on({0.03, 0, 0}, {0.3, 0.4, 0}, 0.18));
  const auto edge = judged(on_edge.finish());
  CHECK(edge.contacts == 1);
  CHECK(least_of_rim(edge, 1, [](const Vec3& x) { return std::hypot(x.x(), x.z()); }) <= rounding);

  BodyScene on_rim({.friction = 0.3}, gravity);
  on_rim.fixed(Cylinder{0.2, 0.5}, {.position = {-0.2, 0, -0.25}});
  on_rim.cylinder(tube_radius, tube_length, 2, falling_on({0.03, 0.08, 0}, {0.3, 0.4, 0}, 0.18));
  const auto rims = judged(on_rim.finish());
  CHECK(rims.contacts == 1);
  const auto from_rim = [](const Vec3& x) { return std::hypot(std::hypot(x.x() + 0.2, x.y()) - 0.2, x.z()); };
  CHECK(least_of_rim(rims, 1, from_rim) <= rounding);
}

TEST_CASE("a cylinder stands on another's cap, and falls freely beyond its rim") {
  for (const double offset : {0.05, 2 * tube_radius + 0.001}) {
    BodyScene build({.friction = 0.5}, gravity);
    build.fixed(Cylinder{tube_radius, tube_length}, {.position = {0, 0, -tube_length / 2}});
    build.cylinder(tube_radius, tube_length, 2, {.position = {offset, 0, tube_length / 2}});
    const auto j = judged(build.finish());
    const double falls = offset > 2 * tube_radius ? gravity * judged_step_s : 0;
    CHECK((j.v.col(1) + falls * Vec3::UnitZ()).norm() <= by_hand);
    CHECK(j.spin.cwiseAbs().maxCoeff() <= by_hand / tube_radius);
  }
}

TEST_CASE("a cylinder slides up and down another one, or a box, that it ends flush with") {
  for (const double up : {1.0, -1.0})
    for (const Shape& other :
         {Shape(Cylinder{tube_radius, tube_length}), Shape(Box{{0.2, 0.2, tube_length}})}) {
      BodyScene build({.friction = 0}, 0);
      build.fixed(other, {.position = {-tube_radius, 0, 0}});
      build.cylinder(tube_radius, tube_length, 2,
                     {.position = {tube_radius, 0, 0}, .velocity = {-0.5, 0, up}});
      const auto j = judged(build.finish());
      CHECK((j.v.col(1) - Vec3(0, 0, up)).norm() <= by_hand);
    }
}
