// The laws of friction but for box (rows/laws.h; disc as coulomb), smoothed by e > 0, whose size is that of a
// residual (sqrt(J)). With x = (mu p_n, p_t) and z = (r_n/mu, r_t), of coulomb z_n + |z_t|, and one inverse
// mass, the law asks for x = Q(x - w z), Q the projection on Lorentz's cone {|x_t| <= x_n}; smoothed, Q's
// eigenvalues l = x_n -+ |x_t| become not max(l, 0) but (l + sqrt(l^2 + 4 e^2))/2, and |z_t| is sqrt(|z_t|^2
// + e^2) (chen1993noninterior; hayashi2005combined). Without friction the same of p_n and r_n alone.
#pragma once

#include "rows/rows.h"

namespace pbd {

/// What a contact misses of its law, sqrt(J), and the derivatives of that by p (N s) and r (m/s).
struct SmoothedLaw {
  Vec3 missed;
  Eigen::Matrix3d by_p, by_r;
};

/// `n` (1/kg) is the contact's Delassus matrix, of positive trace.
SmoothedLaw smoothed_law(bool coulomb, double mu, const Eigen::Matrix3d& n, double e, const Vec3& p,
                         const Vec3& r);

/// True of a contact whose law is smoothed: it may move something.
template <class Block>
bool is_smoothed(const Block& block, std::size_t i) {
  return block.frictional() && block.law != Friction::box && block.bounds[i].freedom == Freedom::lawful &&
         block.delassus[i].trace() > 0;
}

}  // namespace pbd
