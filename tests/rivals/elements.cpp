// Derivatives of every element against finite differences, and its projected stiffness for any deformation.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

#include "rivals/solids.h"

using namespace pbd;
using namespace pbd::rivals;

namespace {

template <int D>
Simplex<D> sample_simplex() {
  Eigen::Matrix3d edges;
  edges << 1.1, 0.2, 0.1, 0.1, 0.9, -0.1, 0.2, -0.1, 1.2;
  const Eigen::Matrix<double, D, D> used = edges.topLeftCorner<D, D>();
  Simplex<D> simplex{{}, 700, 400};
  simplex.shape.template rightCols<D>() = used.inverse().transpose();
  simplex.shape.col(0) = -simplex.shape.template rightCols<D>().rowwise().sum();
  return simplex;
}

template <class Element>
Element sample();
template <>
AnchorElement sample() {
  return {Vec3(0.1, -0.2, 0.3), 1e3};
}
template <>
SpringElement sample() {
  return {0.9, 1e3};
}
template <>
HingeElement sample() {
  return {0.4, 10};
}
template <>
GreenElement<2> sample() {
  return {sample_simplex<2>()};
}
template <>
GreenElement<3> sample() {
  return {sample_simplex<3>()};
}
template <>
CorotationalElement sample() {
  return {sample_simplex<3>()};
}
template <>
LinearElement sample() {
  return {sample_simplex<3>()};
}

/// Corners of the unit tetrahedron, deformed: `stretch` along all axes, then every coordinate by up to
/// `noise` m.
template <int K>
Nodes<K> deformed(std::mt19937& random, double stretch, double noise) {
  std::uniform_real_distribution<double> uniform(-noise, noise);
  Nodes<4> corner = Nodes<4>::Zero();
  corner.rightCols<3>().setIdentity();
  Nodes<K> x = stretch * corner.leftCols<K>();
  for (double& entry : x.reshaped()) entry += uniform(random);
  return x;
}

template <class Element>
Eigen::MatrixXd stiffness(const Element& element, const Nodes<Element::nodes>& x, bool projected) {
  Eigen::MatrixXd result(x.size(), x.size());
  const auto block = element.stiffness(x, projected);
  for (int a = 0; a < Element::nodes; ++a)
    for (int b = 0; b < Element::nodes; ++b) result.block<3, 3>(3 * a, 3 * b) = block(a, b);
  return result;
}

constexpr double nudge = 1e-5;  // m: differences are right to its square

template <class Element>
void check_gradient(const Element& element, const Nodes<Element::nodes>& x) {
  Nodes<Element::nodes> gradient, unused, differences;
  element.energy(x, gradient);
  for (int i = 0; i < x.size(); ++i) {
    Nodes<Element::nodes> plus = x, minus = x;
    plus(i) += nudge, minus(i) -= nudge;
    differences(i) = (element.energy(plus, unused) - element.energy(minus, unused)) / (2 * nudge);
  }
  CHECK((gradient - differences).norm() <= 1e-6 * gradient.norm());
}

template <class Element>
void check_stiffness(const Element& element, const Nodes<Element::nodes>& x, bool projected) {
  const Eigen::MatrixXd K = stiffness(element, x, projected);
  Eigen::MatrixXd differences(K.rows(), K.cols());
  for (int i = 0; i < x.size(); ++i) {
    Nodes<Element::nodes> plus = x, minus = x, high, low;
    plus(i) += nudge, minus(i) -= nudge;
    element.energy(plus, high), element.energy(minus, low);
    differences.col(i) = (high - low).reshaped() / (2 * nudge);
  }
  CHECK((K - differences).norm() <= 1e-6 * K.norm());
}

/// Relative to the norm.
double smallest_eigenvalue(const Eigen::MatrixXd& K) {
  CHECK((K - K.transpose()).norm() <= 1e-12 * K.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()(0) / (K.norm() + 1e-300);
}

}  // namespace

TEMPLATE_TEST_CASE("gradient and stiffness are the energy's derivatives", "", AnchorElement, SpringElement,
                   GreenElement<2>, GreenElement<3>, CorotationalElement, LinearElement) {
  std::mt19937 random(1);
  const auto element = sample<TestType>();
  for (int i = 0; i < 20; ++i) {
    const auto x = deformed<TestType::nodes>(random, 1, 0.3);
    check_gradient(element, x);
    check_stiffness(element, x, false);
  }
}

TEMPLATE_TEST_CASE("nothing is projected in tension", "", AnchorElement, SpringElement, GreenElement<2>,
                   GreenElement<3>, CorotationalElement, LinearElement) {
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i)
    check_stiffness(sample<TestType>(), deformed<TestType::nodes>(random, 2, 0.05), true);
}

TEMPLATE_TEST_CASE("projected stiffness is positive semidefinite", "", AnchorElement, SpringElement,
                   HingeElement, GreenElement<2>, GreenElement<3>, CorotationalElement, LinearElement) {
  std::mt19937 random(3);
  const auto element = sample<TestType>();
  double smallest = 0, unprojected = 0;
  for (int i = 0; i < 300; ++i) {
    const auto x = deformed<TestType::nodes>(random, i % 2 ? 1 : -0.3, 0.8);
    smallest = std::min(smallest, smallest_eigenvalue(stiffness(element, x, true)));
    unprojected = std::min(unprojected, smallest_eigenvalue(stiffness(element, x, false)));
  }
  CHECK(smallest >= -1e-13);
  const bool curved = !std::is_same_v<TestType, AnchorElement> && !std::is_same_v<TestType, HingeElement> &&
                      !std::is_same_v<TestType, LinearElement>;
  if (curved) CHECK(unprojected < -1e-3);  // the deformations were hard enough
}

TEST_CASE("a hinge's gradient is its energy's derivative, its stiffness that of a straightened one") {
  std::mt19937 random(4);
  HingeElement hinge = sample<HingeElement>();
  for (int i = 0; i < 20; ++i) {
    auto x = deformed<4>(random, 1, 0.1);
    x.col(2) = Vec3(0.3, 1, 0.2) + 0.3 * x.col(2);
    x.col(3) = Vec3(0.4, -1, 0.1) + 0.3 * x.col(3);
    check_gradient(hinge, x);
    Nodes<4> unused;
    HingeElement straight{0, 10};
    straight.rest = straight.angle(x, unused);
    check_stiffness(straight, x, false);
  }
}

TEST_CASE("polar decomposition") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 300; ++i) {
    Mat3 F = Mat3::Identity() * (i % 3);
    for (double& entry : F.reshaped()) entry += uniform(random);
    const Polar p = polar(F);
    CHECK((p.rotation * p.rotation.transpose() - Mat3::Identity()).norm() < 1e-13);
    CHECK(p.rotation.determinant() > 0);
    CHECK((p.rotation * p.axes * p.stretch.asDiagonal() * p.axes.transpose() - F).norm() < 1e-13 * F.norm());
    CHECK(std::abs(p.stretch(0)) <= p.stretch(1));
    CHECK(p.stretch(1) <= p.stretch(2));
  }
}
