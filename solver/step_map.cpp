// From the integrator's coefficients to the affine map of a step, and from the solved map to the step's end.
#include <algorithm>

#include "compliant_forces.h"
#include "damping.h"
#include "step_data.h"

namespace pbd {

/// Whoever has changed the state since the last step begins anew.
bool StepData::goes_on(const State& state) const {
  if (!(history.h > 0)) return false;
  if (bodies.count() == 0) return state.x == x && state.v == v;
  const auto same = [](const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return a.coeffs() == b.coeffs();
  };
  return state.x == ended.x && state.v == ended.v && state.spin == ended.spin &&
         std::equal(state.orientation.begin(), state.orientation.end(), ended.orientation.begin(), same);
}

void StepData::make_map(const Scene& scene, const Method& method, double h, const State& state) {
  const bool goes_on = this->goes_on(state);
  if (goes_on && integrator.keeps == Keeps::states)  // a body's arc, from where it begins now
    history.x.rightCols(bodies.count()) = -coefficients.reach * x.rightCols(bodies.count());
  bodies.begin(state, start_x, start_v);
  const Configuration start = placed(start_x, start_poses, state.time);
  accelerations(scene, {bodies, start_poses, start_v, integrator.explicit_forces}, acceleration);
  if (integrator.explicit_forces) add_compliant_forces(scene, start, start_v, inverse_mass, acceleration);

  if (integrator.keeps == Keeps::accelerations) {
    history.q = acceleration;
    if (goes_on) {
      history.q += (v - map.v_free) / map.s;
      if (contacts.listed()) {  // they act as the step ends alone
        push.setZero();
        contacts.apply(rows, inverse_mass, push);
        history.q -= push / map.s;
      }
      if (coefficients.a_v > 0) history.a = (v - history.v - coefficients.a_a * history.a) / coefficients.a_v;
      // a_l is the acceleration at an instant apart from t_l, in proportion to the step.
      if (h != history.h) history.a = history.q + h / history.h * (history.a - history.q);
    } else {
      add_compliant_forces(scene, start, start_v, inverse_mass, history.q);
      for (int b = 0; b < bodies.count() && implicit_gyroscopic; ++b)
        history.q.col(bodies.column(b)) += bodies.gyroscopic(b, start_v.col(bodies.column(b)));
      history.a = history.q;
    }
  }
  coefficients =
      integrator.coefficients({method, h, goes_on ? history.h : infinity, goes_on || !hard_constraints});
  const StepCoefficients& c = coefficients;
  map.d = c.d;
  map.s = c.s;
  map.h = h;
  map.x0 = start_x;
  map.v_free = start_v + map.s * acceleration;
  x_time = state.time + h / c.reach;
  if (c.x_v != 0) map.x0 += c.x_v * start_v;
  if (c.x_a != 0) map.x0 += c.x_a * history.a;
  if (c.v_q != 0) map.v_free += c.v_q * history.q;
  if (c.v_a != 0) map.v_free += c.v_a * history.a;
  if (c.before != 0) {
    map.x0 += c.before * (start_x - history.x);
    map.v_free += c.before * (start_v - history.v);
  }
  if (integrator.keeps != Keeps::nothing) {
    history.h = h;
    history.x = start_x;
    history.v = start_v;
  }
}

void StepData::begin_damping(const Scene& scene, double time) {
  if (std::none_of(effect_of_block.begin(), effect_of_block.end(),
                   [&](std::size_t index) { return damped(scene.effects[index]); }))
    return;
  const double reach = bends(coefficients) ? coefficients.d : 0;
  turned_x = start_x + reach * start_v;
  push = start_x - reach * start_v;
  const Configuration start{start_x, start_poses, time}, ahead = placed(turned_x, other_poses, time),
                                                         behind = placed(push, direction_poses, time);
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    if (const Effect& effect = scene.effects[effect_of_block[b]]; damped(effect))
      pbd::begin_damping(effect, coefficients, {start, ahead, behind, start_v}, history.a, rows.blocks[b]);
}

Configuration StepData::placed(const Points& at, std::vector<Pose>& storage, double time) {
  bodies.place(at, storage);
  return {at, storage, time};
}

const Configuration* StepData::directions_for(const Points& at) {
  if (direction_blend == 1) return nullptr;
  directions_x = start_x + direction_blend * (at - start_x);
  directions.emplace(placed(directions_x, direction_poses, x_time));
  return &*directions;
}

double StepData::add_gyroscopic(Points& velocity) const {
  double missed = 0;
  if (!implicit_gyroscopic) return missed;
  for (int b = 0; b < bodies.count(); ++b) {
    const Eigen::Index column = bodies.column(b);
    const double weight = rows.inverse_mass[static_cast<std::size_t>(column)];  // of M, against M + D
    const double share = weight > 0 ? weight / inverse_mass[static_cast<std::size_t>(column)] : 0.0;
    Vec3 eta = velocity.col(column);
    const double left = bodies.add_gyroscopic(b, share * map.s, eta);
    if (weight > 0) missed += left * left / weight;
    velocity.col(column) = eta;
  }
  return missed;
}

void StepData::end(double h, State& state) {
  if (coefficients.reach == 1) {
    bodies.end(x, v, state);
  } else {
    turned_x = start_x + coefficients.reach * (x - start_x);
    push = start_v + coefficients.reach * (v - start_v);
    bodies.end(turned_x, push, state);
  }
  state.time += h;
  if (bodies.count() > 0) ended = state;
}

}  // namespace pbd
