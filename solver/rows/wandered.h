// How far bodies have gone from where they were seen, and which part of the way to a stop that can be.
#pragma once

#include <algorithm>
#include <vector>

#include "rows/bodies.h"

namespace pbd {

struct StepBegin;

/// The farthest ways of some bodies.
struct Wandered {
  double way = 0;   // m, of a centre of mass
  double turn = 0;  // norm of a rotation's change: no unit vector's end goes farther
  double time = 0;  // s
};

inline Wandered operator+(const Wandered& a, const Wandered& b) {
  return {a.way + b.way, a.turn + b.turn, a.time + b.time};
}

inline Wandered operator*(double factor, const Wandered& a) {
  return {factor * a.way, factor * a.turn, factor * a.time};
}

/// Which part of the way to a stop bodies can go at most, by a m, a unit of turn and a s.
struct Approach {
  double by_way = 0, by_turn = 0, by_time = 0;

  double part(const Wandered& gone) const {
    return by_way * gone.way + by_turn * gone.turn + by_time * gone.time;
  }

  void take_quicker(const Approach& other) {
    by_way = std::max(by_way, other.by_way);
    by_turn = std::max(by_turn, other.by_turn);
    by_time = std::max(by_time, other.by_time);
  }
};

class SeenBodies {
 public:
  SeenBodies() = default;
  explicit SeenBodies(std::vector<int> bodies);

  void see(const Configuration& at);

  /// NaN where a number is.
  Wandered wandered(const Configuration& to) const;

  /// From where a step begins to `to`, of all columns: by its arcs, which a whole turn does not take back.
  Wandered way_of_step(const StepBegin& begin, const Points& to) const;

  /// The same to where the step leads by its free motion.
  Wandered free_motion(const StepBegin& begin) const;

 private:
  template <class At>
  Wandered way(const StepBegin& begin, At&& to) const;

  std::vector<int> body_;   // each once
  std::vector<Pose> pose_;  // of these
  double time_ = 0;         // s
};

}  // namespace pbd
