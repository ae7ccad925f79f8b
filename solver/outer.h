// An outer iteration turns the linearisation at one iterate into the next iterate. All end where they stop
// moving; only some of them end at the solution of the step.
//   plain        v <- v_free + W J_k^T p, then relax: the whole multiplier acts along the current directions
//   (the
//                fixed point of Francu & Moldoveanu 2017); its fixed points are the solutions of the step
//   incremental  relax from v as it is: earlier impulses keep the directions they were found with (position
//   based
//                dynamics, XPBD; Jacobians refreshed once an outer iteration). Meets the constraints, not the
//                equations of motion
//   frozen       as plain, but always linearised at the step's start x0: velocity time stepping
#pragma once

#include <string_view>
#include <vector>

#include "scene.h"

namespace pbd {

/// The step under way, as an outer iteration sees it.
class OuterIteration {
 public:
  virtual Points& v() = 0;                // current iterate; becomes the next one
  virtual const Points& rebuilt() = 0;    // v_free + W J_k^T p at the current linearisation
  virtual bool first() = 0;               // of the step
  virtual void linearise_at_start() = 0;  // refreshes rows and `rebuilt` at x0
  virtual void relax() = 0;               // improves impulses and v by the linear rows

 protected:
  ~OuterIteration() = default;
};

struct Outer {
  std::string_view name;
  bool solves_step;  // its fixed points are the solutions of the step
  void (*iterate)(OuterIteration& iteration);
};

/// All outer iterations.
const std::vector<Outer>& outers();

}  // namespace pbd
