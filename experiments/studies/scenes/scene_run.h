// Scene files as a whole: what they cost, and what stays true of them while bodies fall, strike and come to
// rest.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "harness/experiment.h"
#include "harness/measure.h"
#include "harness/step_checks.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

/// One scene file and how long it is simulated.
struct ScenePlan {
  std::string_view name;
  SceneFile file;
  double h, duration;   // s
  bool pictured;        // its frames are written, for plots/render.py
  bool driven = false;  // something does work on it
};

/// The file of experiments/scenes by this name, at its own step and duration, with pictures.
ScenePlan plan_of(std::string_view name);

/// Adds the same by steps of one part in so many, without pictures.
void add_shorter(std::vector<ScenePlan>& plans, int parts);

/// A quantity and the scene that it is of.
std::string owned(std::string_view quantity, const Worst& worst);

/// The columns of the table `series`: the steps of runs.
std::vector<std::string> series_columns();

/// The table `scenes` of an experiment, and the verdicts on all its rows.
class SceneStudy {
 public:
  /// Begins the experiment, which is to run `plans`.
  SceneStudy(Context& context, const std::vector<ScenePlan>& plans);

  /// Simulates a scene and adds its row; its steps go to `series` unless that is null, its frames to a folder
  /// of its name.
  void run(const ScenePlan& plan, Table* series);

  /// Ends the table; `experiment` begins the verdicts' ids, `scenes` is what their statements call the
  /// scenes.
  void conclude(std::string_view experiment, std::string_view scenes);

  /// Of what is not driven the largest energy above the start's over m g L, L the longest edge of the box
  /// about the scene; kinetic energy at the end over m g and a body's least size. Each of the scene with
  /// most.
  const Worst& excess() const { return excess_; }
  const Worst& rest() const { return rest_; }

 private:
  Context& context_;
  Table table_;
  Worst refuted_, diverged_, missed_, overlap_, overlap_at_end_, bilateral_, excess_, rest_;
};

}  // namespace pbdcheck
