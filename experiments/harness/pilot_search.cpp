#include "harness/pilot_search.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "error.h"
#include "outer/outer_names.h"
#include "scenes/contacts.h"
#include "step/integrators.h"

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr double slack = 1.5;  // of times that are as good as the best one, as far as clocks tell
constexpr int doublings = 4;   // of the scene's own step, the longest of the grid

bool quicker(const PilotRun& a, const PilotRun& b) {
  return a.wall_s < b.wall_s;
}

/// Those of the grid. Surfaces that explicit forces blow up have all of their triangles near each other: a
/// step takes minutes then.
std::vector<std::string> grid_integrators(const SceneFile& file) {
  const Contact* contact = contact_of(file.scene);
  const bool surfaces = contact != nullptr && !contact->triangle.empty();
  std::vector<std::string> names;
  for (const Integrator& integrator : integrators())
    if (!(surfaces && integrator.explicit_forces)) names.emplace_back(integrator.name);
  return names;
}

/// The settings of one pilot, whose truth is told.
class Search {
 public:
  Search(const SceneFile& file, Pilot pilot, double error, double seconds)
      : file_(file), error_(error), seconds_(seconds), pilot_(std::move(pilot)) {}

  /// From the best of a pilot before, if there is one.
  Pilot run(const Pilot& before) {
    steps_ = fewest_steps(file_, pilot_.duration);
    if (before.met.empty()) {
      while (8 * steps_ <= pilot_.truth_steps) steps_ *= 2;
    } else {
      Setting setting = before.met[0].setting;
      const double step = before.duration / static_cast<double>(setting.steps);
      while (static_cast<double>(steps_) * step < pilot_.duration * (1 - 1e-9)) steps_ *= 2;
      setting.steps = steps_;
      try_one(setting);
    }
    for (const std::string& integrator : grid_integrators(file_)) try_steps(integrator);
    while (descends()) {
    }
    std::sort(pilot_.met.begin(), pilot_.met.end(), quicker);
    pilot_.complete = watch_.seconds() <= seconds_;
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
    if (!is_new(setting) || watch_.seconds() > seconds_) return Outcome::refused;
    try {
      return measure_setting(setting);
    } catch (const SetupError&) {
      return Outcome::refused;
    }
  }

  Outcome measure_setting(const Setting& setting) {
    ++pilot_.tried;
    const double bound = std::min({slack * best_, seconds_ / 4, seconds_ - watch_.seconds()});
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
  Stopwatch watch_;
};

}  // namespace

Method usual_method(const SceneFile& file, const std::string& integrator, double tolerance) {
  Method method = file.method;
  method.integrator = integrator;
  method.outer = "auto";
  method.relaxation = "direct";
  method.tolerance = tolerance;
  return method;
}

std::int64_t fewest_steps(const SceneFile& file, double duration) {
  return std::max<std::int64_t>(std::lround(duration / file.step_s) >> doublings, 1);
}

std::vector<Setting> pilot_grid(const SceneFile& file, std::int64_t steps) {
  std::vector<Setting> grid;
  for (const std::string& integrator : grid_integrators(file))
    for (const OuterName& outer : outer_names())
      for (const std::string_view relaxation : pilot_relaxations)
        for (const double tolerance : pilot_tolerances) {
          if (!outer.solves_step || (outer.name == "quasi_newton" && relaxation != "direct")) continue;
          Setting setting{usual_method(file, integrator, tolerance), steps};
          setting.method.outer = outer.name;
          setting.method.relaxation = relaxation;
          grid.push_back(setting);
        }
  return grid;
}

Pilot searched(const SceneFile& file, Pilot pilot, double error, double seconds, const Pilot& before) {
  return Search(file, std::move(pilot), error, seconds).run(before);
}

}  // namespace pbdcheck
