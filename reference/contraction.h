// Rates predicted from the dense matrices of a small scene, to be compared with measured ones.
//
// Plain fixed point: x_{k+1} solves the problem linearised at x_k with its total multipliers,
//   M (x_{k+1} - y)/h^2 = f + J_k^T gamma_{k+1},   c_k + J_k (x_{k+1} - x_k) + A gamma_{k+1} = 0
// With e = x - x*, J_k^T gamma* = J*^T gamma* + (sum_i gamma_i d2c_i) e_k and c_k + J_k (e_{k+1} - e_k) = c*
// + J* e_{k+1} up to O(e^2), so that on the null space of the hard rows
//   (M + h^2 J_c^T A^-1 J_c) e_{k+1} = h^2 G e_k,   G = sum_i gamma_i d2c_i  (gamma = -A^-1 c for compliant
//   rows)
// Corotational rows hold their rotation fixed: J is not dc/dx, and G gains J^T A^-1 (J - dc/dx).
// Under tension gamma < 0 and the eigenvalues are negative: the iteration oscillates. Pendulum: -h^2 T/(m l).
//
// Relaxation of the linearised problem, N = J W J^T + A/h^2 in blocks per constraint, N = L + D + L^T:
//   Jacobi I - omega D^-1 N,   Gauss-Seidel -(L + D)^-1 L^T
#pragma once

#include <Eigen/Core>

#include "judge.h"

namespace pbd::reference {

/// Extreme eigenvalues of the error map; the iteration contracts if radius() < 1. Of complex ones their
/// magnitude, with the sign of the real part.
struct Contraction {
  double smallest = 0, largest = 0;
  double radius() const { return std::max(-smallest, largest); }
};

/// Of the eigenvalues of an error map.
Contraction extremes(const Eigen::MatrixXd& map);

/// At a solved step's positions x (3 x N) and force multipliers gamma of the hard rows (N for lengths, as in
/// Judgement).
Contraction plain_contraction(const Scene& scene, const Points& x, const Eigen::VectorXd& gamma, double h);

/// The same of a scene with rigid bodies, at the step from `start` that a judge found. Rows are linearised by
/// J(x) (v - v_k) with the turns of bodies as they stand, of which h w is the exponential and not the sum,
/// and torques follow them:
///   M/h e' - J^T g' = (M/h - K T) e,   h J e' + A g' = (h J - J T) e
/// with K the tangent by increments (dx, d) = T dv (rigid_step.h). Throws SetupError with an implicit
/// gyroscopic torque, which is not part of the rows.
Contraction plain_contraction_of_bodies(const Scene& scene, const State& start, double h,
                                        const Judgement& solved);

struct RelaxationRates {
  double jacobi = 0;        // spectral radius of block Jacobi with the given factor
  double gauss_seidel = 0;  // of block Gauss-Seidel, blocks in the scene's order
  double condition = 0;     // largest / smallest eigenvalue of D^-1 N; infinite if N is singular
};

/// Throws SetupError for corotational tetrahedra (their rows depend on how the rotation is treated) and for a
/// scene without rows.
RelaxationRates relaxation_rates(const Scene& scene, const Points& x, double h, double omega = 1);

}  // namespace pbd::reference
