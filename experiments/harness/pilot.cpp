#include "harness/pilot.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

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

bool quicker(const PilotRun& a, const PilotRun& b) {
  return a.wall_s < b.wall_s;
}

Method usual_method(const SceneFile& file, const std::string& integrator, double tolerance) {
  Method method = file.method;
  method.integrator = integrator;
  method.outer = "auto";
  method.relaxation = "direct";
  method.tolerance = tolerance;
  return method;
}

/// s, of a pilot: to be halved three times.
double least_duration(const SceneFile& file) {
  return std::min(static_cast<double>(file.steps), 8.0) * file.step_s;
}

/// s, a whole number of the scene's steps: what `wall_s` seconds simulate of it.
double affordable(const SceneFile& file, double wall_s) {
  const double all = static_cast<double>(file.steps) * file.step_s;
  Setting setting{usual_method(file, file.method.integrator, file.method.tolerance), file.steps, true};
  const Trajectory probe = trajectory(file, all, setting, {.wall_s = wall_s});
  const double steps = std::floor(probe.end.time / probe.wall_s * wall_s / file.step_s);
  return std::clamp(steps * file.step_s, least_duration(file), all);
}

/// Ever finer, of steps that are solved to a thousandth of `error`, until a third of it can be told; ends
/// where what a run can be told to meet would take more than `seconds`, its bar being of first order.
Truth sharp_truth(const SceneFile& file, double duration, double error, double seconds, std::int64_t& steps) {
  const Stopwatch all;
  for (;; steps *= 2) {
    const Stopwatch level;
    Truth truth = pilot_truth(file, duration, error, steps);
    const double next = level.seconds() * std::max(2.0, truth.least_met() / error);
    if (truth.told(0) <= error / 3 || !(all.seconds() + next <= seconds)) return truth;
  }
}

class Search {
 public:
  Search(const SceneFile& file, double error, double seconds)
      : file_(file), error_(error), seconds_(seconds) {
    double duration = affordable(file, share_of_probe * seconds);
    for (bool first = true;; first = false) {
      std::int64_t steps = 2 * std::lround(duration / file.step_s);
      const Truth truth = sharp_truth(file, duration, error, seconds / 2 - watch_.seconds(), steps);
      if (first || std::isnan(pilot_.truth.error_bar) || truth.error_bar < pilot_.truth.error_bar) {
        pilot_.duration = duration;
        pilot_.truth_steps = steps;
        pilot_.truth = truth;
      }
      if (truth.least_met() <= error || duration <= least_duration(file) || watch_.seconds() > seconds / 2)
        break;
      duration = std::max(std::round(duration / file.step_s / 2) * file.step_s, least_duration(file));
    }
  }

  Pilot run() {
    steps_ = fewest_steps(file_, pilot_.duration);
    while (8 * steps_ <= pilot_.truth_steps) steps_ *= 2;
    for (const Integrator& integrator : integrators()) try_steps(std::string(integrator.name));
    while (descends()) {
    }
    std::sort(pilot_.met.begin(), pilot_.met.end(), quicker);
    return std::move(pilot_);
  }

 private:
  /// From where the last integrator met the error, to longer steps while this one does, else to shorter
  /// ones until it does: by auto and direct, solved to a middling tolerance.
  void try_steps(const std::string& integrator) {
    const auto at = [&](std::int64_t steps) {
      return try_one({usual_method(file_, integrator, pilot_tolerances[2]), steps});
    };
    Outcome outcome = at(steps_);
    if (outcome == Outcome::met)
      while (steps_ / 2 >= fewest_steps(file_, pilot_.duration) && at(steps_ / 2) == Outcome::met)
        steps_ /= 2;
    else
      for (std::int64_t steps = 2 * steps_; outcome == Outcome::missed && steps <= pilot_.truth_steps;
           steps *= 2)
        if ((outcome = at(steps)) == Outcome::met) steps_ = steps;
  }

  /// From the quickest one found to a quicker one, if there is one beside it: of its integrator or else of
  /// its tolerance, in as many steps, half or twice as many. False where there is none.
  bool descends() {
    if (pilot_.met.empty()) return false;
    const Setting from = quickest();
    const double before = best_;
    const std::int64_t least = fewest_steps(file_, pilot_.duration);
    for (const bool same_integrator : {true, false})
      for (const std::int64_t steps : {from.steps, from.steps / 2, 2 * from.steps}) {
        if (steps < least) continue;
        for (const Setting& setting : pilot_grid(file_, steps)) {
          const Method& m = setting.method;
          if (same_integrator ? m.integrator == from.method.integrator : m.tolerance == from.method.tolerance)
            try_one(setting);
        }
        if (best_ < before) return true;
      }
    return false;
  }

  Setting quickest() const {
    return std::min_element(pilot_.met.begin(), pilot_.met.end(), quicker)->setting;
  }

  bool is_new(const Setting& setting) {
    const Method& m = setting.method;
    return tried_.insert({setting.steps, m.integrator, m.outer, m.relaxation, m.tolerance}).second;
  }

  enum class Outcome { met, missed, slow, refused };

  /// Refused are settings that the scene does not allow, that were tried before, and all at the end of the
  /// budget.
  Outcome try_one(const Setting& setting) {
    if (!is_new(setting)) return Outcome::refused;
    if (watch_.seconds() > seconds_) {
      pilot_.complete = false;
      return Outcome::refused;
    }
    try {
      return measure_setting(setting);
    } catch (const SetupError&) {
      return Outcome::refused;
    }
  }

  Outcome measure_setting(const Setting& setting) {
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
  std::int64_t steps_ = 0;  // where the last integrator met the error
  Pilot pilot_;
  std::set<std::tuple<std::int64_t, std::string, std::string, std::string, double>> tried_;
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
