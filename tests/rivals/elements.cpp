// Derivatives of every element against finite differences, and its projected stiffness for any deformation.
#include <catch2/catch.hpp>
#include <functional>
#include <random>

#include "dense.h"
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

using Matrix = Eigen::MatrixXd;  // of positions and gradients: one column a node

/// An element as functions of matrices of any size, so that what checks it is compiled once.
struct AnyElement {
  std::string_view name;
  int nodes;
  bool curved;  // its stiffness has a part that projection takes away
  std::function<double(const Matrix& x, Matrix& gradient)> energy;
  std::function<Matrix(const Matrix& x, bool projected)> stiffness;
};

template <class Element>
AnyElement any(std::string_view name, bool curved, const Element& element = sample<Element>()) {
  constexpr int nodes = Element::nodes;
  const auto energy = [element](const Matrix& x, Matrix& gradient) {
    Nodes<nodes> found;
    const double value = element.energy(x, found);
    gradient = found;
    return value;
  };
  const auto stiffness = [element](const Matrix& x, bool projected) {
    Matrix result(x.size(), x.size());
    const auto block = element.stiffness(x, projected);
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) result.block<3, 3>(3 * a, 3 * b) = block(a, b);
    return result;
  };
  return {name, nodes, curved, energy, stiffness};
}

const AnyElement bent_hinge = any<HingeElement>("hinge", false);

/// All but the hinge, whose stiffness is the energy's second derivative only where it is straight.
std::vector<AnyElement> elements() {
  return {any<AnchorElement>("anchor", false),
          any<SpringElement>("spring", true),
          any<GreenElement<2>>("green triangle", true),
          any<GreenElement<3>>("green", true),
          any<CorotationalElement>("corotational", true),
          any<LinearElement>("linear", false)};
}

/// Corners of the unit tetrahedron, deformed: `stretch` along all axes, then every coordinate by up to
/// `noise` m.
Matrix deformed(int nodes, std::mt19937& random, double stretch, double noise) {
  std::uniform_real_distribution<double> uniform(-noise, noise);
  Matrix corner = Matrix::Zero(3, 4);
  corner.rightCols(3).setIdentity();
  Matrix x = stretch * corner.leftCols(nodes);
  for (double& entry : x.reshaped()) entry += uniform(random);
  return x;
}

constexpr double nudge = 1e-5;  // m: differences are right to its square

void check_gradient(const AnyElement& element, const Matrix& x) {
  INFO(element.name);
  Matrix gradient, unused, differences(3, element.nodes);
  element.energy(x, gradient);
  for (int i = 0; i < x.size(); ++i) {
    Matrix plus = x, minus = x;
    plus(i) += nudge, minus(i) -= nudge;
    differences(i) = (element.energy(plus, unused) - element.energy(minus, unused)) / (2 * nudge);
  }
  CHECK((gradient - differences).norm() <= 1e-6 * gradient.norm());
}

void check_stiffness(const AnyElement& element, const Matrix& x, bool projected) {
  INFO(element.name);
  const Matrix K = element.stiffness(x, projected);
  Matrix differences(K.rows(), K.cols());
  for (int i = 0; i < x.size(); ++i) {
    Matrix plus = x, minus = x, high, low;
    plus(i) += nudge, minus(i) -= nudge;
    element.energy(plus, high), element.energy(minus, low);
    differences.col(i) = (high - low).reshaped() / (2 * nudge);
  }
  CHECK((K - differences).norm() <= 1e-6 * K.norm());
}

/// Relative to the norm.
double smallest_eigenvalue(const Matrix& K) {
  CHECK((K - K.transpose()).norm() <= 1e-12 * K.norm());
  return reference::symmetric_eigen(K).values(0) / (K.norm() + 1e-300);
}

}  // namespace

TEST_CASE("gradient and stiffness are the energy's derivatives") {
  std::mt19937 random(1);
  for (const AnyElement& element : elements())
    for (int i = 0; i < 20; ++i) {
      const Matrix x = deformed(element.nodes, random, 1, 0.3);
      check_gradient(element, x);
      check_stiffness(element, x, false);
    }
}

TEST_CASE("nothing is projected in tension") {
  std::mt19937 random(2);
  for (const AnyElement& element : elements())
    for (int i = 0; i < 20; ++i) check_stiffness(element, deformed(element.nodes, random, 2, 0.05), true);
}

TEST_CASE("projected stiffness is positive semidefinite") {
  std::mt19937 random(3);
  std::vector<AnyElement> all = elements();
  all.push_back(bent_hinge);
  for (const AnyElement& element : all) {
    INFO(element.name);
    double smallest = 0, unprojected = 0;
    for (int i = 0; i < 300; ++i) {
      const Matrix x = deformed(element.nodes, random, i % 2 ? 1 : -0.3, 0.8);
      smallest = std::min(smallest, smallest_eigenvalue(element.stiffness(x, true)));
      unprojected = std::min(unprojected, smallest_eigenvalue(element.stiffness(x, false)));
    }
    CHECK(smallest >= -1e-13);
    if (element.curved) CHECK(unprojected < -1e-3);  // the deformations were hard enough
  }
}

TEST_CASE("a hinge's gradient is its energy's derivative, its stiffness that of a straightened one") {
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    Matrix x = deformed(4, random, 1, 0.1);
    x.col(2) = Vec3(0.3, 1, 0.2) + 0.3 * x.col(2);
    x.col(3) = Vec3(0.4, -1, 0.1) + 0.3 * x.col(3);
    check_gradient(bent_hinge, x);
    Nodes<4> unused;
    HingeElement straight{0, 10};
    straight.rest = straight.angle(x, unused);
    check_stiffness(any("straight hinge", false, straight), x, false);
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
