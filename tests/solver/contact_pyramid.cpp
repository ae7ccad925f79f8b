// Three equal cylinders or capsules: two side by side on the ground, one on top, axes parallel.
//
// With friction F <= mu N between the round shapes at 30 degrees from upright and rolling below (m bodies'
// mass, x outward motion of the lower ones, y of the upper one; I of a body about its axis):
//   (1 + I/(m r^2)) m x'' = N/2 - (sqrt(3)/2 + 1) F,   m y'' = -m g + 2 (sqrt(3)/2 N + F/2),   y'' =
//   -x''/sqrt(3).
// It stands for mu >= 1/(2 + sqrt(3)) = 2 - sqrt(3), where the ground's friction is a third of its pressure.
// Just below, at mu (1 - e), N = m g/2 and x'' = e m g/(4 (m + I/r^2)) to first order in e, and grows as the
// pyramid flattens.
#include <catch2/catch.hpp>

#include "contact_runs.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double radius = 0.1, length = 0.5, mass = 1, moment = mass * radius * radius / 2;  // m, kg, kg m^2

Scene pyramid_of(const Shape& shape, double friction) {
  constexpr double across = mass * (3 * radius * radius + length * length) / 12;
  const Eigen::Quaterniond along_y(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitX()));
  Scene scene;
  Contact contact;
  for (const Vec3& x :
       {Vec3(-radius, 0, radius), Vec3(radius, 0, radius), Vec3(0, 0, (1 + std::sqrt(3.0)) * radius)})
    contact.collider.push_back({shape, add_body(scene, x, mass, Vec3(across, across, moment), along_y)});
  const int ground = add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  contact.collider.push_back({HalfSpace{}, ground, Frame{}, 1});
  constexpr double rough = 2.0 / 3;  // twice what the ground needs
  contact.materials = 2;
  contact.law = {ContactLaw{friction}, ContactLaw{rough}, ContactLaw{rough}, ContactLaw{rough}};
  scene.effects = {Gravity{}, Gyroscopic{}, contact};
  return scene;
}

}  // namespace

TEST_CASE(
    "three cylinders or capsules stand where friction is a thousandth above what they need, and fall below") {
  const Shape shape = GENERATE(Shape(Cylinder{radius, length}), Shape(Capsule{radius, length}));
  Method method;
  method.relaxation = GENERATE("conjugate_gradients", "direct");
  const double needed = 2 - std::sqrt(3.0), h = 0.01, excess = GENERATE(0.001, -0.001);
  constexpr int steps = 50;
  const State end = run(pyramid_of(shape, (1 + excess) * needed), method, h, steps);
  const double drop = (1 + std::sqrt(3.0)) * radius - end.x(2, 2);
  const double outward =
      std::abs(excess) * mass * gravity / (4 * (mass + moment / (radius * radius)));  // m/s^2
  const double least = outward / std::sqrt(3.0) * h * h * steps * (steps + 1) / 2;    // by implicit Euler, m
  if (excess < 0)
    CHECK(drop > least);
  else
    CHECK(std::abs(drop) < 0.01 * least);
}
