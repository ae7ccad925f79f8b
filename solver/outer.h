// An outer iteration turns the linearisation at one iterate into the next iterate. All end where they stop
// moving; only some of them end at the solution of the step.
//
//   plain        v <- v_free + W J_k^T p, then relax
//   incremental  relax from v as it is; only the first iterate is v_free + W J^T p
//   frozen       as plain, but always linearised at x0
//   auto         quasi_newton for compliant solids; else plain where that contracts, else proximal
//   quasi_newton v <- v - t H grad phi(v), on the potential that remains when compliant rows are eliminated;
//                where hard rows are left, argmin of its model in the metric P under them, accelerated
//   proximal     as plain, with M + D for M and (M + D)^-1 (M v_free + D v_k) for v_free; accelerated
//
// In plain the whole multiplier acts along the current directions (francu2017position); its fixed points are
// the solutions of the step. In incremental earlier impulses keep the directions they were found with, as in
// position based dynamics and XPBD (macklin2016xpbd), with Jacobians refreshed once an outer iteration: it
// meets the constraints, not the equations of motion. frozen is velocity time stepping.
//
// Plain leaves out the geometric stiffness K = -d sum_i p_i d2c_i: its error is multiplied by -K/(M +
// material stiffness) on the motions that the hard rows allow. Proximal has the same fixed points and
// multiplies by (D - K)/(M + D + material stiffness), which is below 1 where D >= K/2 and the step's
// potential is convex. D is half the effects' own bounds of the stiffening part of K, a number a node, zero
// where no impulse pulls.
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
  virtual void add_inertia() = 0;         // the proximal term: changes W and `rebuilt` until the next iterate
  virtual void accelerate() = 0;          // by the iterates so far
  virtual bool on_potential() = 0;        // every row is compliant and its impulse eliminated
  virtual void descend() = 0;             // one step down that potential
  virtual void project() = 0;             // one step down the eliminated rows' potential, under the others
  virtual bool plain_contracts() = 0;     // as predicted, and as far as the iterates so far show

 protected:
  ~OuterIteration() = default;
};

/// Whether impulses are the compliant rows' own, p = -Sigma^-1 c/d: `where_possible` if every
/// row is compliant and stiff in every direction.
enum class OnPotential { never, where_possible, always };

struct Outer {
  std::string_view name;
  bool solves_step;  // its fixed points are the solutions of the step
  void (*iterate)(OuterIteration& iteration);
  OnPotential potential = OnPotential::never;
};

/// All outer iterations.
const std::vector<Outer>& outers();

}  // namespace pbd
