// quasi_newton and the rival, Newton's method, each ready to do steps of a scene and to be watched.
#pragma once

#include <array>
#include <functional>
#include <string_view>

#include "harness/measure.h"

namespace pbdcheck {

inline constexpr double contested_step_s = 1.0 / 60;

using StepWatch = std::function<void(int iteration, const pbd::Points& x)>;

/// A step by a method that is ready for its scene.
using WatchedStep = std::function<pbd::Report(pbd::State& state, const StepWatch& watch)>;

struct Contestant {
  std::string_view name;
  WatchedStep (*ready)(const pbd::Scene& scene, double tolerance);
};

WatchedStep ready_quasi_newton(const pbd::Scene& scene, double tolerance);
WatchedStep ready_rival(const pbd::Scene& scene, double tolerance);

inline constexpr std::array<Contestant, 2> contestants{
    {{"quasi_newton", ready_quasi_newton}, {"newton", ready_rival}}};

/// s, of a clock that does not go back.
double now_s();

/// The step once, its time without the watching; the last point's is that of the whole step.
Trace watched(const WatchedStep& step, const pbd::State& start, const pbd::Points& exact);

}  // namespace pbdcheck
