#include "harness/pilot.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "error.h"
#include "outer/outer_names.h"
#include "step/integrators.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double slack = 1.5;            // of times that are as good as the best one, as far as clocks tell
constexpr double share_of_probe = 0.02;  // of the budget: the scene as it stands; 16 times finer is a third
constexpr int doublings = 4;             // of the scene's own step, the longest of the grid

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Method usual_method(const SceneFile& file, const std::string& integrator, double tolerance) {
  Method method = file.method;
  method.integrator = integrator;
  method.outer = "auto";
  method.relaxation = "direct";
  method.tolerance = tolerance;
  return method;
}

/// s, a whole number of the scene's steps: what `wall_s` seconds simulate of it.
double affordable(const SceneFile& file, double wall_s) {
  const double all = static_cast<double>(file.steps) * file.step_s;
  Setting setting{usual_method(file, file.method.integrator, file.method.tolerance), file.steps, true};
  const Trajectory probe = trajectory(file, all, setting, {.wall_s = wall_s});
  const double steps = std::floor(probe.end.time / probe.wall_s * wall_s / file.step_s);
  return std::clamp(steps * file.step_s, std::min(all, 8 * file.step_s), all);  // 8: to be halved three times
}

/// Ever finer until a third of `error` can be told or the next level would not end within `seconds`. Its
/// steps are solved to a thousandth of that error.
Truth sharp_truth(const SceneFile& file, double duration, double error, double seconds, std::int64_t& steps) {
  const Stopwatch all;
  for (;; steps *= 2) {
    const Stopwatch level;
    Truth truth = pilot_truth(file, duration, error, steps);
    if (truth.told(0) <= error / 3 || all.seconds() + 2 * level.seconds() > seconds) return truth;
  }
}

class Search {
 public:
  Search(const SceneFile& file, double error, double seconds)
      : file_(file), error_(error), seconds_(seconds) {
    pilot_.duration = affordable(file, share_of_probe * seconds);
    pilot_.truth_steps = 2 * std::lround(pilot_.duration / file.step_s);
    pilot_.truth = sharp_truth(file, pilot_.duration, error, seconds / 2, pilot_.truth_steps);
  }

  Pilot run() {
    std::vector<std::string> open;
    for (const Integrator& integrator : integrators()) open.emplace_back(integrator.name);
    // Longest steps first, and of each step the default pair at a middling tolerance first of all.
    for (std::int64_t steps = fewest_steps(file_, pilot_.duration); !open.empty() && pilot_.complete;
         steps *= 2)
      std::erase_if(open, [&](const std::string& integrator) { return settled(integrator, steps); });
    std::sort(pilot_.met.begin(), pilot_.met.end(),
              [](const PilotRun& a, const PilotRun& b) { return a.wall_s < b.wall_s; });
    return std::move(pilot_);
  }

 private:
  /// True if shorter steps by this integrator cannot be the answer.
  bool settled(const std::string& integrator, std::int64_t steps) {
    const Setting usual{usual_method(file_, integrator, pilot_tolerances[2]), steps};
    try {
      const Outcome outcome = measure_setting(usual);
      if (outcome == Outcome::slow) return true;
      if (outcome == Outcome::missed) return !pilot_.complete;
    } catch (const SetupError&) {  // not for this scene
      return true;
    }
    try_others(usual, steps);
    // Where the default pair missed the error by little, or its tolerance, another one may meet it.
    if (steps / 2 >= fewest_steps(file_, pilot_.duration)) try_others(usual, steps / 2);
    return true;
  }

  /// All choices by the integrator of `usual` in so many steps.
  void try_others(const Setting& usual, std::int64_t steps) {
    for (Setting& other : pilot_grid(file_, steps)) {
      const Method &m = other.method, &u = usual.method;
      const bool same = steps == usual.steps && m.outer == u.outer && m.relaxation == u.relaxation &&
                        m.tolerance == u.tolerance;
      if (m.integrator == u.integrator && !same && pilot_.complete) try {
          measure_setting(other);
        } catch (const SetupError&) {  // not for this scene
        }
    }
  }

  enum class Outcome { met, missed, slow };

  Outcome measure_setting(const Setting& setting) {
    if (watch_.seconds() > seconds_) {
      pilot_.complete = false;
      return Outcome::missed;
    }
    ++pilot_.tried;
    const double bound = std::min(slack * best_, seconds_ / 4);
    const Trajectory found = timed_trajectory(file_, pilot_.duration, setting, {.wall_s = bound});
    const double error = pilot_.truth.told(end_error(file_.scene, found, pilot_.truth.end));
    const PilotRun run{setting, found.wall_s, error};
    if (std::isfinite(error) && (!pilot_.nearest || error < pilot_.nearest->error)) pilot_.nearest = run;
    if (error + pilot_.truth.error_bar <= error_) {
      pilot_.met.push_back(run);
      best_ = std::min(best_, found.wall_s);
      return Outcome::met;
    }
    return found.wall_s > bound ? Outcome::slow : Outcome::missed;
  }

  const SceneFile& file_;
  double error_, seconds_, best_ = std::numeric_limits<double>::infinity();
  Pilot pilot_;
  Stopwatch watch_;  // from before the truth on
};

}  // namespace

Truth pilot_truth(const SceneFile& file, double duration, double error, std::int64_t steps) {
  const Setting finest{usual_method(file, "", std::max(1e-10, 1e-3 * error)), steps};
  return agreed_truth(file, duration, finest, {"implicit_euler", "generalised_alpha", "newmark"});
}

std::int64_t fewest_steps(const SceneFile& file, double duration) {
  return std::max<std::int64_t>(std::lround(duration / file.step_s) >> doublings, 1);
}

std::vector<Setting> pilot_grid(const SceneFile& file, std::int64_t steps) {
  std::vector<Setting> grid;
  for (const Integrator& integrator : integrators())
    for (const OuterName& outer : outer_names())
      for (const std::string_view relaxation : pilot_relaxations)
        for (const double tolerance : pilot_tolerances) {
          if (!outer.solves_step || (outer.name == "quasi_newton" && relaxation != "direct")) continue;
          Setting setting{usual_method(file, std::string(integrator.name), tolerance), steps};
          setting.method.outer = outer.name;
          setting.method.relaxation = relaxation;
          grid.push_back(setting);
        }
  return grid;
}

Pilot pilot(const SceneFile& file, double error, double seconds) {
  return Search(file, error, seconds).run();
}

}  // namespace pbdcheck
