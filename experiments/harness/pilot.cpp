#include "harness/pilot.h"

#include <algorithm>
#include <cmath>

#include "harness/pilot_search.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double share_of_probe = 0.02;  // of the budget: the scene as it stands; 16 times finer is a third
constexpr double least_steps = 8;        // of the scene's own, of a pilot: to be halved three times

/// The scene as it stands for `wall_s` seconds at most.
Trajectory probed(const SceneFile& file, double wall_s) {
  const Setting setting{usual_method(file, file.method.integrator, file.method.tolerance), file.steps, true};
  return trajectory(file, static_cast<double>(file.steps) * file.step_s, setting, {.wall_s = wall_s});
}

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
      Pilot longer = searched(file_, told_, error_, left(), best);
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
    if (!std::isnan(pilot.truth.error_bar)) return searched(file_, pilot, error_, left(), {});
    if (!pilot.truth.in_time) pilot.needed_s = least_need();
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

  /// Tells the ends of longer pilots. False if there is none. It takes `seconds` at most, but begins one.
  /// Until any is told it takes twice that, half of what is left for each. Then the first one past contact
  /// and the shortest one that is not told get all that is left.
  bool grows(double seconds) {
    const Stopwatch watch;
    const double before = told_.duration;
    const auto time = [&] { return (told_.duration > 0 ? 1 : 2) * seconds - watch.seconds(); };
    const auto is_first = [&] { return told_.duration + untold_.duration == 0; };
    while (told_.duration < whole() * (1 - 1e-9) && (time() > 0 || is_first())) {
      const double duration = next_duration();
      const bool last = duration == untold_.duration;
      if (last && std::isnan(untold_.truth.error_bar) && untold_.truth.in_time) break;
      Pilot pilot = last ? untold_ : Pilot{.duration = duration};
      const bool any = told_.duration > 0;
      sharpen(pilot, any || last ? time() : time() / 2, last || (any && duration == past_contact()));
      const bool sharp = pilot.truth.least_met() <= error_;
      if (sharp && last) untold_ = {};
      (sharp ? told_ : untold_) = std::move(pilot);
      if (last && !sharp) break;
    }
    return told_.duration > before;
  }

  /// Ever finer, of steps that are solved to a thousandth of the error asked, until a third of that can be
  /// told or no finer one fits in `seconds`; unless `patient`, nor what a run can be told to meet, the bar
  /// being of first order. What fails in its time by ever finer steps fails for another reason than these.
  void sharpen(Pilot& pilot, double seconds, bool patient) const {
    constexpr double least_finer = 1.25;
    constexpr int most_failed = 5;
    int failed = 0;
    const Stopwatch watch;
    auto steps = std::max<std::int64_t>(pilot.truth_steps, std::lround(pilot.duration / file_.step_s));
    for (double finer = 2; finer >= least_finer;) {
      steps = 2 * static_cast<std::int64_t>(static_cast<double>(steps) * finer / 2);
      const Truth truth =
          pilot_truth(file_, pilot.duration, error_, steps, std::max(0.0, seconds - watch.seconds()));
      if (std::isnan(pilot.truth.error_bar) || !std::isnan(truth.error_bar)) {
        pilot.truth = truth;
        pilot.truth_steps = std::isnan(truth.error_bar) ? 0 : steps;
      }
      if (truth.tells(error_ / 3)) return;
      if (std::isnan(truth.error_bar) && truth.in_time && ++failed == most_failed) return;
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

Pilot pilot(const SceneFile& file, double error, double seconds) {
  return Growth(file, error, seconds).run();
}

}  // namespace pbdcheck
