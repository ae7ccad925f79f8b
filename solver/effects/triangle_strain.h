// c = (e_uu, e_vv, 2 e_uv), the Green strain of a flat triangle. With the rest edges in their plane, Dm =
// [X1-X0, X2-X0] (2 x 2, u along X1-X0), F = [x1-x0, x2-x0] Dm^-1 (3 x 2) and y_1, y_2 the rows of Dm^-1, y_0
// = -(y_1 + y_2):
//   e_uu = (F_u.F_u - 1)/2, 2 e_uv = F_u.F_v;  de_uu/dx_i = y_i[u] F_u^T,  d(2 e_uv)/dx_i = y_i[v] F_u^T +
//   y_i[u] F_v^T.
// A = C^-1 / area, C^-1 = 1/(thickness Y) [1 -nu 0; -nu 1 0; 0 0 2(1+nu)] (plane stress).
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "effects/constraint.h"
#include "mesh.h"

namespace pbd {

template <>
struct Constraint<TriangleStrain> : ConstraintShape<3, 3> {
  static constexpr bool one_material = true;

  static Nodes node(const TriangleStrain& effect, std::size_t i) { return effect.node[i]; }
  static const Positions& rest(const TriangleStrain& effect, std::size_t i) { return effect.rest[i]; }

  static Square compliance(const TriangleStrain& effect, std::size_t i) {
    return inverse_elasticity(effect.material.poisson) /
           (effect.thickness * effect.material.young * triangle_area(effect.rest[i]));
  }

  /// C^-1 C_d
  static Square retardation(const TriangleStrain& effect, std::size_t);

  static void evaluate(const TriangleStrain& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian) {
    const Eigen::Matrix2d inverse = rest_edges(effect.rest[i]).inverse();
    const Eigen::Matrix<double, 3, 2> f = (x.rightCols<2>().colwise() - x.col(0)) * inverse;
    value << (f.col(0).squaredNorm() - 1) / 2, (f.col(1).squaredNorm() - 1) / 2, f.col(0).dot(f.col(1));

    const Eigen::Matrix<double, 3, 2> y = gradients(inverse);
    for (int a = 0; a < 3; ++a)
      jacobian.middleCols<3>(3 * a) << y(a, 0) * f.col(0).transpose(), y(a, 1) * f.col(1).transpose(),
          y(a, 1) * f.col(0).transpose() + y(a, 0) * f.col(1).transpose();
  }

  static NodeBounds geometric_bound(const TriangleStrain& effect, std::size_t i, const Positions&,
                                    const Value& impulse) {
    Eigen::Matrix2d stress;
    stress << impulse[0], impulse[2], impulse[2], impulse[1];
    return stress_bound(gradients(rest_edges(effect.rest[i]).inverse()), Eigen::Matrix2d(-stress));
  }

 private:
  /// Y C^-1 at Poisson's ratio nu
  static Square inverse_elasticity(double nu) {
    Square inverse;
    inverse << 1, -nu, 0, -nu, 1, 0, 0, 0, 2 * (1 + nu);
    return inverse;
  }

  static Eigen::Matrix<double, 3, 2> gradients(const Eigen::Matrix2d& inverse) {
    Eigen::Matrix<double, 3, 2> y;
    y << -inverse.colwise().sum(), inverse;
    return y;
  }

  static Eigen::Matrix2d rest_edges(const Eigen::Matrix3d& rest) {
    const Vec3 first = rest.col(1) - rest.col(0);
    const Vec3 second = rest.col(2) - rest.col(0);
    const double length = first.norm();
    Eigen::Matrix2d edges;
    edges << length, first.dot(second) / length, 0, first.cross(second).norm() / length;
    return edges;
  }
};

}  // namespace pbd
