// The symmetric factor S of F = R S, R the nearest proper rotation, with first and second derivatives.
//
//   F = U diag(s) V^T,  S = V diag(s) V^T,  S S = F^T F
//
// with U, V rotations and |s3| the smallest (s3 < 0 for an inverted F). Differentiating S S = F^T F once and
// twice gives Sylvester equations, diagonal in the basis V:
//
//   (s_i + s_j) dS_ij       = (dF^T F + F^T dF)_ij
//   (s_i + s_j) d2S[a,b]_ij = (dF_a^T dF_b + dF_b^T dF_a - dS_a dS_b - dS_b dS_a)_ij
//
// S is not differentiable where s_2 + s_3 = 0; there the sums are bounded from below by `smallest_sum`. The
// Hessian of tr S has the twist modes of (smith2019analytic) as eigenvectors, which a test checks.
#pragma once

#include <Eigen/Core>
#include <array>

namespace pbd::reference {

inline constexpr double smallest_sum = 1e-9;

using Strain6 = Eigen::Matrix<double, 6, 1>;

/// U, s and V of F = U diag(s) V^T with proper rotations U, V; s descending in magnitude, s3 carries the sign
/// of det F.
struct ProperSvd {
  Eigen::Matrix3d u;
  Eigen::Vector3d s;
  Eigen::Matrix3d v;
};
ProperSvd proper_svd(const Eigen::Matrix3d& f);

/// c = S - I as (xx, yy, zz, 2 xy, 2 yz, 2 zx).
Strain6 corotational_strain(const Eigen::Matrix3d& f);

/// The same with derivatives by the entries of F in column order: jacobian 6 x 9.
struct StrainSlope {
  Strain6 value;
  Eigen::Matrix<double, 6, 9> jacobian;
};
StrainSlope corotational_slope(const Eigen::Matrix3d& f);
/// With hessian[i] = d2 c_i / dF2 (9 x 9), too.
struct StrainDerivatives : StrainSlope {
  std::array<Eigen::Matrix<double, 9, 9>, 6> hessian;
};
StrainDerivatives corotational_derivatives(const Eigen::Matrix3d& f);

/// What is left of the slope where R is held fixed, R^T dF made symmetric, and how the force R P of a stress
/// p = (P_xx, P_yy, P_zz, P_xy, P_yz, P_zx) turns with it, dR P: with U^T dR V = W,
///   (s_i + s_j) W_ij = (U^T dF V - V^T dF^T U)_ij
struct HeldRotation {
  Eigen::Matrix<double, 6, 9> jacobian;
  Eigen::Matrix<double, 9, 9> turning;
};
HeldRotation held_rotation(const Eigen::Matrix3d& f, const Strain6& stress);

}  // namespace pbd::reference
