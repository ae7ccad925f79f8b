// c = strain (xx, yy, zz, 2 xy, 2 yz, 2 zx) of a linear tetrahedron. F = Ds Dm^-1, Ds = [x1-x0, x2-x0,
// x3-x0], Dm its rest; y_1..y_3 the rows of Dm^-1, y_0 = -(y_1 + y_2 + y_3). With T the matrix whose columns
// enter the gradient,
//   linear        e = (F + F^T)/2 - I          T = I
//   corotational  e = (R^T F + F^T R)/2 - I    T = R, the polar rotation of F
//   green         e = (F^T F - I)/2            T = F
//   de_aa/dx_i = y_i[a] T_a^T,  d(2 e_ab)/dx_i = y_i[b] T_a^T + y_i[a] T_b^T.
// For `corotational` this holds R fixed: single rows are not dc/dx, but J^T p is the exact energy gradient
// wherever p is an isotropic stress of e, since that commutes with the stretch U. That of a damper does not.
// Of damped effects the rows are dc/dx: U changes by R^T dF - [w]x U made symmetric, where R turns by
//   w = (tr U - U)^-1 ax(R^T dF),   ax(M) = (M_zy - M_yz, M_xz - M_zx, M_yx - M_xy)
// and J^T p is T (S - [(tr U - U)^-1 ax(S U)]x) Y^T, which turns nothing. Where two stretches sum to less
// than 0.1 R is held fixed. A = C^-1/volume (servin2006interactive).
#pragma once

#include "rows/constraint.h"
#include "rows/kept_jacobians.h"
#include "rows/source.h"

namespace pbd {

template <>
struct Constraint<TetStrain> : ConstraintShape<6, 4> {
  static constexpr bool fills_space = true;
  static constexpr bool one_material = true;

  static Nodes node(const TetStrain& effect, std::size_t i);
  static const Positions& rest(const TetStrain& effect, std::size_t i);
  static double compliance_scale(const TetStrain& effect, std::size_t i);
  static Square unit_compliance(const TetStrain& effect);  // C^-1, 1/Pa

  /// C^-1 C_d
  static Square retardation(const TetStrain& effect, std::size_t i);

  /// Dm^-1, F and T at positions x, and from them c and J^T p without J.
  struct Deformation {
    Eigen::Matrix3d inverse, f, t;
  };
  static Deformation deformation(const TetStrain& effect, std::size_t i, const Positions& x);
  static Value strain(const TetStrain& effect, const Deformation& at);

  /// c, and J as rows keep it.
  static void linearise(const TetStrain& effect, std::size_t i, const Positions& x, Value& value,
                        StrainJacobians& jacobians, std::size_t row);
  /// True if R follows F: J has a part by which it turns.
  static bool turns(const TetStrain& effect);

  /// J^T p: T S Y^T, S the impulses as a symmetric matrix; of damped ones with what turns R.
  static Positions push(const TetStrain& effect, const Deformation& at, const Value& impulse);

  /// Volume times what its material's rotation is the polar part of, m^3.
  static Eigen::Matrix3d weighted_deformation(const TetStrain& effect, std::size_t i, const Positions& x);

  static void evaluate(const TetStrain& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian);

  /// green: Y (-P) Y^T with P the impulses as a symmetric matrix. corotational, where -P has eigenvalues t
  /// along the axes of the stretches s: the entries (a, b), (b, a) of R^T dF meet [t_b, -(t_a + t_b)/2; ..,
  /// t_a]/(s_a + s_b), of norm (t_a + t_b + sqrt(2 (t_a^2 + t_b^2)))/(2 (s_a + s_b)). The smallest s_a + s_b,
  /// at least 0.1, serves for all pairs.
  static NodeBounds geometric_bound(const TetStrain& effect, std::size_t i, const Positions& x,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const TetStrain& effect);

}  // namespace pbd
