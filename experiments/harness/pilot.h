// A pilot on a user's scene: which integrator, outer iteration, relaxation, tolerance and step come to an
// error in the least time.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/trajectory.h"

namespace pbdcheck {

/// The grid: these and all integrators (explicit ones not where surfaces touch), outer iterations that solve
/// the step, and steps of the scene's own halved or doubled again and again. The laws of contact and friction
/// are the scene's: they are its question.
inline constexpr std::array<std::string_view, 3> pilot_relaxations{"gauss_seidel", "conjugate_gradients",
                                                                   "direct"};
inline constexpr std::array<double, 4> pilot_tolerances{1e-2, 1e-4, 1e-6, 1e-8};

struct PilotRun {
  Setting setting;
  double wall_s;
  double error;  // as the truth can tell it (`Truth::told`); NaN of a run that is not ok
};

struct Pilot {
  double duration = 0;  // s, of the motion: as much of the scene's as the budget can tell the end of
  Truth truth{};
  std::int64_t truth_steps = 0;
  std::vector<PilotRun> met{};        // error and the truth's bar within the error asked, the quickest first
  std::optional<PilotRun> nearest{};  // with the least error, where none met it
  std::int64_t tried = 0;
  bool complete = true;  // false: the budget ended the search
  double untold = 0;     // s, the shortest longer one that was tried, in vain; 0: none
  double spent_s = 0;    // wall time
  double needed_s = 0;   // s, of wall time, at least, where time was too short for a truth

  double ms_per_s(const PilotRun& run) const { return 1e3 * run.wall_s / duration; }
};

/// How a scene is solved by every choice of the grid in `steps` steps.
std::vector<Setting> pilot_grid(const SceneFile& file, std::int64_t steps);

/// Those of the grid's longest step.
std::int64_t fewest_steps(const SceneFile& file, double duration);

/// By so many steps, solved to a thousandth of `error`, or what there is of it after `wall_s` seconds.
Truth pilot_truth(const SceneFile& file, double duration, double error, std::int64_t steps,
                  double wall_s = std::numeric_limits<double>::infinity());

/// Searches the grid on the first part of the motion: the longest whose end `seconds` of wall time tell so
/// sharply that a run can be told to meet `error`. A quarter of the time goes into the truth, half of it
/// if need be, then, after a search, what is left into longer parts. A run ends where it takes 1.5 times the
/// best one. By auto and direct each integrator's longest step is found that meets the error; from the
/// quickest one the search goes on to what shares its integrator or its tolerance, while that is quicker.
/// Where no end is told that sharply, the search tells the nearest setting; without any truth it does not
/// begin.
Pilot pilot(const SceneFile& file, double error, double seconds);

}  // namespace pbdcheck
