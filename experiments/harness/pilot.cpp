#include "harness/pilot.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "error.h"
#include "outer/outer_names.h"
#include "scenes/contacts.h"
#include "step/integrators.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double slack = 1.5;            // of times that are as good as the best one, as far as clocks tell
constexpr double share_of_probe = 0.02;  // of the budget: the scene as it stands; 16 times finer is a third
constexpr int doublings = 4;             // of the scene's own step, the longest of the grid
constexpr double least_steps = 8;        // of the scene's own, of a pilot: to be halved three times

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

Method usual_method(const SceneFile& file, const std::string& integrator, double tolerance) {
  Method method = file.method;
  method.integrator = integrator;
  method.outer = "auto";
  method.relaxation = "direct";
  method.tolerance = tolerance;
  return method;
}

/// The scene as it stands for `wall_s` seconds at most.
Trajectory probed(const SceneFile& file, double wall_s) {
  const Setting setting{usual_method(file, file.method.integrator, file.method.tolerance), file.steps, true};
  return trajectory(file, static_cast<double>(file.steps) * file.step_s, setting, {.wall_s = wall_s});
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

/// Pilots of ever longer parts of a scene's motion, while their ends can be told.
class Growth {
 public:
  Growth(const SceneFile& file, double error, double seconds)
      : file_(file), error_(error), seconds_(seconds), probe_(probed(file, share_of_probe * seconds)) {}

  Pilot run() {
    Pilot best;
    double truth_s = seconds_ / 4;
    while (grows(truth_s)) {
      const Stopwatch search;
      Pilot longer = Search(file_, told_, error_, left()).run(best);
      truth_s = std::max(0.6 * left(), left() - search.seconds());
      if (!best.met.empty() && longer.met.empty()) {
        untold_ = told_;
        break;
      }
      best = std::move(longer);
    }
    if (told_.duration == 0)
      best = blurred();
    else
      best.untold = untold_.duration;
    best.spent_s = watch_.seconds();
    return best;
  }

 private:
  /// Of what is not told sharply the nearest setting, or what it takes to tell any.
  Pilot blurred() const {
    Pilot pilot = untold_;
    if (!std::isnan(pilot.truth.error_bar)) return Search(file_, pilot, error_, left()).run({});
    pilot.needed_s = least_need();
    return pilot;
  }

  double left() const { return seconds_ - watch_.seconds(); }

  /// s, of whole steps of the scene.
  double of_steps(double count) const { return std::floor(count + 1e-9) * file_.step_s; }

  double whole() const { return of_steps(static_cast<double>(file_.steps)); }

  double least() const { return of_steps(std::min(static_cast<double>(file_.steps), least_steps)); }

  /// What the probe's pace simulates in its time, or else the least.
  double first_duration() const {
    const double affordable = probe_.end.time / probe_.wall_s * share_of_probe * seconds_;
    return std::clamp(of_steps(affordable / file_.step_s), least(), whole());
  }

  /// s, of wall time, at the pace of the truth that was given up: half of it makes all its steps, and half as
  /// many.
  double least_need() const {
    const Truth& truth = untold_.truth;
    return 2 * 1.5 * untold_.duration * truth.wall_s / std::max(truth.end.time, file_.step_s / 2);
  }

  /// A quarter longer than it takes until something touches, as the probe has it.
  double past_contact() const { return of_steps(std::ceil(1.25 * probe_.touched_s / file_.step_s)); }

  /// Longer than what is told, shorter than what is not, past the first contact if that is between; what is
  /// not told if nothing is.
  double next_duration() const {
    constexpr double worthwhile = 1.05;
    if (untold_.duration == 0)
      return told_.duration == 0 ? first_duration() : std::min(2 * told_.duration, whole());
    const double middle = std::max(of_steps((told_.duration + untold_.duration) / file_.step_s / 2), least());
    const double next = middle >= worthwhile * told_.duration ? middle : untold_.duration;
    return next < past_contact() && past_contact() < untold_.duration ? past_contact() : next;
  }

  /// Tells the ends of longer pilots for `seconds` at most, twice that until there is any, but begins one at
  /// least. False if there is none.
  /// The first one past contact and the shortest one that is not told get all that is left.
  bool grows(double seconds) {
    const Stopwatch watch;
    const double before = told_.duration;
    const auto time = [&] { return (told_.duration > 0 ? 1 : 2) * seconds - watch.seconds(); };
    const auto is_first = [&] { return told_.duration + untold_.duration == 0; };
    while (told_.duration < whole() * (1 - 1e-9) && (time() > 0 || is_first())) {
      const double duration = next_duration();
      const bool last = duration == untold_.duration;
      Pilot pilot = last ? untold_ : Pilot{.duration = duration};
      sharpen(pilot, time(), last || duration == past_contact());
      const bool sharp = pilot.truth.least_met() <= error_;
      if (sharp && last) untold_ = {};
      (sharp ? told_ : untold_) = std::move(pilot);
      if (last && !sharp) break;
    }
    return told_.duration > before;
  }

  /// Ever finer, of steps that are solved to a thousandth of the error asked, until a third of that can be
  /// told or no finer one fits in `seconds`; unless `patient`, nor what a run can be told to meet, the bar
  /// being of first order.
  void sharpen(Pilot& pilot, double seconds, bool patient) const {
    constexpr double least_finer = 1.25;
    const Stopwatch watch;
    auto steps = std::max<std::int64_t>(pilot.truth_steps, std::lround(pilot.duration / file_.step_s));
    for (double finer = 2; finer >= least_finer;) {
      steps = 2 * static_cast<std::int64_t>(static_cast<double>(steps) * finer / 2);
      const Truth truth = pilot_truth(file_, pilot.duration, error_, steps, seconds - watch.seconds());
      if (std::isnan(pilot.truth.error_bar) || !std::isnan(truth.error_bar)) {
        pilot.truth = truth;
        pilot.truth_steps = std::isnan(truth.error_bar) ? 0 : steps;
      }
      if (truth.tells(error_ / 3)) return;
      const double levels = (seconds - watch.seconds()) / truth.wall_s;
      if (!patient && levels < truth.least_met() / error_) return;
      finer = std::min(2.0, levels);
    }
  }

  const SceneFile& file_;
  double error_, seconds_;
  Stopwatch watch_;
  Trajectory probe_;
  Pilot told_;    // the longest
  Pilot untold_;  // the shortest
};

}  // namespace

Truth pilot_truth(const SceneFile& file, double duration, double error, std::int64_t steps, double wall_s) {
  const Setting finest{usual_method(file, "", std::max(1e-10, 1e-3 * error)), steps};
  return agreed_truth(file, duration, finest, {"implicit_euler", "generalised_alpha", "newmark"}, wall_s);
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

Pilot pilot(const SceneFile& file, double error, double seconds) {
  return Growth(file, error, seconds).run();
}

}  // namespace pbdcheck
