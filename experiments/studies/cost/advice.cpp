// What `pbdcheck advise` recommends, measured anew on scene files that no setting of it was chosen by: does
// it meet the error asked, beside a truth of twice as many steps, and is no other setting of its grid that
// does more than 1.5 times faster?
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "error.h"
#include "harness/files.h"
#include "harness/measure.h"
#include "harness/pilot.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// None of them is among the scenes of `trajectories`; the quick tier has the first three.
constexpr std::array<std::string_view, 12> advised_scenes{
    "spring",      "net",     "boxes_at_edges", "top",        "linkage",           "cable_arm",
    "mass_on_bar", "capstan", "dominoes",       "trampoline", "box_on_soft_block", "strip_over_cylinder"};

constexpr double asked = 0.01;  // error
constexpr double faster = 1.5;  // times: what counts as quicker

/// The least wall time, s, of a setting that meets the error asked and is more than so much faster than
/// `best_s`; `best_s` if there is none. All longer steps are tried, and half the step.
double quickest_other(const SceneFile& file, const Pilot& found, const Truth& truth, double best_s) {
  double least = best_s;
  const std::int64_t most = 2 * found.met[0].setting.steps;
  for (std::int64_t steps = fewest_steps(file, found.duration); steps <= most; steps *= 2)
    for (const Setting& setting : pilot_grid(file, steps)) try {
        const Limits limits{.wall_s = least / (least == best_s ? faster : 1)};
        const Trajectory other = trajectory(file, found.duration, setting, limits);
        const bool meets = truth.told(end_error(file.scene, other, truth.end)) <= asked;
        if (meets && other.wall_s < limits.wall_s) least = other.wall_s;
      } catch (const SetupError&) {  // not for this scene
      }
  return least;
}

}  // namespace

void advice(Context& context) {
  const std::ptrdiff_t count = context.full() ? std::ssize(advised_scenes) : 3;
  const double seconds = context.full() ? 30 : 10;
  context.begin(count);
  Table table = context.table("recommended", {"scene", "duration_s", "error_asked", "step_s", "integrator",
                                              "outer", "relaxation", "tolerance", "settings", "error",
                                              "error_bar", "wall_s", "wall_s_other", "status", "reason"});
  Worst missed, slower;
  for (const std::string_view name : std::span(advised_scenes).first(static_cast<std::size_t>(count))) {
    const SceneFile file = read_scene_file(scenes_folder() / fmt::format("{}.toml", name));
    const Pilot found = pilot(file, asked, seconds);
    const Truth truth = pilot_truth(file, found.duration, asked, 2 * found.truth_steps);
    Setting setting;
    double error = std::nan(""), wall = error, other = error;
    std::string reason = "no setting found";
    if (!found.met.empty()) {
      setting = found.met[0].setting;
      const Trajectory again = timed_trajectory(file, found.duration, setting);
      error = truth.told(end_error(file.scene, again, truth.end));
      wall = again.wall_s;
      other = quickest_other(file, found, truth, wall);
      reason = again.reason;
      missed.add(error / asked, name);
      slower.add(wall / other, name);
    }
    const Method& m = setting.method;
    table.row({std::string(name), found.duration, asked, found.duration / static_cast<double>(setting.steps),
               m.integrator, m.outer, m.relaxation, m.tolerance, found.tried, error, truth.error_bar, wall,
               other, std::string(found.met.empty() ? "skipped" : "ok"), reason});
    context.advance(name);
  }
  table.close();
  context.verdict(Basis::code, "advice.meets",
                  "settings that are recommended meet the error asked, measured anew",
                  fmt::format("largest error over that asked ({})", missed.owner()), missed.value(), 1);
  context.verdict(Basis::goal, "advice.quickest",
                  "no other setting of the grid that meets the error is more than 1.5 times faster",
                  fmt::format("time over that of the quickest other ({})", slower.owner()), slower.value(),
                  faster);
}

}  // namespace pbdcheck
