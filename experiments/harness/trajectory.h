// A scene's motion over some time by one method and step, timed: how far from the true motion it ends.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "harness/results.h"
#include "numerics.h"
#include "scenes/scene_file.h"
#include "step/step.h"

namespace pbdcheck {

/// How a motion is simulated: in `steps` equal ones.
struct Setting {
  pbd::Method method{};
  std::int64_t steps = 1;
  bool by_count = false;  // does its iterations and stops, solved or not: a missed tolerance is no failure
};

/// What became of it. Not ok: it ended at the first step that missed or diverged, and
/// `error` is NaN.
struct Trajectory {
  pbd::State end;
  double wall_s = 0;  // making of the workspace and steps; the least of the repeats
  std::int64_t outer_iterations = 0, sweeps = 0, row_updates = 0, missed_steps = 0;
  std::int64_t rows = 0, bytes = 0;                            // of the last step
  double penetration_m = 0;                                    // deepest overlap that a step ends with
  double touched_s = std::numeric_limits<double>::infinity();  // when contacts first exerted a force
  pbd::Status status = pbd::Status::ok;
  std::string reason{};
};

/// integrator, outer, relaxation (none of quasi_newton, which relaxes nothing), friction (none without
/// contact) and tolerance.
std::vector<Cell> method_cells(const pbd::Scene& scene, const pbd::Method& method);

/// outer_iterations, sweeps, row_updates, missed_steps, bytes and wall_s.
std::vector<Cell> work_cells(const Trajectory& found);

/// Where a trajectory is given up: as not converged after this wall time, as diverged this far from its
/// start.
struct Limits {
  double wall_s = std::numeric_limits<double>::infinity();
  double way_m = std::numeric_limits<double>::infinity();
};

/// From the scene's start over `duration` (s). Throws SetupError where the scene does not allow the method,
/// and Interrupted.
Trajectory trajectory(const SceneFile& file, double duration, const Setting& setting,
                      const Limits& limits = {});

/// The same with the least wall time of up to `timed_repeats` runs: short ones, which a hiccup of the machine
/// would distort, are done again.
Trajectory timed_trajectory(const SceneFile& file, double duration, const Setting& setting,
                            const Limits& limits = {});

/// MB (1e6 bytes) that simulating so takes: what a workspace and a step from `state` have allocated
/// (`AllocatedMemory`), at the outer iteration or the step's end where that is the most. It is made and done
/// for that alone, so that no timed run is disturbed; what is taken and freed within an iteration is not
/// seen. `Trajectory::bytes` are those of rows alone, without factors, kept iterates and the scene.
double step_memory_mb(const SceneFile& file, double duration, const Setting& setting,
                      const pbd::State& state);

/// Where a motion ends and how far that may be from the true end, as `end_error`.
struct Truth {
  pbd::State end{};
  double error_bar = std::numeric_limits<double>::quiet_NaN();
  std::string method{};
  bool touched = false;  // contacts exerted a force on the way
  double wall_s = 0;     // of its runs
  bool in_time = true;   // they ended before they were given up
  std::string reason{};  // why there is no bar

  /// An error that this truth can tell: below three of its bars there is none.
  double told(double error) const { return error < 3 * error_bar ? 3 * error_bar : error; }
  bool tells(double error) const { return error >= 3 * error_bar; }
  double least_met() const { return told(0) + error_bar; }  // that a run can be told to be within
};

/// Of the size of what moves (the diagonal of its bounding box at the start): a scene that is at rest is as
/// exact as its error of this.
inline constexpr double least_way = 1e-3;

/// m, what errors at the end are relative to: the farthest way of a place, but `least_way` at least.
double error_scale(const pbd::Scene& scene, const pbd::State& truth);

/// Of the place that is farthest from where the truth has it, over `error_scale`; NaN unless the trajectory
/// is ok.
double end_error(const pbd::Scene& scene, const Trajectory& found, const pbd::State& truth);

/// Throws SetupError unless the scene's motion is that of an ODE that `reference/ode.h` states.
void require_ode(const SceneFile& file);

/// The end by that ODE. Throws SetupError as `require_ode`, and Interrupted.
Truth ode_truth(const SceneFile& file, double duration, pbd::reference::OdeSettings settings = {});

/// The end of `finest`; its bar is the distance to the same with half as many steps: of any order from the
/// first on that bounds the error of the finer run, in the limit of short steps. NaN where one is not ok, as
/// after `wall_s` seconds for both.
Truth finer_steps_truth(const SceneFile& file, double duration, const Setting& finest,
                        double wall_s = std::numeric_limits<double>::infinity());

/// The best of the same by each of `integrators` that the scene allows: the one with the smallest bar of
/// those that end where the first one does, as far as both bars tell. The first is to be one that is right
/// wherever it converges, as implicit Euler, whose impacts obey the law of restitution as the step vanishes.
/// After `wall_s` seconds it is the best one so far.
Truth agreed_truth(const SceneFile& file, double duration, Setting finest,
                   const std::vector<std::string>& integrators,
                   double wall_s = std::numeric_limits<double>::infinity());

/// m, of the place that ends farthest from its start.
double way(const pbd::Scene& scene, const pbd::State& end);

/// Difference of total energies over what the true motion turned over: its kinetic energy, its elastic energy
/// and the change of gravity's from `start`, in joules if that was rounding; NaN unless the trajectory is ok.
double energy_error(const pbd::Scene& scene, const Trajectory& found, const pbd::State& truth);

}  // namespace pbdcheck
