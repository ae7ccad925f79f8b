// Convex shapes brought to touch meshes with hollows: by a judge's depth, which knows no features.
#include <catch2/catch.hpp>

#include "contact_shapes.h"
#include "hollow_meshes.h"
#include "mesh_depth.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// How far along `way` a placed shape goes until it has just left the mesh, from where it is in it; m.
double leaves(const Shape& shape, Frame at, const Vec3& way, const Shape& mesh) {
  const Vec3 from = at.origin;
  double inside = 0, outside = 8;
  for (int halvings = 0; halvings < 40; ++halvings) {
    const double middle = (inside + outside) / 2;
    at.origin = from + middle * way;
    (reference::proved_depth({&shape, at}, {&mesh, {}}) > 0 ? inside : outside) = middle;
  }
  return outside;
}

/// m; infinite without a contact within `reach`.
double least_gap(const Shape& shape, const Frame& at, const Shape& mesh, double reach,
                 const Frame& of_mesh = {}) {
  double least = infinity;
  for (const ContactPoint& contact : contacts(shape, at, mesh, of_mesh, reach))
    least = std::min(least, touch(contact, at, of_mesh).gap);
  return least;
}

}  // namespace

TEST_CASE("shapes that touch a mesh with hollows have a contact there, and none that is deep") {
  constexpr double judged = 1e-8;  // m: the judge narrows sides of 2 m 40 times to 0.618 of them
  constexpr double reach = 0.05;   // m
  Random random(31);
  const auto name = GENERATE(as<std::string>(), "cylinder", "disc", "capsule", "box", "hull");
  const int kind = GENERATE(0, 1, 2);
  const Shape mesh = ClosedMesh(kind == 0 ? star() : kind == 1 ? angle_profile() : blade(0.3));
  const Points& nodes = std::get<ClosedMesh>(mesh).surface.x;
  const bool flat_ends = name == "cylinder" || name == "disc";
  const Shape shape = name == "disc" ? Shape(Cylinder{1.2, 0.1}) : random_shape(name, random);
  for (int draw = 0; draw < (flat_ends ? 100 : 25); ++draw) {
    Frame at{nodes.col(draw % nodes.cols()), random.rotation()};
    const Vec3 way = random.vector().normalized();
    at.origin += leaves(shape, at, way, mesh) * way;
    CHECK(std::abs(least_gap(shape, at, mesh, reach)) <= judged);
    constexpr double back = 1e-5;  // m, into the mesh: that parts them
    at.origin -= back * way;
    const double gap = least_gap(shape, at, mesh, reach);
    CHECK(gap >= -back - judged);
    CHECK(gap < 0);
  }
}

TEST_CASE("a mesh's edge that leaves a cylinder's cap touches the rim, wherever that is rounded to") {
  const Cylinder disc{1.2, 0.1};
  const Shape shape = disc;
  for (int turn = 0; turn < 100; ++turn) {
    // A blade, sloping down outwards across the rim at the angle `turn`.
    const Eigen::Matrix3d slope =
        (Eigen::AngleAxisd(0.1 * turn, Vec3::UnitZ()) * Eigen::AngleAxisd(1e-4, Vec3::UnitY()))
            .toRotationMatrix();
    const Vec3 rim =
        disc.radius * Vec3(std::cos(0.1 * turn), std::sin(0.1 * turn), 0) + disc.length / 2 * Vec3::UnitZ();
    const Shape edge = ClosedMesh(blade(1));
    const Frame at{rim + slope * Vec3(0.2, 0, 1e-12), slope};
    CHECK(std::abs(least_gap(shape, {}, edge, 1e-3, at)) <= 1e-11);
  }
}

TEST_CASE("edges of meshes that touch and are nearly parallel have a contact") {
  const Shape above = ClosedMesh(blade(1)), below = above;
  for (const double gap : {-1e-9, -1e-12, 0.0, 1e-12, 1e-9}) {
    const Frame at{Vec3(0, 0, gap), Eigen::AngleAxisd(0.05, Vec3::UnitZ()).toRotationMatrix()};
    const Frame under{Vec3::Zero(), Eigen::AngleAxisd(std::acos(-1.0), Vec3::UnitX()).toRotationMatrix()};
    CHECK(least_gap(above, at, below, 1e-3, under) == Approx(gap).margin(1e-14));
  }
}

TEST_CASE("a cylinder's cap that lies on a mesh is no side in it") {
  // The blade's edge goes through its axis, just above and below the cap.
  const Shape edge = ClosedMesh(blade(1)), post = Cylinder{0.3, 0.5};
  for (const double deep : {0.0, 1e-12, 2e-7, 1e-4})
    CHECK(least_gap(post, {Vec3(0, 0, deep - 0.25)}, edge, 1e-3) == Approx(-deep).margin(1e-14));
  // Flush with walls of the profile, whose hollow is nearer to its axis than its radius.
  const Shape profile = ClosedMesh(angle_profile()), disc = Cylinder{1, 0.1};
  for (const double deep : {0.0, 1e-12, 2e-7, 1e-4})
    CHECK(least_gap(disc, {Vec3(0.1, 0.1, 1.05 - deep)}, profile, 1e-3) == Approx(-deep).margin(1e-14));
}

TEST_CASE("a rim that is in a mesh is deep by the nearest face alone") {
  // A coin that hangs over a cube's side, with its rim just below the top: the side is far.
  const Shape cube = ClosedMesh(box_surface(Vec3(0.2, 0.2, 0.2))), coin = Cylinder{0.15, 0.02};
  constexpr double deep = 1e-5;
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(-0.1, Vec3::UnitY()).toRotationMatrix();
  const Frame at{Vec3(-0.03, 0, 0.1 - deep) - tilt * Vec3(-0.15, 0, -0.01), tilt};
  CHECK(least_gap(coin, at, cube, 1e-3) == Approx(-deep).margin(1e-14));
}

TEST_CASE("what a mesh's edge cuts of a cap is told beside a rim that just touches") {
  const Shape cube = ClosedMesh(box_surface(Vec3(0.2, 0.2, 0.2))), coin = Cylinder{0.15, 0.02};
  const Frame at{
      Vec3(0.0043743370986058872, 0.11289647115346051, 0.046195432159693274),
      Eigen::Quaterniond(0.54891113392146962, 0.54095214269735403, -0.4184769651916207, 0.48056672374624487)
          .normalized()
          .toRotationMatrix()};
  const double depth = reference::proved_depth({&coin, at}, {&cube, {}});
  REQUIRE(depth > 5e-3);  // m
  CHECK(least_gap(coin, at, cube, 1e-3) <= -depth);
}
