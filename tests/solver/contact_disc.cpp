// A disc that lies flat on the ground and spins about its axis: friction mu m g at its rim brakes it by
// h mu m g r/I a step, I the moment about the axis.
#include <catch2/catch.hpp>

#include "contact_runs.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("a disc that spins flat on the ground is braked as friction says, and each step is solved") {
  constexpr double radius = 0.1, length = 0.05, mass = 1, friction = 0.2, spin = 10;
  constexpr double about = mass * radius * radius / 2, across = about / 2 + mass * length * length / 12;
  Scene scene;
  Contact contact;
  contact.collider.push_back(
      {HalfSpace{}, add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity))});
  contact.collider.push_back(
      {Cylinder{radius, length}, add_body(scene, Vec3(0, 0, length / 2), mass, Vec3(across, across, about),
                                          Eigen::Quaterniond::Identity(), Vec3::Zero(), Vec3(0, 0, spin))});
  contact.law = {ContactLaw{friction}};
  scene.effects = {Gravity{}, Gyroscopic{}, contact};
  const double h = GENERATE(1.0 / 60, 0.01, 0.001);
  Method method = contact_method(GENERATE("gauss_seidel", "nesterov_jacobi", "direct"));
  method.tolerance = 1e-10;
  constexpr int steps = 10;
  const State end = run(scene, method, h, steps);
  CHECK(end.spin(2, 1) ==
        Approx(spin - steps * h * friction * mass * gravity * radius / about).epsilon(1e-9));
  CHECK(std::abs(end.x(2, 1) - length / 2) < 1e-9);
}
