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
  const auto least_gap = [&](const Frame& at) {
    double least = infinity;
    for (const ContactPoint& contact : contacts(shape, at, mesh, {}, reach))
      least = std::min(least, touch(contact, at, {}).gap);
    return least;
  };
  for (int draw = 0; draw < (flat_ends ? 100 : 25); ++draw) {
    Frame at{nodes.col(draw % nodes.cols()), random.rotation()};
    const Vec3 way = random.vector().normalized();
    at.origin += leaves(shape, at, way, mesh) * way;
    CHECK(std::abs(least_gap(at)) <= judged);
    constexpr double back = 1e-5;  // m, into the mesh: that parts them
    at.origin -= back * way;
    CHECK(least_gap(at) >= -back - judged);
    CHECK(least_gap(at) < 0);
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
    double least = infinity;
    const Frame at{rim + slope * Vec3(0.2, 0, 1e-12), slope};
    for (const ContactPoint& contact : contacts(shape, {}, edge, at, 1e-3))
      least = std::min(least, touch(contact, {}, at).gap);
    CHECK(std::abs(least) <= 1e-11);
  }
}

TEST_CASE("edges of meshes that touch and are nearly parallel have a contact") {
  const Shape above = ClosedMesh(blade(1)), below = above;
  for (const double gap : {-1e-9, -1e-12, 0.0, 1e-12, 1e-9}) {
    const Frame at{Vec3(0, 0, gap), Eigen::AngleAxisd(0.05, Vec3::UnitZ()).toRotationMatrix()};
    const Frame under{Vec3::Zero(), Eigen::AngleAxisd(std::acos(-1.0), Vec3::UnitX()).toRotationMatrix()};
    double least = infinity;
    for (const ContactPoint& contact : contacts(above, at, below, under, 1e-3))
      least = std::min(least, touch(contact, at, under).gap);
    CHECK(least == Approx(gap).margin(1e-14));
  }
}

TEST_CASE("a cylinder's cap that lies on a mesh is no side in it") {
  const auto least = [](const Shape& cylinder, const Frame& at, const Shape& mesh) {
    double gap = infinity;
    for (const ContactPoint& contact : contacts(cylinder, at, mesh, {}, 1e-3))
      gap = std::min(gap, touch(contact, at, {}).gap);
    return gap;
  };
  // The blade's edge goes through its axis, or beside it, just above and below the cap.
  const Shape edge = ClosedMesh(blade(1)), post = Cylinder{0.3, 0.5};
  for (const double deep : {0.0, 1e-12, 2e-7, 1e-4})
    CHECK(least(post, {Vec3(0, 0, deep - 0.25)}, edge) == Approx(-deep).margin(1e-14));
  // Flush with walls of the profile, whose hollow is nearer to its axis than its radius.
  const Shape profile = ClosedMesh(angle_profile()), disc = Cylinder{1, 0.1};
  for (const double deep : {0.0, 1e-12, 2e-7, 1e-4})
    CHECK(least(disc, {Vec3(0.1, 0.1, 1.05 - deep)}, profile) == Approx(-deep).margin(1e-14));
}

TEST_CASE("a rim that is in a mesh is deep by the nearest face alone") {
  // A coin that hangs over a cube's side, with its rim just below the top: the side is far.
  const Shape cube = ClosedMesh(box_surface(Vec3(0.2, 0.2, 0.2))), coin = Cylinder{0.15, 0.02};
  constexpr double deep = 1e-5;
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(-0.1, Vec3::UnitY()).toRotationMatrix();
  const Frame at{Vec3(-0.03, 0, 0.1 - deep) - tilt * Vec3(-0.15, 0, -0.01), tilt};
  double least = infinity;
  for (const ContactPoint& contact : contacts(coin, at, cube, {}, 1e-3))
    least = std::min(least, touch(contact, at, {}).gap);
  CHECK(least == Approx(-deep).margin(1e-14));
}

TEST_CASE("what a mesh's edge cuts of a cap is told beside a rim that just touches") {
  const Shape cube = ClosedMesh(box_surface(Vec3(0.2, 0.2, 0.2))), coin = Cylinder{0.15, 0.02};
  const Frame at{
      Vec3(0.0043743370986058872, 0.11289647115346051, 0.046195432159693274),
      Eigen::Quaterniond(0.54891113392146962, 0.54095214269735403, -0.4184769651916207, 0.48056672374624487)
          .normalized()
          .toRotationMatrix()};
  double least = infinity;
  for (const ContactPoint& contact : contacts(coin, at, cube, {}, 1e-3))
    least = std::min(least, touch(contact, at, {}).gap);
  CHECK(least <= -reference::proved_depth({&coin, at}, {&cube, {}}));
}
