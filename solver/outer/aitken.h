// aitken: as plain, but each node, and each body with its rotation, goes the share w of its change of
// velocity f = g(v) - v that its last two changes suggest (Aitken's relaxation, kuttler2008fixed), 1 at
// first:
//   v <- v + w f,   w <- -w f_l . (f - f_l)/|f - f_l|^2 in the metric M, from 1/5 to 1
// It has plain's fixed points. Plain multiplies an error by -K/M, K the stiffness that impulses give along
// turning directions: where that is below -1 plain walks in a circle, by some bodies of a pile alone, and
// shorter changes of theirs end at the solution. Where K is negative below -M shorter ones do not help.
#pragma once

#include "outer/step_system.h"

namespace pbd {

class Aitken {
 public:
  static constexpr bool solves_step = true;

  void begin(StepSystem&) { forget(); }
  void iterate(StepSystem& system, Progress& progress);
  void forget() { known_ = false; }

 private:
  void suggest_shares(const Problem& problem);

  bool known_ = false;                  // the last change, of the same rows
  Points change_, last_change_;         // m/s
  std::vector<double> share_;           // of each column, those of a body alike
  std::vector<double> along_, square_;  // J, of each node with the body that it carries
};

}  // namespace pbd
