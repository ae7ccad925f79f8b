// What holds at a step's end, solved or not.
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenes.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("positions follow the velocities where momentum is restored") {
  // A heavy-ended chain in free flight, its proximal steps cut off: x1 = x0 + h v1 all the same.
  constexpr double h = 0.01;
  Scene scene = chain(20, 10, true);
  for (int node = 0; node < scene.nodes(); ++node)
    scene.initial.v.col(node) = Vec3(std::sin(node), std::cos(2.0 * node), std::sin(3.0 * node));
  Method method;
  method.outer = "proximal";
  method.relaxation = "gauss_seidel";
  method.max_outer = 3;
  Workspace workspace(scene, method);
  State state = scene.initial;
  for (int k = 0; k < 20; ++k) {
    const Points before = state.x;
    step(workspace, h, state);
    CHECK((state.x - before - h * state.v).cwiseAbs().maxCoeff() <= 1e-14 * state.x.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a missed step ends at its best iterate") {
  // Where plain does not contract, under an integrator without contact, whose missed steps nothing slows.
  const Scene scene = chain(10, 30);
  State state = advanced(scene, 1.0 / 240, 60);
  Method method = direct_method(1e-11);
  method.outer = "plain";
  method.integrator = "bdf2";
  method.max_outer = 40;
  std::vector<double> residuals;
  const Report report = one_step(scene, method, 1.0 / 30, state, [&](const Iterate& iterate) {
    residuals.push_back(std::max(iterate.primal, iterate.dual));
  });
  REQUIRE(report.status == Status::not_converged);
  const double first = residuals.front(), best = *std::min_element(residuals.begin(), residuals.end()),
               late = *std::min_element(residuals.begin() + 10, residuals.end());
  INFO("first " << first << ", best " << best << ", best of the later ones " << late);
  CHECK(report.residual() <= (1 + 1e-9) * (late <= first ? late : best));
  CHECK(residuals.back() > 1.01 * report.residual());  // else any iterate would do
}
