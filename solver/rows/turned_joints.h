// Turns that a joint's value does not tell (step/turns.h), of effects that state `turned_out`, the |c| at
// which what they hold is 60 degrees off, or a `period`.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "rows/effect_constraint.h"
#include "rows/turned_way.h"

namespace pbd {

/// The value c of constraint i.
template <class E>
typename Constraint<E>::Value value_at(const Scene& scene, const E& effect, std::size_t i,
                                       const Configuration& at) {
  typename Constraint<E>::Value value;
  typename Constraint<E>::Jacobian unused;
  Constraint<E>::evaluate(effect, i, local_at(effect, i, columns_of(scene, effect, i), at), value, unused);
  return value;
}

/// The values c of an effect at a share of the way.
template <class E>
std::vector<typename Constraint<E>::Value> values_on(const Scene& scene, const E& effect, TurnedWay& way,
                                                     double share) {
  const Configuration at = way.at(share);
  std::vector<typename Constraint<E>::Value> values(constraint_count(effect));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_at(scene, effect, i, at);
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

/// By how much the values of an effect's angles go on along a way, rad.
template <class E>
class Twists {
  using Values = std::vector<typename Constraint<E>::Value>;

 public:
  Twists(const Scene& scene, const E& effect, TurnedWay& way)
      : scene_(scene),
        effect_(effect),
        way_(way),
        begin_(values_on(scene, effect, way, 0)),
        sum_(begin_.size()) {
    Values last = begin_;
    for (int k = 1; k <= way.places(); ++k) {
      Values next = values_on(scene, effect, way, way.share(k));
      add(way.share(k - 1), last, way.share(k), next);
      last = std::move(next);
    }
  }

  std::size_t size() const { return sum_.size(); }
  double begin(std::size_t i) const { return begin_[i][0]; }
  double operator[](std::size_t i) const { return sum_[i]; }

 private:
  static double between(const Values& before, const Values& after, std::size_t i) {
    return std::remainder(after[i][0] - before[i][0], Constraint<E>::period);
  }

  /// Where one goes farther than both bodies turn from place to place, as where a reference passes near the
  /// axis, the way is halved there.
  void add(double from, const Values& before, double to, const Values& after) {
    bool jumps = false;
    for (std::size_t i = 0; i < size(); ++i)
      jumps |= std::abs(between(before, after, i)) > 2 * TurnedWay::most_apart;
    const double middle = (from + to) / 2;
    if (jumps && from < middle && middle < to && halvings_ < most_halvings) {
      ++halvings_;
      const Values halfway = values_on(scene_, effect_, way_, middle);
      add(from, before, middle, halfway);
      add(middle, halfway, to, after);
      return;
    }
    for (std::size_t i = 0; i < size(); ++i) sum_[i] += between(before, after, i);
  }

  /// Of a way: twenty take a reference that passes the axis by 1e-6 rad. Of one that stays on it no number
  /// would tell anything.
  static constexpr int most_halvings = 1000;

  const Scene& scene_;
  const E& effect_;
  TurnedWay& way_;
  Values begin_;
  std::vector<double> sum_;
  int halvings_ = 0;
};

/// True if constraint i's angle, `begin` where a step of h seconds begins, goes on by `twist` (rad), which is
/// more than half a turn otherwise than it is driven, or takes it past the back of a limit: there it jumps by
/// 2 pi, and has the limit on its other side. One that begins there may be on either.
template <class E>
bool is_over(const E& effect, std::size_t i, double begin, double twist, double h) {
  constexpr double half = Constraint<E>::period / 2, rounded = 64 * std::numeric_limits<double>::epsilon();
  constexpr double more = half * (1 + rounded), less = half * (1 - rounded);
  const double turned = twist - effect.rate[i] * h;
  const auto [lower, upper] = force_bounds(effect, i);
  const bool stops = (lower == 0) != (upper == 0) && std::abs(begin) < less;
  return std::abs(turned) > more || (stops && std::abs(begin + turned) > more);
}

/// As Source::twists_far.
template <class E>
bool twists_far(const Scene& scene, const E& effect, double h, const Configuration& start,
                const Configuration& reached, double extension) {
  for (std::size_t i = 0; i < constraint_count(effect); ++i) {
    const double begin = value_at(scene, effect, i, start)[0], end = value_at(scene, effect, i, reached)[0];
    const double twist = extension * std::remainder(end - begin, Constraint<E>::period);
    if (std::abs(twist) > 2 * TurnedWay::most_apart || is_over(effect, i, begin, twist, h)) return true;
  }
  return false;
}

/// As Source::turns_over, of angles.
template <class E>
bool twists_over(const Scene& scene, const E& effect, double h, TurnedWay& way) {
  const Twists twists(scene, effect, way);
  for (std::size_t i = 0; i < twists.size(); ++i)
    if (is_over(effect, i, twists.begin(i), twists[i], h)) return true;
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
