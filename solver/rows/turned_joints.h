// Turns that a joint's value does not tell (step/turns.h), of effects that state `turned_out`, the |c| at
// which what they hold is 60 degrees off, or a `period`.
#pragma once

#include <cmath>

#include "rows/effect_constraint.h"

namespace pbd {

/// As Source::turns_over.
template <class E>
bool turns_over(const Scene& scene, const E& effect, const Configuration& start,
                const Configuration& between) {
  using C = Constraint<E>;
  if constexpr (requires { C::turned_out; }) {
    const auto is_out = [&](std::size_t i, const Configuration& at) {
      typename C::Value value;
      typename C::Jacobian unused;
      C::evaluate(effect, i, local_at(effect, i, columns_of(scene, effect, i), at), value, unused);
      return value.norm() > C::turned_out;
    };
    for (std::size_t i = 0; i < constraint_count(effect); ++i)
      if (!gives_way(effect, i) && is_out(i, between) && !is_out(i, start)) return true;
  }
  return false;
}

/// As Source::drives_round.
template <class E>
bool drives_round(const E& effect, double h) {
  using C = Constraint<E>;
  if constexpr (requires { C::period; })
    for (std::size_t i = 0; i < constraint_count(effect); ++i)
      if (!gives_way(effect, i) && std::abs(effect.rate[i]) * h > C::period / 2) return true;
  return false;
}

}  // namespace pbd
