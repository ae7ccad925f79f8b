// What a block of rows knows of where a step begins: its values, and what damping makes of them. Damping is a
// change of value and compliance. A constraint's value follows the
// integrator's rule for positions (integrators.h), so that its rate belongs to the velocity v:
//   dc/dt = (c - c0)/d,   c0 = c_l + J_l (x_v v_l + x_a a_l) + before (c_l - c_l-1) + k v_l^T c'' v_l
// with k = x_a, and less d^2/2 where x is no position of the motion but the middle of a chord (midpoint).
// Implicit Euler has c0 = c_l. Then c + T dc/dt + A gamma = 0 is
//   c - offset + (1 + T/d)^-1 A gamma = 0,   offset = (1 - (1 + T/d)^-1) c0.
// For solids (1 + T/d)^-1 A is the inverse of V (C + C_d/d). It is the gradient of a potential: elastic
// energy and d/2 (dc/dt)^T A^-1 T (dc/dt) (servin2006interactive).
#pragma once

#include <cmath>

#include "rows/effect_constraint.h"
#include "rows/row_operations.h"

namespace pbd {

template <class E>
using BlockOf = RowBlock<Constraint<E>::rows, Constraint<E>::nodes>;

/// True of effects whose values jump by a period.
template <class E>
inline constexpr bool is_angle = requires {
  Constraint<E>::period;
};

/// k of c0.
inline double bend_of_rate(const StepCoefficients& c) {
  return c.x_a - (c.extension == 1 ? 0.0 : c.d * c.d / 2);
}

/// Of the values that a periodic constraint has, the one nearest to `to`: within a step it does not jump.
template <class E>
void unwrap(const typename Constraint<E>::Value& to, typename Constraint<E>::Value& value) {
  if constexpr (is_angle<E>)
    value[0] += Constraint<E>::period * std::round((to[0] - value[0]) / Constraint<E>::period);
}

/// c and J of constraint i of a block, wherever the step began.
template <class E>
void evaluate_anew(const E& effect, const BlockOf<E>& block, std::size_t i, const Configuration& at,
                   typename Constraint<E>::Value& value, typename Constraint<E>::Jacobian& jacobian) {
  const std::size_t entry = block.entry(i);
  Constraint<E>::evaluate(effect, entry, local_at(effect, entry, block.node[i], at), value, jacobian);
}

/// c, on from where the step began, and J.
template <class E>
void evaluate_on(const E& effect, const BlockOf<E>& block, std::size_t i, const Configuration& at,
                 typename Constraint<E>::Value& value, typename Constraint<E>::Jacobian& jacobian) {
  evaluate_anew(effect, block, i, at, value, jacobian);
  if (!block.begin_value.empty()) unwrap<E>(block.begin_value[i], value);
}

template <class E>
void keep_values(const E& effect, const StepBegin& begin, BlockOf<E>& block) {
  block.begin_value.resize(block.size());
  typename Constraint<E>::Jacobian unused;
  for (std::size_t i = 0; i < block.size(); ++i)
    evaluate_anew(effect, block, i, begin.at, block.begin_value[i], unused);
}

/// Sets offset, compliance and the values at the start of constraints that are damped.
template <class E>
void begin_damping(const E& effect, const StepBegin& begin, BlockOf<E>& block) {
  using C = Constraint<E>;
  using Value = typename C::Value;
  using Jacobian = typename C::Jacobian;
  using Square = typename C::Square;
  const StepCoefficients& c = begin.coefficients;
  const auto share_of = [&](std::size_t entry) {  // (1 + T/d)^-1
    return inverse_of(Square(Square::Identity() + C::retardation(effect, entry) / c.d));
  };
  const Square common = C::one_material && block.size() > 0 ? share_of(block.entry(0)) : Square::Identity();
  block.compliance.set_unit(common * C::unit_compliance(effect));
  block.offset.resize(block.size());
  block.begin_value.resize(block.size());
  each_own(block, [&](std::size_t i) {
    const std::size_t entry = block.entry(i);
    Value value, ahead, behind;
    Jacobian jacobian, unused;
    evaluate_anew(effect, block, i, begin.at, value, jacobian);
    Value from = value;  // c0
    if (c.x_v != 0) from += jacobian * (c.x_v * block.gather(begin.v, i));
    if (c.x_a != 0) from += jacobian * (c.x_a * block.gather(begin.a, i));
    if (c.before != 0) {
      unwrap<E>(value, block.begin_value[i]);
      from += c.before * (value - block.begin_value[i]);
    }
    block.begin_value[i] = value;
    if (bend_of_rate(c) != 0) {
      evaluate_on(effect, block, i, begin.ahead, ahead, unused);
      evaluate_on(effect, block, i, begin.behind, behind, unused);
      from += bend_of_rate(c) * ((ahead - 2 * value + behind) / (c.d * c.d));
    }
    const Square share = C::one_material ? common : share_of(entry);
    block.offset[i] = from - share * from;
    const double own_share = C::one_material ? 1 : share(0, 0);  // T is one number then
    block.compliance.set(i, own_share * C::compliance_scale(effect, entry) / (c.s * c.d));
  });
}

}  // namespace pbd
