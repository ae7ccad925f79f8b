// Steps of a scene file, and the way on where one diverges: it is made again in 2, 4, ... 64 equal parts, the
// first number of which none diverges, and what overlaps parts slowly (solver/effects/contact.h).
#pragma once

#include <functional>
#include <utility>

#include "scenes/scene_file.h"
#include "step/step.h"

namespace pbdcheck {

class Stepper {
 public:
  /// Both are to stay where they are.
  Stepper(SceneFile& file, pbd::Workspace& workspace);

  /// The scene as its script has it where a step begins from `state`, whose moving bodies get their
  /// velocities.
  void begin(double h, pbd::State& state);

  /// Sees each step of h seconds that is made, parts and those that are made again among them.
  using Judge = std::function<void(const pbd::State& begun, const pbd::State& ended, double h,
                                   const pbd::Report& report)>;

  /// One step of the file. The report sums up the parts, with status and residual of the worst one; if all
  /// ways diverge it is the whole step's, and `state` is as it was.
  pbd::Report advance(pbd::State& state, const Judge& judge = {});

  /// One step of the file as it is, in one part.
  pbd::Report whole(pbd::State& state, const Judge& judge = {});

  /// Called at each outer iteration. What it throws ends the step; the workspace is of no use after that.
  void watch(std::function<void()> watcher) { watcher_ = std::move(watcher); }

  /// Of the last step.
  int parts() const { return parts_; }

  /// s, how long each of them was.
  double part_s() const { return file_.step_s / parts_; }

 private:
  bool advance_in(int parts, const Judge& judge, pbd::State& state, pbd::Report& sum);

  SceneFile& file_;
  pbd::Workspace& workspace_;
  pbd::Scene stated_;
  std::function<void()> watcher_;
  int parts_ = 1;
};

}  // namespace pbdcheck
