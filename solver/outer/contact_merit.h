// A merit of velocities under contacts, J: the potential (potential.h), and of each contact
//   max over p of -p u_n - 1/2 sigma p^2  +  p_n s,   0 <= p <= twice the largest impulse found (N s),
// u_n its normal row at v without impulses (m/s), sigma its compliance, p_n the normal impulse found, s mu
// times the speed at which it slides: an exact penalty of what is passed, and the dissipation of friction
// under the normal forces found. In the cone law friction takes part in u_n: s is taken from it instead. The
// frame in which a contact slides stays that of the linearisation, as the rows' own does; s on the way
// between two velocities is taken as linear, which it is at most. The solution of the contacts' problem in
// the metric is downhill in it, of frictional contacts, too. It is no more than a guard against leaps: where
// sheets fold, steps that never raise it take more iterations than the budget has (measured on stiff sheets
// that slide over a border, and on one that falls on its edge), while those that double it lead astray.
#pragma once

#include <vector>

#include "rows/rows.h"

namespace pbd {

class ContactMerit {
 public:
  using Sliding = std::vector<double>;  // m/s, mu times the speed of each contact

  /// A way begins at v, where the contacts are linearised and the potential has this value (J). The weights
  /// are their impulses.
  void begin(const Rows& rows, const std::vector<bool>& eliminated, double potential, const Points& v);

  /// How contacts slide at v by the linearisation where the way begins.
  static void find_sliding(const Rows& rows, const std::vector<bool>& eliminated, const Points& v,
                           Sliding& sliding);

  /// True if it is more than twice as large at v, where the contacts are linearised, as where the way begins.
  /// v is a share of the way to where they slide so.
  bool leaps(const Rows& rows, const std::vector<bool>& eliminated, double potential, const Points& v,
             const Sliding& sliding, double share) const;

 private:
  double of_contacts(const Rows& rows, const std::vector<bool>& eliminated, const Points& v,
                     const Sliding& sliding, double share) const;

  std::vector<double> normal_;  // N s, impulse of each contact
  double most_ = 0;             // N s
  Sliding sliding_;             // where the way begins
  double begins_at_ = 0;        // J, where the way begins
};

}  // namespace pbd
