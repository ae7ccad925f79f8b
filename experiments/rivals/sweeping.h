// Rivals that begin at y and sweep over a scene's elements or nodes.
#pragma once

#include <string>

#include "rivals/implicit_step.h"
#include "rivals/potential.h"

namespace pbd::rivals {

/// An iteration is a sweep. A step ends where sweeps change nothing, too. Engines that sweep have no test of
/// convergence: the residual is not in the seconds.
class Sweeping : public Rival {
 public:
  using Rival::step;
  Report step(State& state, const Budget& budget, const Observer& observer) override;

 protected:
  Sweeping(const std::string& name, const Scene& scene, double h);

  ImplicitStep step_;
  Potential potential_;

 private:
  virtual void begin() = 0;
  virtual void sweep(Points& x) = 0;
  /// What rounding of x makes of the residual at the last sweep, sqrt(J).
  virtual double rounding(const Points& x) const = 0;

  Point now_;
  Points before_;
};

}  // namespace pbd::rivals
