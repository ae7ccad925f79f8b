// Damping of solids and sheets with moduli of their own, against dense solutions of one element.
#include <catch2/catch.hpp>
#include <cmath>

#include "dense.h"
#include "effects/effects.h"
#include "error.h"
#include "oscillator.h"
#include "scenes.h"

using namespace pbd;
using namespace pbd::test;

namespace {

Scene one_tet(const std::optional<Material>& damping, Strain strain) {
  Scene scene;
  TetMesh mesh;
  mesh.x.resize(3, 4);
  mesh.x << 0, 1.1, 0.2, 0.1, 0, 0.1, 0.9, -0.1, 0, 0.2, -0.1, 1.2;
  mesh.tets = {{0, 1, 2, 3}};
  add_solid(scene, mesh, 1000, {2e5, 0.3}, strain);
  std::get<TetStrain>(scene.effects[0]).damping = damping;
  for (int node = 0; node < 4; ++node)
    scene.initial.v.col(node) = Vec3(std::sin(node), std::cos(2.0 * node), std::sin(3.0 * node));
  for (int node = 0; node < 4; ++node)
    scene.initial.x.col(node) += 0.05 * scene.initial.v.col((node + 1) % 4);
  return scene;
}

}  // namespace

TEST_CASE("a solid's damping has moduli of its own") {
  // linear strain: M (v - v_l) = -h V B^T (C e' + C_d (e' - e)/h) with e' = e + h B v, B the rows' J.
  const Material viscous{GENERATE(10.0, 5e3), GENERATE(-0.2, 0.45)};
  const double h = 0.01;
  const Scene scene = one_tet(viscous, Strain::linear);
  const auto& effect = std::get<TetStrain>(scene.effects[0]);
  using C = Constraint<TetStrain>;
  C::Value e;
  C::Jacobian b;
  C::Positions x = scene.initial.x;
  C::evaluate(effect, 0, x, e, b);
  const auto stiffness = [&](const Material& moduli) -> Eigen::MatrixXd {
    const double g = moduli.young / (2 * (1 + moduli.poisson));
    const double lame = 2 * g * moduli.poisson / (1 - 2 * moduli.poisson);
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(6, 6);
    c.topLeftCorner(3, 3).setConstant(lame);
    c.diagonal() << lame + 2 * g, lame + 2 * g, lame + 2 * g, g, g, g;
    return c * tet_volume(effect.rest[0]);
  };
  const Eigen::MatrixXd elastic = stiffness(effect.material), damping = stiffness(viscous);
  const Eigen::VectorXd v_l = scene.initial.v.reshaped();
  Eigen::MatrixXd matrix = b.transpose() * (h * h * elastic + h * damping) * b;
  for (int k = 0; k < 12; ++k) matrix(k, k) += scene.mass[static_cast<std::size_t>(k / 3)];
  Eigen::VectorXd right = -h * b.transpose() * elastic * e;
  for (int k = 0; k < 12; ++k) right[k] += scene.mass[static_cast<std::size_t>(k / 3)] * v_l[k];
  const Eigen::VectorXd expected = reference::solve_definite(matrix, right);

  for (const std::string outer : {"auto", "plain", "proximal", "quasi_newton", "frozen"}) {
    Method method = method_of("implicit_euler", 1e-12);
    method.outer = outer;
    method.max_outer = 1000;
    State state = scene.initial;
    Workspace workspace(scene, method);
    INFO(outer << ", viscous " << viscous.young << " Pa s, " << viscous.poisson);
    CHECK(step(workspace, h, state).status == Status::ok);
    CHECK((Eigen::VectorXd(state.v.reshaped()) - expected).norm() < 1e-9 * (v_l - expected).norm());
  }
}

TEST_CASE("a sheet's damping has moduli of its own, in plane stress") {
  TriangleStrain sheet{.node = {{0, 1, 2}}, .rest = {Eigen::Matrix3d::Identity()}, .material = {2e4, 0.3}};
  sheet.damping = Material{50, -0.1};
  const auto plane_stress = [](const Material& moduli) {
    const double nu = moduli.poisson;
    Eigen::Matrix3d c;
    c << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
    return Eigen::Matrix3d(moduli.young / (1 - nu * nu) * c);
  };
  const Eigen::Matrix3d expected = plane_stress(sheet.material).inverse() * plane_stress(*sheet.damping);
  CHECK((Constraint<TriangleStrain>::retardation(sheet, 0) - expected).norm() < 1e-14 * expected.norm());
}

TEST_CASE("damping in proportion to the stiffness is one retardation time") {
  const double time = 0.003, h = 0.004;
  for (const auto strain : {Strain::green, Strain::corotational}) {
    const Scene own = one_tet(Material{2e5 * time, 0.3}, strain), none = one_tet(std::nullopt, strain);
    const auto after = [&](const Scene& scene, const std::string& outer) {
      Method method = method_of("newmark", 1e-12);
      method.outer = outer;
      method.max_outer = 1000;
      State state = scene.initial;
      Workspace workspace(scene, method);
      for (int k = 0; k < 5; ++k) CHECK(step(workspace, h, state).status == Status::ok);
      return state.x;
    };
    const Points potential = after(own, "quasi_newton"), rows = after(own, "plain");
    CHECK((potential - rows).norm() < 1e-9 * (rows - own.initial.x).norm());
    CHECK((after(none, "plain") - rows).norm() > 1e-3 * (rows - own.initial.x).norm());
    using C = Constraint<TetStrain>;
    const C::Square retardation = C::retardation(std::get<TetStrain>(own.effects[0]), 0);
    CHECK((retardation - time * C::Square::Identity()).norm() < 1e-15);
  }
}

TEST_CASE("damping that makes no sense is refused") {
  Scene scene = chain(3);
  auto& links = std::get<Distance>(scene.effects[1]);
  links.damping = {0.1};
  CHECK_THROWS_WITH(Workspace(scene, {}), Catch::Contains("effects[1] distance damping: got 1 entries"));
  links.damping = {0.1, -0.1, 0.1};
  CHECK_THROWS_WITH(Workspace(scene, {}), Catch::Contains("effects[1] distance damping[1]: got -0.1"));
  const Scene solid = one_tet(Material{-1, 0.3}, Strain::green);
  CHECK_THROWS_WITH(Workspace(solid, {}), Catch::Contains("tet_strain damping young: got -1"));
}

TEST_CASE("the rows of a damped corotational solid are dc/dx, and J^T p is what the rows make of it") {
  const Scene scene = one_tet(Material{50, 0.1}, Strain::corotational);
  const auto& effect = std::get<TetStrain>(scene.effects[0]);
  using C = Constraint<TetStrain>;
  const C::Positions x = scene.initial.x;
  C::Value value, ahead, behind, p;
  C::Jacobian jacobian, unused;
  C::evaluate(effect, 0, x, value, jacobian);
  constexpr double step = 1e-6;
  for (int k = 0; k < 12; ++k) {
    C::Positions moved = x;
    moved.reshaped()[k] += step;
    C::evaluate(effect, 0, moved, ahead, unused);
    moved.reshaped()[k] -= 2 * step;
    C::evaluate(effect, 0, moved, behind, unused);
    CHECK((jacobian.col(k) - (ahead - behind) / (2 * step)).norm() <=
          1e-9);  // third derivatives times step^2
  }
  p << 1, -2, 0.5, 0.3, -0.7, 0.9;
  const C::Positions pushed = C::push(effect, C::deformation(effect, 0, x), p);
  CHECK((pushed.reshaped() - jacobian.transpose() * p).norm() <= 1e-14 * p.norm() * jacobian.norm());
}

TEST_CASE("a damped solid is not turned by its own forces") {
  const auto strain = GENERATE(Strain::corotational, Strain::green);
  const std::string outer = GENERATE("plain", "proximal", "quasi_newton");
  const Scene scene = one_tet(Material{5e3, 0.1}, strain);
  Method method;
  method.outer = outer;
  method.relaxation = "ldlt";
  method.tolerance = 1e-12;
  State state = scene.initial;
  Workspace workspace(scene, method);
  REQUIRE(step(workspace, 0.002, state).status == Status::ok);
  Vec3 torque = Vec3::Zero();
  double most = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 push = scene.mass[static_cast<std::size_t>(i)] * (state.v.col(i) - scene.initial.v.col(i));
    torque += Vec3(state.x.col(i)).cross(push);
    most += state.x.col(i).norm() * push.norm();
  }
  CHECK(torque.norm() <= 1e-10 * most);  // the tolerance, a hundred times
}
