// Point masses on massless hard links in a plane, hung one below the other from a fixed point, in minimal
// coordinates: the links' angles q.
//
//   r_k = sum over i <= k of l_i d(q_i),   d(q) = (cos q, sin q)
//   L   = sum_k m_k |r_k'|^2/2 + F_k . r_k   with constant forces F_k, so that for every link i
//   sum_j mu_ij l_i l_j (cos(q_i - q_j) q_j'' + sin(q_i - q_j) q_j'^2) = l_i d'(q_i) . sum over k >= i of F_k
//
// with mu_ij the mass below links i and j. One link is the pendulum, two are the double pendulum.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene.h"

namespace pbd::reference {

struct PlanarChain {
  Eigen::VectorXd mass, length;  // of each bob, kg, and of the link above it, m
  Eigen::Matrix2Xd force;        // on each bob, N

  int links() const { return static_cast<int>(mass.size()); }
  Eigen::VectorXd acceleration(const Eigen::VectorXd& angle, const Eigen::VectorXd& rate) const;  // q''
  Eigen::Matrix2Xd positions(const Eigen::VectorXd& angle) const;  // of the bobs, from the fixed point
  Eigen::Matrix2Xd velocities(const Eigen::VectorXd& angle, const Eigen::VectorXd& rate) const;
};

/// A chain as part of a scene.
struct HungChain {
  PlanarChain chain;
  std::vector<int> node;              // of the scene, from the fixed one downwards: one more than bobs
  Eigen::Matrix<double, 3, 2> plane;  // orthonormal
  Eigen::VectorXd angle, rate;        // at the start

  State state(const State& initial, double time, const Eigen::VectorXd& angle,
              const Eigen::VectorXd& rate) const;
};

/// The chain a scene consists of. Throws SetupError with what stands against it unless all constraints are
/// hard distance links that form one open chain of all nodes, hung by its end from the one node of infinite
/// mass, which rests, and links, velocities and forces start in one plane and consistent with the lengths (to
/// 1e-12 of the largest).
HungChain hung_chain(const Scene& scene);

}  // namespace pbd::reference
