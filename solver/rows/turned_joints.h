// Turns that a joint's value does not tell (step/turns.h), of effects that state `turned_out`, the |c| at
// which what they hold is 60 degrees off, or a `period`.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "rows/effect_constraint.h"
#include "rows/turned_way.h"

namespace pbd {

/// The values c of an effect at a share of the way.
template <class E>
std::vector<typename Constraint<E>::Value> values_on(const Scene& scene, const E& effect, TurnedWay& way,
                                                     double share) {
  using C = Constraint<E>;
  const Configuration at = way.at(share);
  std::vector<typename C::Value> values(constraint_count(effect));
  typename C::Jacobian unused;
  for (std::size_t i = 0; i < values.size(); ++i)
    C::evaluate(effect, i, local_at(effect, i, columns_of(scene, effect, i), at), values[i], unused);
  return values;
}

/// True if what holds directions opens on the way by more than 60 degrees, and by more than it began. Two
/// bodies that turn steadily half a turn over each other open what they hold by more than 60 degrees for a
/// third of that, in which they turn against each other by 60: more than both do from place to place.
template <class E>
bool opens_over(const Scene& scene, const E& effect, TurnedWay& way) {
  std::vector<double> most;
  for (const auto& value : values_on(scene, effect, way, 0))
    most.push_back(std::max(value.norm(), Constraint<E>::turned_out));
  for (int k = 1; k < way.places(); ++k) {
    const auto values = values_on(scene, effect, way, way.share(k));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i].norm() > most[i] && !gives_way(effect, i)) return true;
  }
  return false;
}

/// Adds to `twist` by how much each value goes on between two shares of the way, rad. Where one goes farther
/// than both bodies turn from place to place, as where a reference passes near the axis, it is looked at
/// between them.
template <class E>
void add_twists(const Scene& scene, const E& effect, TurnedWay& way, double from, double to, int halvings,
                std::vector<double>& twist) {
  using C = Constraint<E>;
  const auto before = values_on(scene, effect, way, from), after = values_on(scene, effect, way, to);
  std::vector<double> step(twist.size());
  for (std::size_t i = 0; i < step.size(); ++i)
    step[i] = std::remainder(after[i][0] - before[i][0], C::period);
  const bool jumps = std::any_of(step.begin(), step.end(),
                                 [](double angle) { return std::abs(angle) > 2 * TurnedWay::most_apart; });
  if (jumps && halvings > 0) {
    const double middle = (from + to) / 2;
    add_twists(scene, effect, way, from, middle, halvings - 1, twist);
    add_twists(scene, effect, way, middle, to, halvings - 1, twist);
    return;
  }
  for (std::size_t i = 0; i < step.size(); ++i) twist[i] += step[i];
}

/// True if a constraint's angle turns by more than half a turn otherwise than it is driven, or a limit's goes
/// past the back of it: where it jumps by 2 pi and has the limit on its other side.
template <class E>
bool twists_over(const Scene& scene, const E& effect, double h, TurnedWay& way) {
  constexpr int halvings = 16;  // what passes an axis by less than 1e-5 rad turns about it either way
  constexpr double half = Constraint<E>::period / 2, rounded = 64 * std::numeric_limits<double>::epsilon();
  const auto begin = values_on(scene, effect, way, 0);
  std::vector<double> twist(begin.size(), 0.0);
  for (int k = 0; k < way.places(); ++k)
    add_twists(scene, effect, way, way.share(k), way.share(k + 1), halvings, twist);
  for (std::size_t i = 0; i < twist.size(); ++i) {
    const double turned = twist[i] - effect.rate[i] * h;
    const auto [lower, upper] = force_bounds(effect, i);
    const bool stops = (lower == 0) != (upper == 0);
    if (std::abs(turned) > half || (stops && std::abs(begin[i][0] + turned) > half * (1 + rounded)))
      return true;
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
