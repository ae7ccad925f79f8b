// Laws of dry friction as projections of a contact's impulse p = (p_n, p_t1, p_t2), N s, with the coefficient
// mu. A step of Jacobi's kind goes from p by `step` = -W r, r the residual (m/s) of the contact's three rows
// and W one common inverse mass; the law says where it ends. Where it ends at p, the law holds:
//
//   cone     |p_t| <= mu p_n, and r in the dual cone, r_n >= mu |r_t|, at right angles to p: convex; sliding
//            it hovers at r_n = mu |r_t| (anitescu2006optimization, tasora2011matrix)
//   coulomb  the same of r + mu |r_t| e_n: r_n = 0 where p_n > 0 (desaxce1998bipotential);
//            rows with mu > 1 use disc in its place (`projected_law`)
//   disc     p_n >= 0, |p_t| <= mu p_n with the bound taken as it is: Coulomb's law again
//   box      each |p_tj| <= mu p_n: stronger across the axes by sqrt(2)
//
// Of a constraint of rows the same is asked for by its block and number: other rows than a contact's are free
// or have bounds.
#pragma once

#include <algorithm>
#include <cmath>

#include "rows/rows.h"

namespace pbd {

/// sqrt(a^2 + b^2) by itself: std::hypot takes several times as long to avoid overflow, where residuals,
/// which are sums of squares, have long been infinite.
inline double length_of(double a, double b) {
  return std::sqrt(a * a + b * b);
}

/// The point of {|p_t| <= mu p_n} nearest to p.
inline Eigen::Vector3d project_to_cone(double mu, const Eigen::Vector3d& p) {
  const double tangential = length_of(p[1], p[2]);
  if (p[0] < 0 && mu * tangential <= -p[0])
    return Eigen::Vector3d::Zero();  // first: mu = 0 holds nothing back
  if (tangential <= mu * p[0]) return p;
  const double normal = (mu * tangential + p[0]) / (1 + mu * mu);
  const double share = mu * normal / tangential;
  return {normal, share * p[1], share * p[2]};
}

/// Where the law ends a step from p.
inline Eigen::Vector3d project(Friction law, double mu, const Eigen::Vector3d& p,
                               const Eigen::Vector3d& step) {
  const Eigen::Vector3d to = p + step;
  switch (law) {
    case Friction::cone:
      return project_to_cone(mu, to);
    case Friction::coulomb:
      return project_to_cone(mu, {to[0] - mu * length_of(step[1], step[2]), to[1], to[2]});
    case Friction::disc: {
      const double normal = std::max(0.0, to[0]), tangential = length_of(to[1], to[2]);
      const double share = tangential > mu * normal ? mu * normal / tangential : 1.0;
      return {normal, share * to[1], share * to[2]};
    }
    case Friction::box:
      break;
  }
  const double normal = std::max(0.0, to[0]), bound = mu * normal;
  return {normal, std::clamp(to[1], -bound, bound), std::clamp(to[2], -bound, bound)};
}

/// Derivatives of `project` by p and by `step`; where it has a kink, an element of Clarke's.
struct ProjectionDerivative {
  Eigen::Matrix3d by_p, by_step;
};
ProjectionDerivative project_derivative(Friction law, double mu, const Eigen::Vector3d& p,
                                        const Eigen::Vector3d& step);

/// The impulse of one contact alone: N p + q obeys the law, N (1/kg, 3 x 3) its Delassus matrix and q (m/s)
/// what its rows are without it. Separation and sticking by their formulas, sliding by a root of one unknown
/// (coulomb, disc), or, for other laws and singular N, by projections from `start`, at most thirty of them.
Eigen::Vector3d solve_contact(Friction law, double mu, const Eigen::Matrix3d& n, const Eigen::Vector3d& q,
                              const Eigen::Vector3d& start);

/// The law of contact i, as it is projected: where mu > 1 Coulomb's with the bound taken as it is, since De
/// Saxce's projection moves by 1/mu of a speed at which a contact closes.
template <class Block>
Friction projected_law(const Block& block, std::size_t i) {
  return block.frictional() && block.law == Friction::coulomb && block.friction[i] > 1 ? Friction::disc
                                                                                       : block.law;
}

/// True if constraint i is a limit whose bias, c/d at rest, lies on its open side.
template <class Block>
bool opens(const Block& block, std::size_t i) {
  if (!block.bounded()) return false;
  const double bias = block.bias[i][0];
  if constexpr (Block::rows == 3) return bias > 0;
  return (bias > 0 && block.bounds[i].lower == 0) || (bias < 0 && block.bounds[i].upper == 0);
}

/// The part of a change of constraint i's impulse from p that its bounds and this law of friction allow. What
/// is lost beside p in their sum is no less asked for: limits that exclude each other raise p without end.
template <class Block>
typename Block::Value allowed(const Block& block, Friction law, std::size_t i, const typename Block::Value& p,
                              const typename Block::Value& change) {
  if (!block.bounded() || block.bounds[i].freedom == Freedom::free) return change;
  if (block.bounds[i].freedom == Freedom::held) return -p;
  const bool lost = p + change == p;
  if constexpr (Block::rows == 1) {
    const auto& [lower, upper, freedom] = block.bounds[i];
    const double to = lost ? std::clamp(change[0], lower - p[0], upper - p[0])
                           : std::clamp(p[0] + change[0], lower, upper) - p[0];
    return typename Block::Value(to);
  }
  if constexpr (Block::rows == 3) {
    constexpr double inside = 1 - 1e-8;  // of the cone: beside it all digits of the friction count
    if (lost && length_of(p[1], p[2]) < inside * block.friction[i] * p[0]) return change;
    return project(law, block.friction[i], p, change) - p;
  }
  return change;
}

/// The same by the law of contact i.
template <class Block>
typename Block::Value allowed(const Block& block, std::size_t i, const typename Block::Value& p,
                              const typename Block::Value& change) {
  return allowed(block, projected_law(block, i), i, p, change);
}

/// Derivatives of p + allowed(block, law, i, p, change).
template <class Block>
struct AllowedDerivative {
  typename Block::Square by_p, by_change;
};
template <class Block>
AllowedDerivative<Block> allowed_derivative(const Block& block, Friction law, std::size_t i,
                                            const typename Block::Value& p,
                                            const typename Block::Value& change) {
  using Square = typename Block::Square;
  AllowedDerivative<Block> held{Square::Zero(), Square::Zero()}, free{Square::Identity(), Square::Identity()};
  if (!block.bounded() || block.bounds[i].freedom == Freedom::free) return free;
  if (block.bounds[i].freedom == Freedom::held) return held;
  if constexpr (Block::rows == 1) {
    const double to = p[0] + change[0];
    return to < block.bounds[i].lower || to > block.bounds[i].upper ? held : free;
  }
  if constexpr (Block::rows == 3) {
    const auto [by_p, by_change] = project_derivative(law, block.friction[i], p, change);
    return {by_p, by_change};
  }
  return free;
}

/// The impulse p of constraint i, cut to what its bounds and its normal part allow.
template <class Block>
typename Block::Value cut(const Block& block, std::size_t i, const typename Block::Value& p) {
  if constexpr (Block::rows == 3)
    if (block.frictional() && block.bounds[i].freedom == Freedom::lawful)
      return project(block.law == Friction::box ? block.law : Friction::disc, block.friction[i], p,
                     Block::Value::Zero());
  return p + allowed(block, i, p, Block::Value::Zero());
}

/// True if that cut takes nothing of p.
template <class Block>
bool keeps(const Block& block, std::size_t i, const typename Block::Value& p) {
  return cut(block, i, p) == p;
}

/// The impulse of contact i alone that its law asks for where its row misses r.
template <class Block>
typename Block::Value solved_impulse(const Block& block, std::size_t i, const typename Block::Value& r) {
  static_assert(Block::rows == 3);
  if (block.bounds[i].freedom == Freedom::free) return block.impulse[i] - block.delassus[i].inverse() * r;
  if (block.bounds[i].freedom == Freedom::held) return Block::Value::Zero();
  return solve_contact(projected_law(block, i), block.friction[i], block.delassus[i],
                       r - block.delassus[i] * block.impulse[i], block.impulse[i]);
}

/// Squared residual of constraint i (J) whose row misses r, and whose impulse N_ii^-1 and the law let change
/// by `change`: r^T N_ii^-1 r, or what is left of it by the law.
template <class Block>
double squared_residual(const Block& block, std::size_t i, const typename Block::Value& r,
                        const typename Block::Value& change) {
  if (!block.bounded()) return -r.dot(change);
  const double inverse = block.inverse_diagonal[i](0, 0);
  return inverse == 0 ? 0.0 : change.squaredNorm() / inverse;
}

/// The same with the change that a step of block Jacobi makes of it.
template <class Block>
double squared_residual(const Block& block, std::size_t i, const typename Block::Value& r) {
  return squared_residual(block, i, r, allowed(block, i, block.impulse[i], -block.by_inverse_diagonal(i, r)));
}

}  // namespace pbd
