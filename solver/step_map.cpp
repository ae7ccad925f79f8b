// From the integrator's coefficients to the affine map of a step, and from the solved map to the step's end.
#include "compliant_forces.h"
#include "damping.h"
#include "step_data.h"

namespace pbd {

void StepData::make_map(const Scene& scene, const Method& method, double h, const State& state) {
  accelerations(scene, acceleration);
  if (integrator.explicit_forces) add_compliant_forces(scene, state, inverse_mass, acceleration);

  // Whoever has changed the state since the last step begins anew.
  const bool goes_on = history.h > 0 && state.x == x && state.v == v;
  if (integrator.keeps == Keeps::accelerations) {
    history.q = acceleration;
    if (goes_on) {
      history.q += (v - map.v_free) / map.s;
      if (coefficients.a_v > 0) history.a = (v - history.v - coefficients.a_a * history.a) / coefficients.a_v;
      // a_l is the acceleration at an instant apart from t_l, in proportion to the step.
      if (h != history.h) history.a = history.q + h / history.h * (history.a - history.q);
    } else {
      add_compliant_forces(scene, state, inverse_mass, history.q);
      history.a = history.q;
    }
  }
  coefficients =
      integrator.coefficients({method, h, goes_on ? history.h : infinity, goes_on || !hard_constraints});
  const StepCoefficients& c = coefficients;
  map.d = c.d;
  map.s = c.s;
  map.x0 = state.x;
  map.v_free = state.v + map.s * acceleration;
  if (c.x_v != 0) map.x0 += c.x_v * state.v;
  if (c.x_a != 0) map.x0 += c.x_a * history.a;
  if (c.v_q != 0) map.v_free += c.v_q * history.q;
  if (c.v_a != 0) map.v_free += c.v_a * history.a;
  if (c.before != 0) {
    map.x0 += c.before * (state.x - history.x);
    map.v_free += c.before * (state.v - history.v);
  }
  if (integrator.keeps != Keeps::nothing) {
    history.h = h;
    history.x = state.x;
    history.v = state.v;
  }
}

void StepData::begin_damping(const Scene& scene, const State& state) {
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    if (const Effect& effect = scene.effects[effect_of_block[b]]; damped(effect))
      pbd::begin_damping(effect, coefficients, state, history.a, rows.blocks[b]);
}

const Points* StepData::directions_for(const Points& at) {
  if (direction_blend == 1) return nullptr;
  directions_x = start_x + direction_blend * (at - start_x);
  return &directions_x;
}

void StepData::end(double h, State& state) const {
  if (coefficients.reach == 1) {
    state.x = x;
    state.v = v;
  } else {
    state.x += coefficients.reach * (x - state.x);
    state.v += coefficients.reach * (v - state.v);
  }
  state.time += h;
}

}  // namespace pbd
