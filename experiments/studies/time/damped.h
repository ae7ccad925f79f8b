// What the parts of the experiment `damping` share.
#pragma once

#include <string>

#include "harness/experiment.h"
#include "oscillator_rules.h"
#include "step/step.h"

namespace pbdcheck {

/// By gauss_seidel.
inline pbd::Method oscillator_method(const pbd::reference::OscillatorRule& rule) {
  pbd::Method method;
  method.integrator = rule.integrator;
  method.alpha = rule.alpha;
  method.relaxation = "gauss_seidel";
  return method;
}

/// The integrator's name, newmark's with its alpha.
inline std::string label(const pbd::reference::OscillatorRule& rule) {
  const bool one_of_many = rule.integrator == "newmark";
  return std::string(rule.integrator) + (one_of_many ? " " + std::to_string(rule.alpha).substr(0, 4) : "");
}

/// Does damping take nothing of a rotation and a translation? Verdicts and the table `rotation`.
void damped_rotation(Context& context);

}  // namespace pbdcheck
