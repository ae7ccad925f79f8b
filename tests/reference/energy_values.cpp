// Values of the effects against formulas.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "assembly.h"
#include "closed_form.h"
#include "dense.h"
#include "mesh.h"
#include "one_effect.h"
#include "polar.h"

using namespace pbd;
using namespace pbd::reference;
using namespace pbd::test;

namespace {

constexpr double lambda_of(double young, double nu) {
  return young * nu / ((1 + nu) * (1 - 2 * nu));
}
constexpr double mu_of(double young, double nu) {
  return young / (2 * (1 + nu));
}

/// Unit cube of six tetrahedra deformed by F, and the force on its face x_axis = 1 (per area: a column of P).
struct Cube {
  double energy;
  Eigen::Matrix3d stress;
};
Cube deformed_cube(const Eigen::Matrix3d& f, const Material& material, Strain strain) {
  Scene scene;
  add_solid(scene, kuhn_grid({2, 2, 2}, Vec3::Ones()), 1000, material, strain);
  const Model model = make_model(scene);
  Assembly assembly(model);
  const Derivatives d = assembly.at(f * scene.initial.x, {});
  Cube cube{d.value, Eigen::Matrix3d::Zero()};
  // sum over nodes of dU/dx X^T = integral of P.
  for (int a = 0; a < scene.nodes(); ++a)
    cube.stress += d.gradient.segment<3>(3 * a) * scene.initial.x.col(a).transpose();
  return cube;
}

}  // namespace

TEST_CASE("the bending angle is the scene's dihedral angle, taken modulo 2 pi") {
  Scene scene = scene_with(Bending{{{0, 1, 2, 3}}, {0}, {1}});
  for (const double mirror : {1.0, -1.0}) {
    scene.initial.x.row(2) *= mirror;
    const double angle = dihedral_angle(scene.initial.x);
    for (const double rest : {0.0, 2.0, -2.0, 3.1, -3.1}) {
      std::get<Bending>(scene.effects[0]).rest_angle[0] = rest;
      const double c = constraint_value(make_model(scene).elements[0], scene.initial.x)(0);
      CHECK(std::abs(c) <= 3.14159265358979324);
      CHECK(std::cos(c) == Approx(std::cos(angle - rest)).epsilon(1e-13));
      CHECK(std::sin(c) == Approx(std::sin(angle - rest)).epsilon(1e-13));
    }
  }
}

TEST_CASE("compliant links and anchors store 1/2 c^2 / compliance") {
  const Scene scene = scene_with(Distance{{{0, 1}}, {1}, {0.02}});
  const double stretch = (scene.initial.x.col(1) - scene.initial.x.col(0)).norm() - 1;
  CHECK(lagrangian(make_model(scene), scene.initial.x, {}) ==
        Approx(stretch * stretch / 2 / 0.02).epsilon(1e-13));
  const Scene held = scene_with(Anchor{{0}, {Vec3(0, 0, 0)}, {0.5}});
  CHECK(lagrangian(make_model(held), held.initial.x, {}) ==
        Approx(held.initial.x.col(0).squaredNorm()).epsilon(1e-13));
}

TEST_CASE("St Venant-Kirchhoff: energy, uniaxial stress and simple shear follow their formulas") {
  const Material material{1e6, 0.3};
  const double lambda = lambda_of(1e6, 0.3), mu = mu_of(1e6, 0.3);
  Eigen::Matrix3d f;
  f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0.1, -0.2, 1.2;
  const Eigen::Matrix3d e = (f.transpose() * f - Eigen::Matrix3d::Identity()) / 2;
  const Cube general = deformed_cube(f, material, Strain::green);
  CHECK(general.energy == Approx(mu * e.squaredNorm() + lambda / 2 * e.trace() * e.trace()).epsilon(1e-12));
  const Eigen::Matrix3d second = 2 * mu * e + lambda * e.trace() * Eigen::Matrix3d::Identity();
  CHECK((general.stress - f * second).norm() <= 1e-12 * general.stress.norm());

  for (const double stretch : {0.5, 0.8, 1.2, 1.5, 2.0}) {
    const double lateral = kirchhoff_lateral_stretch(0.3, stretch);
    const Cube bar = deformed_cube(Vec3(stretch, lateral, lateral).asDiagonal(), material, Strain::green);
    CHECK(bar.stress(0, 0) == Approx(kirchhoff_uniaxial_stress(1e6, stretch)).epsilon(1e-11));
    CHECK(std::abs(bar.stress(1, 1)) <= 1e-9 * std::abs(bar.stress(0, 0)));
  }
  for (const double shear : {0.1, 0.5, 1.0}) {
    Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity();
    sheared(0, 1) = shear;
    const Cube cube = deformed_cube(sheared, material, Strain::green);
    CHECK(cube.stress(0, 1) == Approx(kirchhoff_shear(1e6, 0.3, shear).p12).epsilon(1e-11));
    CHECK(cube.stress(1, 1) == Approx(kirchhoff_shear(1e6, 0.3, shear).p22).epsilon(1e-11));
  }
}

TEST_CASE("linear and corotational energies follow their formulas") {
  const Material material{1e6, 0.3};
  const double lambda = lambda_of(1e6, 0.3), mu = mu_of(1e6, 0.3);
  Eigen::Matrix3d f;
  f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0.1, -0.2, 1.2;
  const auto energy_of = [&](const Eigen::Matrix3d& strain) {
    return mu * strain.squaredNorm() + lambda / 2 * strain.trace() * strain.trace();
  };
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d small = (f + f.transpose()) / 2 - identity;
  CHECK(deformed_cube(f, material, Strain::linear).energy == Approx(energy_of(small)).epsilon(1e-12));
  // S is the positive square root of F^T F for det F > 0.
  const Eigen::Matrix3d square = f.transpose() * f;
  const auto [values, vectors] = symmetric_eigen(square);
  const Eigen::Matrix3d s = vectors * values.cwiseSqrt().asDiagonal() * vectors.transpose();
  CHECK(deformed_cube(f, material, Strain::corotational).energy ==
        Approx(energy_of(s - identity)).epsilon(1e-12));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Strain strain : {Strain::green, Strain::corotational})
    CHECK(deformed_cube(turn, material, strain).stress.norm() <= 1e-14 * material.young);
}

TEST_CASE("a sheet's membrane energy is that of plane stress") {
  const double young = 100, nu = 0.3, thickness = 0.5;
  Eigen::Matrix3d rest;
  rest << 0, 1, 0.3, 0, 0.2, 0.8, 0, 0, 0.1;
  Scene scene = scene_with(triangle(young));
  // Stretch a along the rest edge (unit u), b across in the plane (unit w): E = ((a^2-1)/2, (b^2-1)/2), no
  // shear.
  const Vec3 u = (rest.col(1) - rest.col(0)).normalized();
  const Vec3 normal = u.cross(Vec3(rest.col(2) - rest.col(0))).normalized(), w = normal.cross(u);
  const double a = 1.1, b = 0.95, ea = (a * a - 1) / 2, eb = (b * b - 1) / 2;
  const Eigen::Matrix3d f = a * u * u.transpose() + b * w * w.transpose() + normal * normal.transpose();
  scene.initial.x.leftCols<3>() = f * rest;
  const double expected =
      triangle_area(rest) * thickness * young / (1 - nu * nu) / 2 * (ea * ea + eb * eb + 2 * nu * ea * eb);
  CHECK(lagrangian(make_model(scene), scene.initial.x, {}) == Approx(expected).epsilon(1e-12));
  // Simple shear s along u: E_uw = s/2, E_ww = s^2/2.
  const double s = 0.4, eww = s * s / 2, shear = mu_of(young, nu);
  scene.initial.x.leftCols<3>() = (Eigen::Matrix3d::Identity() + s * u * w.transpose()) * rest;
  const double sheared =
      triangle_area(rest) * thickness * (young / (1 - nu * nu) * eww * eww / 2 + shear * s * s / 2);
  CHECK(lagrangian(make_model(scene), scene.initial.x, {}) == Approx(sheared).epsilon(1e-12));
}

TEST_CASE("the Hessian of tr S has the twist modes 2/(s_i + s_j)") {
  Eigen::Matrix3d f;
  f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0.1, -0.2, 1.2;
  for (const double sign : {1.0, -1.0}) {
    f.col(2) *= sign;
    const ProperSvd svd = proper_svd(f);
    CHECK((svd.u * svd.s.asDiagonal() * svd.v.transpose() - f).norm() <= 1e-14);
    CHECK(svd.u.determinant() == Approx(1).epsilon(1e-14));
    CHECK(svd.v.determinant() == Approx(1).epsilon(1e-14));
    const StrainDerivatives d = corotational_derivatives(f);
    const Eigen::Matrix<double, 9, 9> trace = d.hessian[0] + d.hessian[1] + d.hessian[2];
    Eigen::Matrix<double, 9, 1> expected = Eigen::Matrix<double, 9, 1>::Zero();
    expected.head<3>() << 2 / (svd.s(0) + svd.s(1)), 2 / (svd.s(1) + svd.s(2)), 2 / (svd.s(2) + svd.s(0));
    std::sort(expected.begin(), expected.end());
    CHECK((symmetric_eigen(trace).values - expected).norm() <= 1e-12);
    // Its gradient is the rotation.
    const Eigen::Matrix<double, 1, 9> gradient = d.jacobian.topRows<3>().colwise().sum();
    CHECK((Eigen::Map<const Eigen::Matrix3d>(gradient.data()) - svd.u * svd.v.transpose()).norm() <= 1e-13);
  }
}
