// Where bounds are met and elements are inverted.
#include <catch2/catch.hpp>

#include "dense.h"
#include "effects/effects.h"
#include "samples.h"

using namespace pbd;
using namespace pbd::test;

TEST_CASE("an inverted tetrahedron is mirrored along its shortest axis") {
  // The rotation nearest to F, det F < 0, mirrors the principal axis of the least stretch: R^T F has it
  // negative.
  TetStrain effect = sample<TetStrain>();
  effect.strain = Strain::corotational;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (int shortest = 0; shortest < 3; ++shortest) {
    Vec3 stretch(1.2, 0.9, 1.05);
    stretch[shortest] = -0.5;
    Eigen::Matrix<double, 6, 1> expected;
    expected << stretch - Vec3::Ones(), Vec3::Zero();
    const Eigen::Matrix<double, 3, 4> x = turn * stretch.asDiagonal() * effect.rest[0];
    CHECK((value_at(effect, x) - expected).norm() < 1e-13);
  }
}

TEST_CASE("the bound of a hinge holds where it is bent most") {
  // A narrow wing bends most at its own corner, where the bound, rows' sums, is nearly its stiffness.
  using C = Constraint<Bending>;
  const Bending effect = sample<Bending>();
  Eigen::Matrix<double, 3, 4> x;
  x << 0, 1, 0.9, 1.9, 0, 0, 9.6, 0, 0, 0, 0, 0.05;
  for (const double impulse : {1.0, -1.0}) {
    const C::Value p = C::Value::Constant(impulse);
    Eigen::MatrixXd turned(12, 12);
    for (int k = 0; k < 12; ++k) {
      constexpr double difference = 1e-6;
      Eigen::VectorXd sides[2];
      for (const int side : {0, 1}) {
        C::Positions moved = x;
        moved.reshaped()[k] += side == 0 ? -difference : difference;
        C::Value value;
        C::Jacobian jacobian;
        C::evaluate(effect, 0, moved, value, jacobian);
        sides[side] = jacobian.transpose() * p;
      }
      turned.col(k) = (sides[1] - sides[0]) / (2 * difference);
    }
    const Eigen::MatrixXd stiffness = -(turned + turned.transpose()) / 2;
    const auto bound = C::geometric_bound(effect, 0, x, p);
    Eigen::VectorXd root(12);
    for (int k = 0; k < 12; ++k) root[k] = 1 / std::sqrt(bound[k / 3]);
    const Eigen::MatrixXd share = root.asDiagonal() * stiffness * root.asDiagonal();
    const double largest = reference::symmetric_eigen(share).values.maxCoeff();
    CHECK(largest <= 1 + 1e-6);
    CHECK(largest > 0.9);
  }
}
