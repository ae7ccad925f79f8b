// Turns that a joint's value does not tell (step/turns.h), of effects that state `turned_out`, the |c| at
// which what they hold is 60 degrees off, or a `period`.
#pragma once

#include <algorithm>
#include <cmath>

#include "rows/effect_constraint.h"
#include "rows/turned_way.h"

namespace pbd {

/// As Source::turns_over. Two bodies that turn steadily half a turn over each other open what they hold by
/// more than 60 degrees for a third of that, in which they turn against each other by 60: more than both do
/// from place to place.
template <class E>
bool turns_over(const Scene& scene, const E& effect, double h, TurnedWay& way) {
  using C = Constraint<E>;
  const auto value_at = [&](std::size_t i, const Configuration& at) {
    typename C::Value value;
    typename C::Jacobian unused;
    C::evaluate(effect, i, local_at(effect, i, columns_of(scene, effect, i), at), value, unused);
    return value;
  };
  std::vector<double> sum(constraint_count(effect), 0.0), last(sum);
  for (int k = 0; k <= way.places(); ++k) {
    const Configuration at = way.at(k);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const typename C::Value value = value_at(i, at);
      if constexpr (requires { C::period; }) {
        if (k > 0) sum[i] += std::remainder(value[0] - last[i], C::period);
        last[i] = value[0];
        if (k == way.places() && std::abs(sum[i] - effect.rate[i] * h) > C::period / 2) return true;
      } else {
        const double open = value.norm();
        if (k == 0) last[i] = std::max(open, C::turned_out);
        if (k < way.places() && open > last[i] && !gives_way(effect, i)) return true;
      }
    }
  }
  return false;
}

/// As Source::drives_round.
template <class E>
bool drives_round(const E& effect, double h) {
  using C = Constraint<E>;
  return std::any_of(effect.rate.begin(), effect.rate.end(),
                     [&](double rate) { return std::abs(rate) * h > C::period / 2; });
}

}  // namespace pbd
