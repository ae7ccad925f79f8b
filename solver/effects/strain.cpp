// Of strain what asks for eigenvalues and inverses, apart from the headers since those take long to compile.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "effects/tet_strain.h"
#include "effects/triangle_strain.h"

namespace pbd {
namespace {

template <class Gradients, class Square>
Eigen::Matrix<double, 1, Gradients::RowsAtCompileTime> bound(const Gradients& y, const Square& stress) {
  const Eigen::SelfAdjointEigenSolver<Square> eigen(stress);
  const Gradients directions = y * eigen.eigenvectors();
  const auto tension = eigen.eigenvalues().cwiseMax(0.0).eval();
  return (directions * tension.asDiagonal() * directions.transpose()).cwiseAbs().rowwise().sum().transpose();
}

}  // namespace

Eigen::Matrix<double, 1, 3> stress_bound(const Eigen::Matrix<double, 3, 2>& y,
                                         const Eigen::Matrix2d& stress) {
  return bound(y, stress);
}

Eigen::Matrix<double, 1, 4> stress_bound(const Eigen::Matrix<double, 4, 3>& y,
                                         const Eigen::Matrix3d& stress) {
  return bound(y, stress);
}

Constraint<TriangleStrain>::Square Constraint<TriangleStrain>::retardation(const TriangleStrain& effect,
                                                                           std::size_t) {
  return inverse_elasticity(effect.material.poisson) * inverse_elasticity(effect.damping->poisson).inverse() *
         (effect.damping->young / effect.material.young);
}

Constraint<TetStrain>::Square Constraint<TetStrain>::retardation(const TetStrain& effect, std::size_t) {
  return inverse_elasticity(effect.material.poisson) * inverse_elasticity(effect.damping->poisson).inverse() *
         (effect.damping->young / effect.material.young);
}

Constraint<TetStrain>::NodeBounds Constraint<TetStrain>::geometric_bound(const TetStrain& effect,
                                                                         std::size_t i, const Positions& x,
                                                                         const Value& impulse) {
  if (effect.strain == Strain::linear) return NodeBounds::Zero();
  const Eigen::Matrix3d stress = symmetric(impulse);
  const Eigen::Matrix3d inverse = inverse_rest(effect, i);
  if (effect.strain == Strain::green) return stress_bound(gradients(inverse), Eigen::Matrix3d(-stress));
  const Eigen::Matrix3d f = (x.rightCols<3>().colwise() - x.col(0)) * inverse;
  const Eigen::Matrix3d stretch = polar_rotation(f).transpose() * f;
  using Eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
  const Eigen::Matrix3d symmetric = (stretch + stretch.transpose()) / 2;
  const double pair =
      symmetric.trace() - Eigenvalues(symmetric, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
  constexpr double least_pair = 0.1;
  const Vec3 tension = Eigenvalues(-stress, Eigen::EigenvaluesOnly).eigenvalues();
  double largest = 0;
  for (int a = 0; a < 3; ++a) {
    const double one = tension[a], other = tension[(a + 1) % 3];
    largest = std::max(largest, (one + other + std::sqrt(2 * (one * one + other * other))) / 2);
  }
  return stress_bound(gradients(inverse),
                      Eigen::Matrix3d(largest / std::max(pair, least_pair) * Eigen::Matrix3d::Identity()));
}

}  // namespace pbd
