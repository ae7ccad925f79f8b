// c = strain (xx, yy, zz, 2 xy, 2 yz, 2 zx) of a linear tetrahedron. F = Ds Dm^-1, Ds = [x1-x0, x2-x0,
// x3-x0], Dm its rest; y_1..y_3 the rows of Dm^-1, y_0 = -(y_1 + y_2 + y_3). With T the matrix whose columns
// enter the gradient,
//   linear        e = (F + F^T)/2 - I          T = I
//   corotational  e = (R^T F + F^T R)/2 - I    T = R, the polar rotation of F
//   green         e = (F^T F - I)/2            T = F
//   de_aa/dx_i = y_i[a] T_a^T,  d(2 e_ab)/dx_i = y_i[b] T_a^T + y_i[a] T_b^T.
// For `corotational` this holds R fixed: single rows are not dc/dx, but J^T p is the exact energy gradient
// wherever p is an isotropic stress of e, since that commutes with the stretch. A = C^-1/volume (Servin et
// al. 2006).
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "effects/constraint.h"
#include "effects/polar.h"
#include "mesh.h"

namespace pbd {

template <>
struct Constraint<TetStrain> : ConstraintShape<6, 4> {
  static constexpr bool fills_space = true;
  static constexpr bool one_material = true;

  static Nodes node(const TetStrain& effect, std::size_t i) { return effect.node[i]; }
  static const Positions& rest(const TetStrain& effect, std::size_t i) { return effect.rest[i]; }

  static Square compliance(const TetStrain& effect, std::size_t i) {
    return inverse_elasticity(effect.material.poisson) / (effect.material.young * tet_volume(effect.rest[i]));
  }

  /// C^-1 C_d
  static Square retardation(const TetStrain& effect, std::size_t);

  /// Dm^-1, F and T at positions x, and from them c and J^T p without J.
  struct Deformation {
    Eigen::Matrix3d inverse, f, t;
  };

  static Deformation deformation(const TetStrain& effect, std::size_t i, const Positions& x) {
    const Eigen::Matrix3d inverse = inverse_rest(effect, i);
    const Eigen::Matrix3d f = (x.rightCols<3>().colwise() - x.col(0)) * inverse;
    return {inverse, f, directions(effect.strain, f)};
  }

  static Value strain(const TetStrain& effect, const Deformation& at) {
    const Eigen::Matrix3d stretch = at.t.transpose() * at.f;
    const Eigen::Matrix3d twice = stretch + stretch.transpose();
    Value value;
    value << twice.diagonal() / 2, twice(0, 1), twice(1, 2), twice(2, 0);
    if (effect.strain == Strain::green) value /= 2;
    value.head<3>().array() -= effect.strain == Strain::green ? 0.5 : 1.0;
    return value;
  }

  /// T S Y^T, S the impulses as a symmetric matrix.
  static Positions push(const Deformation& at, const Value& impulse) {
    const Eigen::Matrix3d stress = symmetric(impulse);
    Positions pushed;
    pushed.rightCols<3>().noalias() = at.t * stress * at.inverse.transpose();
    pushed.col(0) = -pushed.rightCols<3>().rowwise().sum();
    return pushed;
  }

  /// Volume times what its material's rotation is the polar part of, m^3.
  static Eigen::Matrix3d turning(const TetStrain& effect, std::size_t i, const Positions& x) {
    const Eigen::Matrix3d f = (x.rightCols<3>().colwise() - x.col(0)) * inverse_rest(effect, i);
    return tet_volume(effect.rest[i]) * (effect.strain == Strain::linear ? Eigen::Matrix3d::Identity() : f);
  }

  static void evaluate(const TetStrain& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian) {
    const auto [inverse, f, t] = deformation(effect, i, x);
    value = strain(effect, {inverse, f, t});
    const Eigen::Matrix<double, 4, 3> y = gradients(inverse);
    for (int node_index = 0; node_index < 4; ++node_index)
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        jacobian.block<1, 3>(a, 3 * node_index) = y(node_index, a) * t.col(a).transpose();
        jacobian.block<1, 3>(3 + a, 3 * node_index) =
            y(node_index, b) * t.col(a).transpose() + y(node_index, a) * t.col(b).transpose();
      }
  }

  /// green: Y (-P) Y^T with P the impulses as a symmetric matrix. corotational, where -P has eigenvalues t
  /// along the axes of the stretches s: the entries (a, b), (b, a) of R^T dF meet [t_b, -(t_a + t_b)/2; ..,
  /// t_a]/(s_a + s_b), of norm (t_a + t_b + sqrt(2 (t_a^2 + t_b^2)))/(2 (s_a + s_b)). The smallest s_a + s_b,
  /// at least 0.1, serves for all pairs.
  static NodeBounds geometric_bound(const TetStrain& effect, std::size_t i, const Positions& x,
                                    const Value& impulse);

 private:
  /// Y C^-1 at Poisson's ratio nu
  static Square inverse_elasticity(double nu) {
    Square inverse = Square::Zero();
    inverse.topLeftCorner<3, 3>().setConstant(-nu);
    inverse.diagonal() << 1, 1, 1, 2 * (1 + nu), 2 * (1 + nu), 2 * (1 + nu);
    return inverse;
  }

  static Eigen::Matrix3d symmetric(const Value& p) {
    Eigen::Matrix3d matrix;
    matrix << p[0], p[3], p[5], p[3], p[1], p[4], p[5], p[4], p[2];
    return matrix;
  }

  static Eigen::Matrix3d inverse_rest(const TetStrain& effect, std::size_t i) {
    const auto& rest = effect.rest[i];
    return Eigen::Matrix3d(rest.rightCols<3>().colwise() - rest.col(0)).inverse();
  }

  static Eigen::Matrix<double, 4, 3> gradients(const Eigen::Matrix3d& inverse) {
    Eigen::Matrix<double, 4, 3> y;
    y << -inverse.colwise().sum(), inverse;
    return y;
  }

  static Eigen::Matrix3d directions(Strain strain, const Eigen::Matrix3d& f) {
    switch (strain) {
      case Strain::green:
        return f;
      case Strain::corotational:
        return polar_rotation(f);
      case Strain::linear:
        return Eigen::Matrix3d::Identity();
    }
    return f;
  }
};

}  // namespace pbd
