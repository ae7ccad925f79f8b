// Anderson's acceleration (anderson.h), taken back where the residual refutes it.
#pragma once

#include "outer/anderson.h"
#include "outer/step_system.h"

namespace pbd {

class Acceleration {
 public:
  explicit Acceleration(int memory) : anderson_(memory) {}

  void forget() {
    anderson_.forget();
    accelerated_ = false;
  }

  /// True if v has been taken back to the last image, so that all has to be linearised again before `note`:
  /// where the residual has grown by more than a factor.
  bool refuted(StepSystem& system, const Progress& progress, double too_much = 10);

  /// The next image comes from here.
  void note(const StepSystem& system) { anderson_.begin(system.rows, system.at.v); }

  /// True if it moved v.
  bool accelerate(StepSystem& system) {
    accelerated_ = anderson_.accelerate(system.problem.inverse_mass, system.rows, system.at.v);
    return accelerated_;
  }

  /// Takes v back to the last image.
  void reject(StepSystem& system) {
    anderson_.reject(system.rows, system.at.v);
    accelerated_ = false;
  }

 private:
  Anderson anderson_;
  bool accelerated_ = false;  // v is not an image of the iteration, but its acceleration
  double last_residual_ = 0;
};

}  // namespace pbd
