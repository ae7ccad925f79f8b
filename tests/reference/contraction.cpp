// Predicted rates against formulas and stated values.
#include "contraction.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "closed_form.h"
#include "dense.h"
#include "error.h"
#include "mesh.h"
#include "primal_newton.h"

using namespace pbd;
using namespace pbd::reference;

namespace {

/// Straight vertical chain of hard links below a fixed node (or between two if `closed`), equal masses but
/// the last.
Scene vertical_chain(int masses, double last, bool closed) {
  Scene scene;
  Distance links;
  add_node(scene, Vec3::Zero(), infinity);
  for (int i = 1; i <= masses + (closed ? 1 : 0); ++i) {
    add_node(scene, Vec3(0, 0, -i), i > masses ? infinity : i == masses ? last : 1);
    links.node.push_back({i - 1, i});
    links.rest_length.push_back(1);
    links.compliance.push_back(0);
  }
  scene.effects = {Gravity{}, links};
  return scene;
}

RelaxationRates rates_of(const Scene& scene) {
  return relaxation_rates(scene, scene.initial.x, 1.0 / 60);
}

}  // namespace

TEST_CASE("a chain's Jacobi radius is a cosine and Gauss-Seidel's its square") {
  for (const int links : {2, 5, 10, 20}) {
    // N links fixed at neither end have the tridiagonal matrix (-1, 2, -1).
    Scene scene = vertical_chain(links + 1, 1, false);
    auto& chain = std::get<Distance>(scene.effects[1]);
    chain.node.erase(chain.node.begin());
    chain.rest_length.pop_back(), chain.compliance.pop_back();
    const RelaxationRates rates = rates_of(scene);
    CHECK(rates.jacobi == Approx(chain_jacobi_radius(links)).epsilon(1e-12));
    CHECK(rates.gauss_seidel == Approx(std::pow(chain_jacobi_radius(links), 2)).epsilon(1e-10));
    CHECK(rates.condition == Approx((1 + rates.jacobi) / (1 - rates.jacobi)).epsilon(1e-10));
  }
}

TEST_CASE("a heavy last mass raises the condition number as stated") {
  const auto check = [](int masses, double last, double condition, double sweeps, double digits) {
    const RelaxationRates rates = rates_of(vertical_chain(masses, last, false));
    CHECK(rates.condition == Approx(condition).epsilon(digits));
    CHECK(iterations_per_decade(rates.gauss_seidel) == Approx(sweeps).epsilon(digits));
  };
  check(10, 1, 161.45, 92.94, 1e-4);
  check(10, 100, 3709.26, 2135.2, 1e-4);
  check(10, 1e4, 360109, 207295, 1e-4);
  check(20, 1800, 137282, 79026, 1e-4);
  check(50, 200, 42451, 24437, 1e-4);
}

TEST_CASE("compliance enters the relaxation's matrix as A/h^2") {
  Scene scene = vertical_chain(2, 1, false);
  const double h = 0.1, compliance = 0.003, sigma = compliance / (h * h);
  for (double& c : std::get<Distance>(scene.effects[1]).compliance) c = compliance;
  // N = [1, -1; -1, 2] + sigma I: eigenvalues of D^-1 N are 1 -+ 1/sqrt((1 + sigma)(2 + sigma)).
  const double radius = 1 / std::sqrt((1 + sigma) * (2 + sigma));
  const RelaxationRates rates = relaxation_rates(scene, scene.initial.x, h);
  CHECK(rates.jacobi == Approx(radius).epsilon(1e-12));
  CHECK(rates.gauss_seidel == Approx(radius * radius).epsilon(1e-12));
  CHECK(relaxation_rates(scene, scene.initial.x, h, 0.5).jacobi ==
        Approx(1 - 0.5 * (1 - radius)).epsilon(1e-12));
}

TEST_CASE("redundant links have an infinite condition number and corotational rows are refused") {
  Scene scene = vertical_chain(2, 1, false);
  scene.effects.push_back(scene.effects[1]);
  CHECK(std::isinf(rates_of(scene).condition));
  Scene solid;
  add_solid(solid, kuhn_grid({1, 1, 1}, Vec3::Ones()), 1000, {}, Strain::corotational);
  CHECK_THROWS_AS(rates_of(solid), SetupError);
}

TEST_CASE("a hanging pendulum's fixed point oscillates with the rate h^2 T/(m l)") {
  Scene scene = vertical_chain(1, 2, false);
  const double h = 0.1, tension = 2 * 9.81;
  const Judgement judged = primal_newton(scene, scene.initial, h);
  REQUIRE(judged.outcome == Outcome::ok);
  CHECK(-judged.multiplier(0) == Approx(tension).epsilon(1e-10));
  const Contraction rate = plain_contraction(scene, judged.x, judged.multiplier, h);
  CHECK(rate.smallest == Approx(-h * h * tension / (2 * 1)).epsilon(1e-10));
  CHECK(rate.radius() == Approx(h * h * tension / (2 * 1)).epsilon(1e-10));
}

TEST_CASE("the predicted rate is that of the plain fixed point iteration") {
  // Planar pendulum of mass m: x_{k+1} = y + n_k t with n_k . (x_{k+1} - p) = l, y the free step, n_k along
  // x_k - p.
  Scene scene = vertical_chain(1, 1, false);
  scene.initial.x.col(1) = Vec3(0.6, 0, -0.8);
  scene.initial.v.col(1) = Vec3(0.8, 0, 0.6) * 0.5;
  const double h = 0.2;
  const Judgement judged = primal_newton(scene, scene.initial, h);
  const Contraction rate = plain_contraction(scene, judged.x, judged.multiplier, h);
  const Vec3 free = scene.initial.x.col(1) + h * scene.initial.v.col(1) + h * h * Vec3(0, 0, -9.81);
  Vec3 x = judged.x.col(1) + Vec3(1e-5, 0, 0);
  Vec3 error = x - judged.x.col(1);
  double measured = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 n = x.normalized();
    x = free + n * (1 - n.dot(free));
    const Vec3 next = x - judged.x.col(1);
    measured = next.dot(error) / error.squaredNorm();
    error = next;
  }
  CHECK(measured == Approx(rate.smallest).epsilon(1e-4));
}

TEST_CASE("a stretched spring's fixed point has the rate of its geometric stiffness") {
  // Tension T = k (x - l) at length x: transverse rate -h^2 (T/x)/m, along it 0 (the material part is solved
  // exactly).
  Scene scene = vertical_chain(1, 2, false);
  std::get<Distance>(scene.effects[1]).compliance[0] = 1e-2;
  const double h = 0.1, length = 1.3, tension = 0.3 / 1e-2;
  Points x = scene.initial.x;
  x(2, 1) = -length;
  const Contraction rate = plain_contraction(scene, x, {}, h);
  CHECK(rate.smallest == Approx(-h * h * tension / length / 2).epsilon(1e-12));
  CHECK(rate.largest == Approx(0).margin(1e-12));
}

TEST_CASE("a spring across the motion slows the error by its material stiffness") {
  // Node held by a taut spring above (tension T, length x) and a relaxed one beside it (stiffness k): along
  // the second, rate -h^2 (T/x)/(m + h^2 k).
  Scene scene = vertical_chain(1, 2, false);
  auto& springs = std::get<Distance>(scene.effects[1]);
  add_node(scene, Vec3(1, 0, -1.3), infinity);
  springs.node.push_back({1, 2});
  springs.rest_length.push_back(1);
  springs.compliance = {1e-2, 1e-3};
  scene.initial.x(2, 1) = -1.3;
  const double h = 0.1, stiffness = 0.3 / 1e-2 / 1.3, along = -h * h * stiffness / (2 + h * h * 1e3);
  const double aside = -h * h * stiffness / 2;  // the third direction has no material stiffness
  const Contraction rate = plain_contraction(scene, scene.initial.x, {}, h);
  CHECK(rate.smallest == Approx(aside).epsilon(1e-12));
  // With the third direction held as well by a relaxed spring, only the damped rates are left.
  add_node(scene, Vec3(0, 1, -1.3), infinity);
  auto& held = std::get<Distance>(scene.effects[1]);
  held.node.push_back({1, 3});
  held.rest_length.push_back(1);
  held.compliance.push_back(1e-3);
  CHECK(plain_contraction(scene, scene.initial.x, {}, h).smallest == Approx(along).epsilon(1e-12));
}

// One corner of a corotational tetrahedron is pulled far away, the others are held. Plain with rows
// J = sym(R^T dF) of c = S - I, R from the polar decomposition of F = R S:
//   (M/h^2 + J^T K J) x' = M y/h^2 + J^T K (J x - c),  y the free end
TEST_CASE("the predicted rate is that of plain on a corotational tetrahedron") {
  const double h = 0.1, young = 1e5, poisson = 0.3;
  Scene scene;
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    add_node(scene, x, x.z() > 0 ? 20 : infinity);
  Eigen::Matrix<double, 3, 4> rest = scene.initial.x;
  scene.effects = {TetStrain{{{0, 1, 2, 3}}, {rest}, {young, poisson}, Strain::corotational},
                   ExternalForce{{3}, {Vec3(2000, 1000, 6000)}}};
  const Judgement judged = primal_newton(scene, scene.initial, h);
  REQUIRE(judged.outcome == Outcome::ok);
  const Contraction rate = plain_contraction(scene, judged.x, judged.multiplier, h);

  using Square = Eigen::Matrix<double, 6, 6>;
  Square compliance = Square::Zero();  // C^-1 over the volume, 1/6 m^3
  compliance.topLeftCorner<3, 3>().setConstant(-poisson);
  compliance.diagonal() << 1, 1, 1, 2 * (1 + poisson), 2 * (1 + poisson), 2 * (1 + poisson);
  const Square stiffness = inverse(compliance / young) / 6;
  const auto strain = [](const Eigen::Matrix3d& s) {
    const Eigen::Matrix3d e = (s + s.transpose()) / 2;
    return Eigen::Matrix<double, 6, 1>(e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(2, 0));
  };
  const double inertia = 20 / (h * h);
  const Vec3 end = judged.x.col(3);
  const Vec3 free = scene.initial.x.col(3) + Vec3(2000, 1000, 6000) / inertia;
  Vec3 x = end + Vec3(1e-3, -2e-3, 1e-3);
  double last = 0, measured = 0;
  for (int k = 0; k < 12; ++k) {
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();  // its third column is the corner
    f.col(2) = x;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d r = svd.matrixU() * svd.matrixV().transpose();
    Eigen::Matrix<double, 6, 3> j;
    for (int i = 0; i < 3; ++i) j.col(i) = strain(r.transpose() * Vec3::Unit(i) * Vec3::UnitZ().transpose());
    const auto c = strain(r.transpose() * f - Eigen::Matrix3d::Identity());
    const Eigen::Matrix3d left = inertia * Eigen::Matrix3d::Identity() + j.transpose() * stiffness * j;
    x = solve_definite(left, Eigen::VectorXd(inertia * free + j.transpose() * stiffness * (j * x - c)));
    measured = (x - end).norm() / last;
    last = (x - end).norm();
  }
  CHECK(last < 1e-3);
  CHECK(rate.radius() > 0.01);
  CHECK(measured == Approx(rate.radius()).epsilon(1e-3));
}

// A rod of mass m and length l hangs from a ball at its end: turns about it have the inertia I = m l^2/3 and
// the stiffness m g l/2, and nothing else is left.
TEST_CASE("a hanging rod contracts by its weight over its inertia about the joint") {
  const double m = 2, l = 0.6, g = 9.81, h = 1.0 / 30;
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3(0, 0, -l / 2), m, Vec3(m * l * l / 12, m * l * l / 12, 1e-3));
  scene.effects = {Gravity{Vec3(0, 0, -g)}, PointJoint{{{0, 1}}, {{Vec3::Zero(), Vec3(0, 0, l / 2)}}, {0}}};
  const auto hanging = primal_newton(scene, scene.initial, h);
  REQUIRE(hanging.outcome == Outcome::ok);
  const Contraction found = plain_contraction_of_bodies(scene, scene.initial, h, hanging);
  CHECK(found.smallest == Approx(-h * h * (m * g * l / 2) / (m * l * l / 3)).epsilon(1e-10));
  CHECK(std::abs(found.largest) < 1e-10);
  // By a stiff ball likewise, but for what it gives way.
  std::get<PointJoint>(scene.effects[1]).compliance = {1e-9};
  const auto soft = primal_newton(scene, scene.initial, h);
  CHECK(plain_contraction_of_bodies(scene, scene.initial, h, soft).smallest ==
        Approx(found.smallest).epsilon(1e-6));
  scene.effects.emplace_back(Gyroscopic{});
  CHECK_THROWS_AS(plain_contraction_of_bodies(scene, scene.initial, h, hanging), SetupError);
}

// A hard joint turns a body by t = h w. Its rows are linear in the turns as the body stands, which change by
// J_r(t) of what h w does: the error map is 1 - J_r(t).
TEST_CASE("a hard motor's turn is missed by half a step's angle at most") {
  const double h = 0.1, w = 4;
  Scene scene;
  add_body(scene, Vec3::Zero(), infinity, Vec3::Constant(infinity));
  add_body(scene, Vec3::Zero(), 1, Vec3(1, 1, 1), Eigen::Quaterniond::Identity(), Vec3::Zero(),
           Vec3(0, 0, w));
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(w * h, Vec3::UnitZ()));
  scene.effects = {RotationJoint{{{0, 1}}, {turned}, {0}}};
  const auto solved = primal_newton(scene, scene.initial, h);
  REQUIRE(solved.outcome == Outcome::ok);
  // J_r(t) = 1 - (1 - cos t)/t [u]x + (1 - sin t/t) [u]x^2, across the axis 1 - sin t/t +- i (1 - cos t)/t.
  const double t = w * h, across = std::hypot(1 - std::sin(t) / t, (1 - std::cos(t)) / t);
  CHECK(plain_contraction_of_bodies(scene, scene.initial, h, solved).radius() ==
        Approx(across).epsilon(1e-10));
  CHECK(across < t / 2);
}
