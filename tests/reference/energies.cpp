// Derivatives of the energies against finite differences, and projected Hessians.
#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>

#include "assembly.h"
#include "dense.h"
#include "mesh.h"
#include "one_effect.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

namespace {

/// Largest relative difference between derivatives of L and central differences.
void check_derivatives(const Scene& scene) {
  const Model model = make_model(scene);
  Assembly assembly(model);
  Multipliers m;
  m.gamma = Vector::LinSpaced(model.hard_rows, 1, 2);
  m.rho = Vector::LinSpaced(model.hard_rows, 30, 20);
  const Points& x0 = scene.initial.x;
  const Vector u = gather(model, x0);
  const Derivatives at = assembly.at(x0, m);
  const double value = lagrangian(model, x0, m), step = 1e-5;
  CHECK(at.value == Approx(value).epsilon(1e-13));
  if (model.hard_rows == 0)
    CHECK((energy_gradient(model, x0) - at.gradient).cwiseAbs().maxCoeff() <=
          1e-13 * at.magnitude.maxCoeff());
  const double force = at.gradient.cwiseAbs().maxCoeff() + 1e-3,
               stiffness = Eigen::MatrixXd(at.hessian).cwiseAbs().maxCoeff();
  for (int i = 0; i < model.unknowns; ++i) {
    Vector plus = u, minus = u;
    plus(i) += step, minus(i) -= step;
    const Points x_plus = scatter(model, x0, plus), x_minus = scatter(model, x0, minus);
    const double slope = (lagrangian(model, x_plus, m) - lagrangian(model, x_minus, m)) / (2 * step);
    CHECK(at.gradient(i) == Approx(slope).margin(1e-7 * force));
    const Derivatives upper = assembly.at(x_plus, m), lower = assembly.at(x_minus, m);
    const Vector column = (upper.gradient - lower.gradient) / (2 * step);
    CHECK((column - Vector(at.hessian.col(i))).cwiseAbs().maxCoeff() <= 1e-7 * stiffness);
    if (model.hard_rows == 0) continue;
    const Vector row = (upper.hard - lower.hard) / (2 * step);
    CHECK((row - Vector(at.jacobian.col(i))).cwiseAbs().maxCoeff() <= 1e-8);
  }
}

}  // namespace

TEST_CASE("derivatives of every effect agree with finite differences") {
  check_derivatives(scene_with(Anchor{{1}, {Vec3(1, 0, 0)}, {0.1}}));
  check_derivatives(scene_with(Anchor{{1}, {Vec3(1, 0, 0)}, {0}}));
  check_derivatives(scene_with(Distance{{{0, 1}, {2, 3}}, {1, 1.3}, {0.02, 0}}));
  for (const double compliance : {0.0, 0.1}) {
    check_derivatives(scene_with(Bending{{{0, 1, 2, 3}}, {0.3}, {compliance}}));
    // A hinge past a right angle and one folded on itself, where the angle's sine is small.
    Scene folded = scene_with(Bending{{{0, 1, 2, 3}}, {-2.9}, {compliance}});
    folded.initial.x.col(3) = folded.initial.x.col(2) + Vec3(0.05, 0.1, 0.02);
    check_derivatives(folded);
    folded.initial.x.col(3) = Vec3(0.5, -1.0, 0.0);
    check_derivatives(folded);
  }
  check_derivatives(scene_with(triangle(100)));
  check_derivatives(scene_with(triangle(infinity)));
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    check_derivatives(scene_with(tet(strain)));
}

TEST_CASE("derivatives hold for an inverted and a nearly flat corotational tetrahedron") {
  Scene scene = scene_with(tet(Strain::corotational));
  scene.initial.x.col(3) = Vec3(0.3, 0.2, -0.4);
  check_derivatives(scene);
  scene.initial.x.col(3) = Vec3(0.3, 0.2, 0.02);
  check_derivatives(scene);
}

TEST_CASE("nodes of infinite mass have no unknowns") {
  Scene scene = scene_with(tet(Strain::green));
  scene.mass[2] = infinity;
  CHECK(make_model(scene).unknowns == 9);
  check_derivatives(scene);
}

TEST_CASE("projected Hessians are positive semidefinite and leave positive ones alone") {
  Scene scene = scene_with(tet(Strain::green));
  scene.initial.x *= 0.5;  // compressed: the geometric stiffness is negative
  const Model model = make_model(scene);
  Assembly assembly(model);
  const auto lowest = [&](const Points& x, Curvature curvature) {
    const Eigen::MatrixXd h = assembly.at(x, {}, curvature).hessian;
    return symmetric_eigen(h).values(0) / h.norm();
  };
  CHECK(lowest(scene.initial.x, Curvature::full) < -1e-3);
  CHECK(lowest(scene.initial.x, Curvature::projected) >= -1e-14);
  const Points stretched = scene.initial.x * 4;
  const Eigen::MatrixXd full = assembly.at(stretched, {}).hessian;
  const Eigen::MatrixXd projected = assembly.at(stretched, {}, Curvature::projected).hessian;
  CHECK((full - projected).norm() <= 1e-13 * full.norm());
}
