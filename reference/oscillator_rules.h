// What one step of a rule of integration makes of a damped oscillator q'' = -w^2 (q + T q'): its matrix has
// the eigenvalues r exp(+-i phi). Rules of one and two steps turn each root mu of mu^2 + w^2 T mu + w^2 = 0
// into one of their own, a function of h mu.
#pragma once

#include <string_view>
#include <vector>

#include "closed_form.h"

namespace pbd::reference {

/// A rule by the integrator's name; `alpha` is newmark's, generalised_alpha has rho = 0.8.
struct OscillatorRule {
  std::string_view integrator;
  double alpha;
  int order;
  Discrete (*step)(double h, double w, double retardation);  // s, rad/s, s; w T < 2
  int settled = 0;                                           // steps in which the rule's other roots die out
};
const std::vector<OscillatorRule>& oscillator_rules();

}  // namespace pbd::reference
