#include "effects/effects.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "dense.h"
#include "rows/effect_constraint.h"
#include "samples.h"

using namespace pbd;
using namespace pbd::test;

namespace {

constexpr double difference_step = 1e-6;

/// Central differences of a vector function of the constraint's positions.
template <class C, class F>
auto differences(typename C::Positions x, F&& f) {
  using Result = Eigen::MatrixXd;
  Result derivative(f(x).size(), x.size());
  for (int k = 0; k < x.size(); ++k) {
    const double middle = x.reshaped()[k];
    x.reshaped()[k] = middle + difference_step;
    const Eigen::VectorXd above = f(x);
    x.reshaped()[k] = middle - difference_step;
    derivative.col(k) = (above - f(x)) / (2 * difference_step);
    x.reshaped()[k] = middle;
  }
  return derivative;
}

template <class E>
void check_jacobian(const E& effect) {
  using C = Constraint<E>;
  for (int seed = 0; seed < 20; ++seed) {
    const auto x = bent_positions<C::nodes>(seed);
    typename C::Value value;
    typename C::Jacobian jacobian;
    C::evaluate(effect, 0, x, value, jacobian);
    const Eigen::MatrixXd expected =
        differences<C>(x, [&](const auto& at) -> Eigen::VectorXd { return value_at(effect, at); });
    INFO(effect.name << ", seed " << seed);
    CHECK((jacobian - expected).cwiseAbs().maxCoeff() < 1e-7);
  }
}

template <class E>
void check_if_rows() {
  if constexpr (RowEffect<E> && !BodyEffect<E>) check_jacobian(sample<E>());
}

template <class... E>
void check_all(const std::variant<E...>*) {
  (check_if_rows<E>(), ...);
}

/// Symmetric part of the geometric stiffness -sum_r p_r d2c_r/dx2, by central differences of J^T p.
template <class E>
Eigen::MatrixXd geometric_stiffness(const E& effect, const typename Constraint<E>::Positions& x,
                                    const typename Constraint<E>::Value& impulse) {
  using C = Constraint<E>;
  const Eigen::MatrixXd turned = differences<C>(x, [&](const auto& at) -> Eigen::VectorXd {
    typename C::Value value;
    typename C::Jacobian jacobian;
    C::evaluate(effect, 0, at, value, jacobian);
    return jacobian.transpose() * impulse;
  });
  return -(turned + turned.transpose()) / 2;
}

/// The bound holds for impulses of every sign, is zero where there are none, and is not idle: somewhere the
/// stiffness reaches a tenth of it.
template <class E>
void check_geometric_bound(const E& effect, bool elastic_impulses) {
  using C = Constraint<E>;
  double tightest = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const auto x = bent_positions<C::nodes>(seed);
    typename C::Value impulse;
    for (int r = 0; r < C::rows; ++r) impulse[r] = std::sin(3.7 * seed + 1.9 * r + 0.4);
    if (elastic_impulses)
      impulse = (seed % 2 ? 1 : -1) * typename C::Square(reference::inverse(compliance_of(effect, 0))) *
                value_at(effect, x);
    const auto bound = C::geometric_bound(effect, 0, x, impulse);
    Eigen::VectorXd diagonal(3 * C::nodes);
    for (int k = 0; k < diagonal.size(); ++k) diagonal[k] = bound[k / 3];
    const Eigen::MatrixXd stiffness = geometric_stiffness(effect, x, impulse);
    const double rounding = 1e-6 * stiffness.norm();
    const Eigen::MatrixXd left = Eigen::MatrixXd(diagonal.asDiagonal()) - stiffness;
    INFO(effect.name << ", seed " << seed);
    CHECK(reference::symmetric_eigen(left).values.minCoeff() >= -rounding);
    CHECK(C::geometric_bound(effect, 0, x, C::Value::Zero()).isZero(0));
    if (bound.minCoeff() > 0) {
      const Eigen::VectorXd root = diagonal.cwiseSqrt().cwiseInverse();
      const Eigen::MatrixXd share = root.asDiagonal() * stiffness * root.asDiagonal();
      tightest = std::max(tightest, reference::symmetric_eigen(share).values.maxCoeff());
    }
  }
  if constexpr (!std::is_same_v<E, Anchor>) CHECK(tightest > 0.1);
}

/// All of the geometric stiffness is what differences give. The convex part holds for every impulse: it is
/// all where that is all `tension`, else what is left of it is no more, and it is nowhere negative.
template <class E>
void check_stated_stiffness(const E& effect, const typename Constraint<E>::Value& tension) {
  using C = Constraint<E>;
  for (int seed = 0; seed < 40; ++seed) {
    const auto x = bent_positions<C::nodes>(seed);
    typename C::Value impulse;
    for (int r = 0; r < C::rows; ++r) impulse[r] = std::sin(3.7 * seed + 1.9 * r + 0.4);
    const Eigen::MatrixXd own = C::geometric_stiffness(effect, 0, x, impulse, true),
                          stated = C::geometric_stiffness(effect, 0, x, impulse, false),
                          whole = geometric_stiffness(effect, x, impulse),
                          taut = geometric_stiffness(effect, x, tension);
    const double rounding = 1e-6 * whole.norm();
    INFO(effect.name << ", seed " << seed);
    CHECK(reference::symmetric_eigen(own).values.minCoeff() >= -rounding);
    CHECK(reference::symmetric_eigen(own - whole).values.minCoeff() >= -rounding);
    CHECK((stated - whole).norm() <= rounding);
    CHECK((C::geometric_stiffness(effect, 0, x, tension, true) - taut).norm() <= 1e-6 * taut.norm());
    CHECK(C::geometric_stiffness(effect, 0, x, -tension, true).isZero(0));
  }
}

template <class... E>
void check_all_bounds(const std::variant<E...>*) {
  const auto check = []<class Each>(const Each* none) {
    if constexpr (RowEffect<Each> && !BodyEffect<Each>)  // joints.cpp has those of bodies
      check_geometric_bound(sample<Each>(), false);
    else
      static_cast<void>(none);
  };
  (check(static_cast<const E*>(nullptr)), ...);
}

}  // namespace

TEST_CASE("the geometric bounds of all effects bound their geometric stiffness") {
  check_all_bounds(static_cast<Effect*>(nullptr));
}

TEST_CASE("what links and triangles state is their geometric stiffness, its convex part that of tension") {
  check_stated_stiffness(sample<Distance>(), Constraint<Distance>::Value(-0.7));
  check_stated_stiffness(sample<TriangleStrain>(), {-0.7, -0.4, 0.5});
}

TEST_CASE("the geometric bound of corotational strain holds for the stresses of its strain") {
  TetStrain effect = sample<TetStrain>();
  effect.strain = Strain::corotational;
  check_geometric_bound(effect, true);
}

TEST_CASE("Jacobians of all effects equal central differences") {
  check_all(static_cast<Effect*>(nullptr));
}

TEST_CASE("the Jacobian of linear strain equals central differences") {
  TetStrain effect = sample<TetStrain>();
  effect.strain = Strain::linear;
  check_jacobian(effect);
}

TEST_CASE("for corotational strain, J^T A^-1 c is the gradient of the energy 1/2 c^T A^-1 c") {
  using C = Constraint<TetStrain>;
  TetStrain effect = sample<TetStrain>();
  effect.strain = Strain::corotational;
  const Eigen::Matrix<double, 6, 6> stiffness = reference::inverse(compliance_of(effect, 0));
  for (int seed = 0; seed < 20; ++seed) {
    const auto x = bent_positions<4>(seed);
    C::Value value;
    C::Jacobian jacobian;
    C::evaluate(effect, 0, x, value, jacobian);
    const Eigen::MatrixXd expected = differences<C>(x, [&](const auto& at) -> Eigen::VectorXd {
      const C::Value c = value_at(effect, at);
      return Eigen::VectorXd::Constant(1, 0.5 * c.dot(stiffness * c));
    });
    const Eigen::RowVectorXd gradient = value.transpose() * stiffness * jacobian;
    CHECK((gradient - expected).norm() < 1e-7 * gradient.norm());
  }
}

TEST_CASE("strains of known deformations") {
  const TetStrain green = sample<TetStrain>();
  TetStrain corotational = green;
  corotational.strain = Strain::corotational;
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  SECTION("a rotated rest state has none") {
    CHECK(value_at(green, turn * green.rest[0]).norm() < 1e-14);
    CHECK(value_at(corotational, turn * green.rest[0]).norm() < 1e-14);
  }
  SECTION("simple shear g: green e_xy = g/2, e_yy = g^2/2, engineering shear doubled") {
    const double g = 0.3;
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    f(0, 1) = g;
    Eigen::Matrix<double, 6, 1> expected;
    expected << 0, g * g / 2, 0, g, 0, 0;
    CHECK((value_at(green, f * green.rest[0]) - expected).norm() < 1e-14);
  }
  SECTION("corotational strain of a rotated stretch is the stretch's") {
    const Vec3 stretch(1.2, 0.9, 1.05);
    Eigen::Matrix<double, 6, 1> expected;
    expected << 0.2, -0.1, 0.05, 0, 0, 0;
    CHECK((value_at(corotational, turn * stretch.asDiagonal() * green.rest[0]) - expected).norm() < 1e-14);
  }
  SECTION("a mirrored tetrahedron is far from rest") {
    const Eigen::Matrix3d mirror = Vec3(1, 1, -1).asDiagonal();
    CHECK(value_at(corotational, mirror * green.rest[0]).norm() > 1);
  }
}

TEST_CASE("compliances invert the energy of isotropic elasticity") {
  // Energy density mu e:e + lambda/2 tr(e)^2 with Lame's constants, against 1/2 c^T A^-1 c / volume.
  const TetStrain effect = sample<TetStrain>();
  const auto [young, nu] = effect.material;
  const double mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
  const Eigen::Matrix<double, 6, 6> stiffness = reference::inverse(compliance_of(effect, 0));
  Eigen::Matrix<double, 6, 1> c;
  c << 0.01, -0.02, 0.03, 0.04, -0.05, 0.06;
  const double squares = c.head<3>().squaredNorm() + c.tail<3>().squaredNorm() / 2;
  const double density = mu * squares + lambda / 2 * std::pow(c.head<3>().sum(), 2);
  CHECK(0.5 * c.dot(stiffness * c) == Approx(density * tet_volume(effect.rest[0])).epsilon(1e-12));
}

TEST_CASE("a triangle's compliance inverts the energy of plane stress") {
  // Energy per rest area t Y/(2 (1-nu^2)) (uu^2 + vv^2 + 2 nu uu vv + (1-nu)/2 (2 uv)^2), t the thickness.
  const TriangleStrain effect = sample<TriangleStrain>();
  const auto [young, nu] = effect.material;
  const Eigen::Matrix3d stiffness = reference::inverse(compliance_of(effect, 0));
  const Vec3 c(0.01, -0.02, 0.05);
  const double squares = c[0] * c[0] + c[1] * c[1] + 2 * nu * c[0] * c[1] + (1 - nu) / 2 * c[2] * c[2];
  const double density = effect.thickness * young / (2 * (1 - nu * nu)) * squares;
  const double area = (effect.rest[0].col(1) - effect.rest[0].col(0))
                          .cross(effect.rest[0].col(2) - effect.rest[0].col(0))
                          .norm() /
                      2;
  CHECK(0.5 * c.dot(stiffness * c) == Approx(density * area).epsilon(1e-12));
}

TEST_CASE("bending past the folded state takes the short way round") {
  // The second wing turns about the edge from -3 to 3 rad: through the fold at pi that is -(2 pi - 6) rad.
  const auto hinge = [](double turn) {
    Eigen::Matrix<double, 3, 4> x;
    x << 0, 0, -1, std::cos(turn), 0, 1, 0.5, 0.5, 0, 0, 0, std::sin(turn);
    return x;
  };
  Bending effect = sample<Bending>();
  effect.rest_angle[0] = dihedral_angle(hinge(-3));
  const double orientation = dihedral_angle(hinge(1)) > 0 ? 1 : -1;
  const double expected = -orientation * (2 * std::numbers::pi - 6);
  CHECK(value_at(effect, hinge(3))[0] == Approx(expected).epsilon(1e-13));
}
