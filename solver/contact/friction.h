// Laws of dry friction as projections of a contact's impulse p = (p_n, p_t1, p_t2), N s, with the coefficient
// mu. A step of Jacobi's kind goes from p by `step` = -W r, r the residual (m/s) of the contact's three rows
// and W one common inverse mass; the law says where it ends. Where it ends at p, the law holds:
//
//   cone     |p_t| <= mu p_n, and r in the dual cone, r_n >= mu |r_t|, at right angles to p: convex; sliding
//            it hovers at r_n = mu |r_t| (Anitescu 2006; Tasora, Anitescu 2011)
//   coulomb  the same of r + mu |r_t| e_n: r_n = 0 where p_n > 0 (De Saxce, Feng 1998);
//            rows with mu > 1 use disc in its place (rows.h)
//   disc     p_n >= 0, |p_t| <= mu p_n with the bound taken as it is: Coulomb's law again
//   box      each |p_tj| <= mu p_n: stronger across the axes by sqrt(2)
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace pbd {

enum class Friction { coulomb, cone, box, disc };
inline constexpr std::array<std::string_view, 4> friction_names{"coulomb", "cone", "box", "disc"};

/// The law of that name; throws SetupError listing the allowed ones.
Friction friction_by_name(std::string_view name);

/// The point of {|p_t| <= mu p_n} nearest to p.
inline Eigen::Vector3d project_to_cone(double mu, const Eigen::Vector3d& p) {
  const double tangential = std::hypot(p[1], p[2]);
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
      return project_to_cone(mu, {to[0] - mu * std::hypot(step[1], step[2]), to[1], to[2]});
    case Friction::disc: {
      const double normal = std::max(0.0, to[0]), tangential = std::hypot(to[1], to[2]);
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

}  // namespace pbd
