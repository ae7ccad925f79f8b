#include "step/integrators.h"

namespace pbd {

StepCoefficients implicit_euler(const StepStart& start) {
  return {.d = start.h, .s = start.h, .a_v = start.h};
}

namespace {

StepCoefficients newmark(const StepStart& start) {
  if (!start.forces_known) return implicit_euler(start);
  const double h = start.h;
  if (start.method.beta) {
    const double beta = *start.method.beta, gamma = *start.method.gamma;
    return {.d = h * beta / gamma,
            .s = h * gamma,
            .x_v = h * (1 - beta / gamma),
            .x_a = h * h * (0.5 - beta / gamma),
            .v_a = h * (1 - gamma),
            .a_a = h * (1 - gamma),
            .a_v = h * gamma};
  }
  const double alpha = start.method.alpha;
  return {.d = h * alpha, .s = h * alpha, .x_v = h * (1 - alpha), .v_q = h * (1 - alpha)};
}

StepCoefficients bdf2(const StepStart& start) {
  const double ratio = start.h / start.last_h;  // 0 at a start: implicit Euler
  const double step = start.h * (1 + ratio) / (1 + 2 * ratio);
  return {.d = step, .s = step, .before = ratio * ratio / (1 + 2 * ratio)};
}

StepCoefficients midpoint(const StepStart& start) {
  return {.d = start.h / 2, .s = start.h / 2, .extension = 2};
}

StepCoefficients generalised_alpha(const StepStart& start) {
  if (!start.forces_known) return implicit_euler(start);
  const double h = start.h, rho = start.method.rho;
  const double alpha_m = (2 * rho - 1) / (rho + 1), alpha_f = rho / (rho + 1);
  const double gamma = 0.5 + alpha_f - alpha_m, beta = (gamma + 0.5) * (gamma + 0.5) / 4;
  const double weight = h * gamma / (1 - alpha_m);
  return {.d = h * beta / gamma,
          .s = weight * (1 - alpha_f),
          .x_v = h * (1 - beta / gamma),
          .x_a = h * h * (0.5 - beta / gamma),
          .v_q = weight * alpha_f,
          .v_a = h * (1 - gamma) - weight * alpha_m,
          .a_a = h * (1 - gamma),
          .a_v = h * gamma};
}

}  // namespace

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> list{
      {"implicit_euler", 1, "order 1", implicit_euler, Keeps::nothing, false, true},
      {"newmark", 1, "order 1, 2 with alpha = 0.5; alpha, or beta and gamma", newmark, Keeps::accelerations,
       false, true, true, true},
      {"generalised_alpha", 2, "order 2; rho", generalised_alpha, Keeps::accelerations, false, true, true},
      {"bdf2", 2, "order 2", bdf2, Keeps::states, false, true, true},
      {"midpoint", 2, "order 2, for compliant constraints", midpoint, Keeps::nothing, false, false, true},
      {"symplectic_euler", 1, "order 1, explicit", implicit_euler, Keeps::nothing, true, true}};
  return list;
}

}  // namespace pbd
