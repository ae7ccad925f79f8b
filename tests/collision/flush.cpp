// Shapes that lie flush on each other and overhang: the plane between them parts them wherever they slide.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "contact_shapes.h"
#include "refined.h"

using namespace pbd;
using namespace pbd::test;

namespace {

/// With flat faces at z = +-size/2, m.
Shape block(const std::string& kind, double size) {
  const TriangleMesh cube = box_surface(Vec3::Constant(size));
  if (kind == "box") return Box{Vec3::Constant(size)};
  if (kind == "hull") return ConvexHull(cube);
  if (kind == "cylinder") return Cylinder{size / 2, size};
  return ClosedMesh(kind == "mesh" ? cube : refined(cube));
}

}  // namespace

TEST_CASE("what slides flush on a shape is not held by what is beside it") {
  constexpr double reach = 0.01, width = 1, size = 0.4;  // m
  constexpr double rounded = 1e-12;                      // m
  const auto above = GENERATE(as<std::string>(), "box", "hull", "mesh", "refined mesh", "cylinder");
  const auto below = GENERATE(as<std::string>(), "box", "hull", "mesh", "refined mesh", "cylinder");
  const Shape slider = block(above, size), table = block(below, width);
  Random random(41);
  int lying = 0;
  for (int draw = 0; draw < 100; ++draw) {
    const Eigen::Matrix3d turned =
        Eigen::AngleAxisd(random.uniform(0, 2 * std::acos(-1.0)), Vec3::UnitZ()).toRotationMatrix();
    const double most = (width + size) / 2, lift = draw % 2 == 0 ? 0.0 : random.uniform(-1e-15, 1e-15);
    const Frame at{{random.uniform(-most, most), random.uniform(-most, most), (width + size) / 2 + lift},
                   turned};
    for (const bool first : {true, false}) {
      INFO(above << " on " << below << ", draw " << draw << ", first " << first);
      const auto found =
          first ? contacts(slider, at, table, {}, reach) : contacts(table, {}, slider, at, reach);
      std::vector<Touching> touching;
      for (const ContactPoint& contact : found)
        touching.push_back(first ? touch(contact, at, {}) : touch(contact, {}, at));
      const bool lies = std::any_of(touching.begin(), touching.end(),
                                    [](const Touching& t) { return std::abs(t.gap) <= rounded; });
      for (const Touching& t : touching)
        CHECK((!lies || t.gap >= reach * t.normal.head<2>().norm() - rounded));
      lying += lies ? 1 : 0;
    }
  }
  CHECK(lying > 100);
}

// Its nearest place to the cap is anywhere along it but for rounding: on the cap, or on the rim or the side
// where it leaves that.
TEST_CASE("an edge that lies in a cap's plane touches it where it comes in and goes out") {
  constexpr double reach = 0.01, turn = 0.03, radius = 0.2, half = 0.2;  // m, rad
  constexpr double rounded = 1e-9;                                       // m
  const auto kind = GENERATE(as<std::string>(), "box", "mesh", "refined mesh");
  const Shape table = block(kind, 1), cylinder = Cylinder{radius, 2 * half};
  Random random(43);
  CollisionScratch scratch;
  std::vector<ContactPoint> found;
  for (int draw = 0; draw < 200; ++draw) {
    // About the border x = 0.5 m, at z = 0.5 m, which the cap's chord of half length `chord` lies on.
    const double over = std::pow(10, random.uniform(-3, -0.75)),
                 chord = std::sqrt(radius * radius - over * over);
    const double lean = random.uniform(0.001, 0.05), spin = random.uniform(0, 6);
    // As steps leave it.
    const double gap = random.uniform(-1e-15, 1e-15),
                 tilt = (draw % 8 < 4 ? 0 : 1) * random.uniform(-1e-10, 1e-10);  // m, rad
    const Vec3 middle(0.5, random.uniform(-0.02, 0.02), 0.5);
    const Eigen::Matrix3d leaning =
        (Eigen::AngleAxisd(tilt, Vec3::UnitX()) * Eigen::AngleAxisd(lean, Vec3::UnitY())).toRotationMatrix();
    const Eigen::Matrix3d border =  // or one of the other three
        Eigen::AngleAxisd(draw % 4 * std::acos(0.0), Vec3::UnitZ()).toRotationMatrix().array().round();
    const Frame at{border * (middle + leaning * Vec3(over, 0, half + gap)),
                   border * leaning * Eigen::AngleAxisd(spin, Vec3::UnitZ()).toRotationMatrix()};
    INFO(kind << ", draw " << draw << ", over " << over << ", lean " << lean << ", gap " << gap);
    std::array<bool, 2> held{};
    found.clear();
    generate(cylinder, at, table, {}, Reach{reach, turn}, scratch, found);
    for (const ContactPoint& contact : found) {
      const Touching t = touch(contact, at, {});
      if (std::abs(t.gap) > rounded) continue;
      const Vec3 from = border.transpose() * t.point_a - middle;
      CHECK(std::abs(from.y()) <= chord + rounded);  // in the disc
      CHECK(std::hypot(from.x(), from.z()) <= 1e-6);
      for (const int side : {0, 1})
        if ((from - Vec3(0, side == 0 ? -chord : chord, 0)).norm() <= 1e-6) held[side] = true;
    }
    CHECK((held[0] && held[1]));
  }
}

// In the plane through the axis they are a corner and a point: as far as the point is from the corner, or
// from the nearer one of its sides where it is beside or within it.
TEST_CASE("a rim that has come over an edge along it is as far from that as its cap or side") {
  constexpr double radius = 0.2, half = 0.2, reach = 0.02;  // m
  const Shape disc = Cylinder{radius, 2 * half}, table = Box{Vec3::Ones()};
  const Frame below{Vec3(0.5, 0, -0.5), Eigen::Matrix3d::Identity()};  // the edge is at x = z = 0
  const auto over = [&](double x, double z) {
    return Frame{Vec3(x - radius, 0.07, half + z), Eigen::Matrix3d::Identity()};
  };
  const Frame start = over(-2e-4, 1e-3);
  int rims = 0;
  for (const ContactPoint& contact : contacts(disc, start, table, below, reach)) {
    if (contact.kind != ContactPoint::Kind::rim) continue;
    ++rims;
    for (const double x : {-0.01, -2e-4, 1e-3, 0.013})
      for (const double z : {-5e-3, -1e-5, 1e-5, 1e-3}) {
        const double gap = x < 0 && z > 0 ? std::hypot(x, z) : std::max(-x, z);
        INFO(x << ", " << z);
        CHECK(std::abs(touch(contact, over(x, z), below).gap - gap) <= 1e-12);
      }
  }
  CHECK(rims == 1);
}

// It leans over the border x = -0.5 m, of which an edge begins below its middle: next to the place there that
// is nearest to the rim, no place of the rim is nearest to the edge's line.
TEST_CASE("a rim touches an edge where they are nearest to each other, or not at all") {
  const Shape cylinder = Cylinder{0.2, 0.4}, table = block("refined mesh", 1);
  const double beside = GENERATE(0.009, 0.0103, 0.0104, 0.0105, 0.011);  // m
  const Eigen::Quaterniond turned(0.95735055315549988, -0.001195631376434417, -0.0039620672679251939,
                                  0.28889927459485698);
  const Frame at{{-0.5149827144170851, beside, 0.69988283493415926}, turned.toRotationMatrix()};
  int touching = 0;
  for (const ContactPoint& contact : contacts(cylinder, at, table, {}, 0.01)) {
    const Touching t = touch(contact, at, {});
    if (std::abs(t.gap) > 1e-9) continue;
    ++touching;
    CHECK(std::hypot(t.point_a.x() + 0.5, t.point_a.z() - 0.5) <= 1e-6);
  }
  CHECK(touching >= 2);
}

TEST_CASE("no point of a level disc's rim that may come beside a face is held by it") {
  constexpr double reach = 0.01, turn = 0.01, radius = 0.2, half = 0.2, width = 1;  // m, rad
  const auto kind = GENERATE(as<std::string>(), "box", "mesh", "refined mesh", "cylinder");
  const Shape table = block(kind, width), cylinder = Cylinder{radius, 2 * half};
  Random random(47);
  CollisionScratch scratch;
  std::vector<ContactPoint> found;
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(random.uniform(0, 6), Vec3::UnitZ()).toRotationMatrix();
    const Frame at{{random.uniform(-0.6, 0.6), random.uniform(-0.2, 0.2), width / 2 + half}, turned};
    found.clear();
    generate(cylinder, at, table, {}, Reach{reach, turn}, scratch, found);
    // As it leans to any side within the step.
    const double to = random.uniform(0, 6);
    const Frame leaning{
        at.origin, Eigen::AngleAxisd(turn, Vec3(std::cos(to), std::sin(to), 0)).toRotationMatrix() * turned};
    for (const ContactPoint& contact : found) {
      const Touching t = touch(contact, leaning, {});
      if (t.normal.z() < 0.9) continue;
      INFO(kind << ", draw " << draw << ", touches at " << t.point_a.transpose());
      const double beside = kind == "cylinder" ? t.point_a.head<2>().norm() - width / 2
                                               : t.point_a.head<2>().cwiseAbs().maxCoeff() - width / 2;
      CHECK(beside <= turn * 2 * half);  // what moves sideways as the whole leans
    }
  }
}
