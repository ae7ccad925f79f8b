// The search of a pilot's grid for its quickest settings.
#pragma once

#include <chrono>
#include <string>

#include "harness/pilot.h"

namespace pbdcheck {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// By auto and direct.
pbd::Method usual_method(const SceneFile& file, const std::string& integrator, double tolerance);

/// The settings of a pilot whose truth is told, within so many seconds; from the best of a pilot before, if
/// there is one.
Pilot searched(const SceneFile& file, Pilot pilot, double error, double seconds, const Pilot& before);

}  // namespace pbdcheck
