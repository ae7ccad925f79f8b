// Motion of a scene with rigid bodies in continuous time, by accelerations.
//
//   x' = v, M v' = f + J_x^T gamma;   q' = q (0, w)/2,  I w' = R^T tau - w x I w + J_d^T gamma
//   hard rows:  J a = -(v, w)^T c'' (v, w), so that c stays what it is, up to the errors of the integration
//   compliant:  gamma = -A^-1 c
//
// a = (v', w') is the free acceleration moved by the least |M^1/2 da| that fulfils the hard rows: what their
// forces do, redundant or not (Gauss's principle). Solved densely by a complete orthogonal decomposition.
#pragma once

#include "numerics.h"
#include "rigid_rows.h"

namespace pbd::reference {

/// Largest |c| over the length of its gradient (m), and of its rate (m/s); turns count times the radius of
/// gyration.
struct Drift {
  double position = 0, velocity = 0;
};

/// T + U - f.x, x counted from the start, J; and T + |U - f.x|.
struct Energy {
  double value, size;
};

class RigidMotion {
 public:
  /// Throws SetupError where the initial state does not fulfil hard rows or their rates to 1e-10.
  explicit RigidMotion(const Scene& scene);

  Vector start() const;
  /// y = (x, v, w) of the unknowns, then the quaternions of the bodies of finite inertia.
  void slope(double t, const Vector& y, Vector& slope) const;
  State state(double t, const Vector& y) const;

  /// Of the hard rows.
  Drift drift(const State& state) const;
  Energy energy(const State& state) const;
  /// Whether nothing but forces with a potential does work.
  bool conservative() const;
  /// True if the rank of the hard rows was not the same all the time: a singular place.
  bool rank_changed() const { return least_rank_ < most_rank_; }

 private:
  const Scene& scene_;
  RigidModel model_;
  mutable int least_rank_ = 1 << 30, most_rank_ = -1;
};

}  // namespace pbd::reference
