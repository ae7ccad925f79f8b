// One step by one method, watched: how the error falls with iterations, sweeps, row updates and time.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "harness/verdict.h"
#include "rivals/rival.h"
#include "scene.h"
#include "step/step.h"

namespace pbdcheck {

/// The step after `outer_iterations`. `wall_s` begins with the making of workspace or rival, leaves out the
/// observer and is the smallest of the repeats.
struct TracePoint {
  int outer_iterations = 0;
  std::int64_t sweeps = 0;
  std::int64_t row_updates = 0;
  double wall_s = 0;
  double error = 0;     // see relative_error
  double residual = 0;  // relative to the step's scale
};

struct Trace {
  std::vector<TracePoint> points;  // from the first iterate to the step's end
  pbd::Report report;
  bool met_on_way = false;  // contacts act that met on the way of the step, which no judge knows
};

/// How often a step is timed, after a first run that is thrown away (it warms caches and the allocator).
inline constexpr int timed_repeats = 3;

/// Largest of the values added: NaN once one of them was NaN, and NaN if there was none, so that no verdict
/// holds on nothing.
class Worst {
 public:
  /// `owner`: whose value it is, as a linear solver's.
  void add(double value, std::string_view owner = {}) {
    if (spoilt_ || (any_ && value <= largest_)) return;
    largest_ = value;
    owner_ = owner;
    any_ = true;
    spoilt_ = std::isnan(value);
  }
  double value() const { return any_ ? largest_ : std::nan(""); }
  /// Whose value it is: of the largest, or the first NaN.
  const std::string& owner() const { return owner_; }

 private:
  double largest_ = 0;
  std::string owner_;
  bool any_ = false, spoilt_ = false;
};

/// The same of numbers with a spread.
class WorstSpread {
 public:
  void add(const Measured& size, std::string_view owner) {
    low_.add(size.low);
    middle_.add(size.value, owner);
    high_.add(size.high);
  }
  Measured value() const {
    Measured worst(middle_.value());
    worst.low = low_.value();
    worst.high = high_.value();
    return worst;
  }
  const std::string& owner() const { return middle_.owner(); }

 private:
  Worst low_, middle_, high_;
};

/// Positions of nodes, of bodies those that are not held, and of points of each body of finite inertia at its
/// radii of gyration along the principal axes (1 m of a held centre), 3 x (N + 3 B) at most.
pbd::Points places(const pbd::Scene& scene, const pbd::Points& x,
                   const std::vector<Eigen::Quaterniond>& orientation);

/// m, of those points from the centre of a body of finite inertia, along its axes.
pbd::Vec3 gyration_radii(const pbd::Scene& scene, const pbd::RigidBody& body);

/// What rounding may move a place by, of its coordinates.
inline constexpr double rounded_place = 64 * std::numeric_limits<double>::epsilon();

/// max |x - reference| / max |reference - start| over the places, a displacement below `least` (m) counting
/// as that; the numerator in metres if nothing moved but by rounding; NaN where the displacement is not
/// finite.
double relative_error(const pbd::Points& x, const pbd::Points& reference, const pbd::Points& start,
                      double least = 0);

/// Does the step of h seconds from `state` once with a fresh workspace (no warm start), against the places at
/// its end `exact`; one that goes on from the last step of `before`, if there is one. Throws SetupError as
/// Workspace does, and Interrupted.
Trace measure_once(const pbd::Scene& scene, const pbd::State& state, double h, const pbd::Method& method,
                   const pbd::Points& exact, const pbd::Workspace* before = nullptr);

/// The same by a rival, of scenes without bodies. Throws SetupError as its making does.
Trace measure_once(const pbd::Scene& scene, const pbd::State& state, double h,
                   const pbd::rivals::NamedRival& rival, const pbd::rivals::Budget& budget,
                   const pbd::Points& exact);

/// `once` `timed_repeats` times after a discarded run, with the smallest times; a step that misses its
/// tolerance is done once.
Trace measure(const std::function<Trace()>& once);

/// A rival's report as our solver would give it.
pbd::Report report_of(const pbd::rivals::Report& report);

}  // namespace pbdcheck
