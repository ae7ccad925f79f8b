// A merit of velocities under contacts, J: the potential (potential.h), and of each contact
//   max over p of -p u_n - 1/2 sigma p^2  +  p_n s,   0 <= p <= twice the largest impulse found (N s),
// u_n its normal row at v without impulses (m/s), sigma its compliance, p_n the normal impulse found, s mu
// times the speed at which it slides (for the box law |u_1| + |u_2|): a penalty of what is passed, and the
// dissipation of friction under the normal forces found. In the cone law friction takes part in u_n: s is
// taken from it instead. The frame in which a contact slides stays that of the linearisation, as the rows'
// own does; s on the way between two velocities is taken as linear, which it is at most. Where the contacts'
// problem in the metric is solved exactly, and no gyroscopic torque acts, its solution is downhill in the
// merit. It is no more than a guard against leaps: steps that double it lead astray, but where sheets fold,
// steps that never raise it take more iterations than there are.
#pragma once

#include <vector>

#include "rows/rows.h"

namespace pbd {

class ContactMerit {
 public:
  using Sliding = std::vector<double>;  // m/s, s of each contact

  /// A search begins at v. The rows are linearised there, the potential has this value (J), and their
  /// impulses are those found: the weights.
  void begin(const Rows& rows, const std::vector<bool>& eliminated, double potential, const Points& v);

  /// How contacts slide at v. Asked for before the rows are linearised elsewhere.
  static void find_sliding(const Rows& rows, const std::vector<bool>& eliminated, const Points& v,
                           Sliding& sliding);

  /// True if the merit at v, where the rows are linearised now, is more than twice that where the search
  /// begins, or not a number. `sliding` is that of the target, to which v lies at a share of the way.
  bool leaps(const Rows& rows, const std::vector<bool>& eliminated, double potential, const Points& v,
             const Sliding& sliding, double share) const;

 private:
  double of_contacts(const Rows& rows, const std::vector<bool>& eliminated, const Points& v,
                     const Sliding& sliding, double share) const;

  std::vector<double> normal_;  // N s, impulse of each contact
  double most_ = 0;             // N s
  Sliding sliding_;             // where the search begins
  double begins_at_ = 0;        // J, where the search begins
};

}  // namespace pbd
