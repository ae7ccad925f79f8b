// What a scene file says of time: factors of forces, torques, motors' rates and the velocities of moving
// bodies. A step takes their means over it, so that momentum, angles and places are those of the integral at
// the end of every step, whatever the integrator. Poses of moving bodies are met where steps end, too.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "scenes/pose_course.h"
#include "step/step.h"

namespace pbdcheck {

/// A factor over time: straight lines between (time in s, value), constant before the first and after the
/// last.
struct Course {
  std::vector<double> time, value;

  /// From time 0 on, s.
  double integral(double end) const;
  double mean(double begin, double end) const { return (integral(end) - integral(begin)) / (end - begin); }

  /// True if the means of the step from `begin` to `end` and the one before jump: in one of them the value
  /// changes by more than a tenth of its range between times that are nearer to each other than a step is
  /// long.
  bool jumps(double begin, double end) const;
};

/// What joints begin apart by (m), and the time (s) in which they close: from rest to rest, at half of it by
/// half.
template <class Offset>
struct Closing {
  Offset offset;
  double duration;

  Offset left(double time) const {
    const double share = std::min(time / duration, 1.0);
    return (1 - share * share * (3 - 2 * share)) * offset;
  }
};

class Script {
 public:
  /// Of entry `index` of the scene's forces, torques, angles or slides, and of a moving body.
  void force(std::size_t index, Course course) { forces_.push_back({index, std::move(course)}); }
  void torque(std::size_t index, Course course) { torques_.push_back({index, std::move(course)}); }
  void angle(std::size_t index, Course course) { angles_.push_back({index, std::move(course)}); }
  void slide(std::size_t index, Course course) { slides_.push_back({index, std::move(course)}); }
  void body(std::size_t index, Course course) { bodies_.push_back({index, std::move(course)}); }

  void poses(std::size_t index, PoseCourse course) { poses_.push_back({index, std::move(course)}); }

  /// Of point and line joints the first body's points begin off by an offset in its frame, of distances the
  /// rest lengths.
  void point(std::size_t index, const Closing<pbd::Vec3>& by) { points_.push_back({index, by}); }
  void line(std::size_t index, const Closing<pbd::Vec3>& by) { lines_.push_back({index, by}); }
  void length(std::size_t index, const Closing<double>& by) { lengths_.push_back({index, by}); }

  /// `scene` as `stated` but for the step of h seconds from `state`, whose moving bodies get their
  /// velocities.
  void begin_step(const pbd::Scene& stated, double h, pbd::Scene& scene, pbd::State& state) const;

  /// True if steps have scenes of their own, not states alone.
  bool changes_scene() const {
    return !(forces_.empty() && torques_.empty() && angles_.empty() && slides_.empty() && points_.empty() &&
             lines_.empty() && lengths_.empty());
  }

  /// True if nothing changes with time.
  bool empty() const { return !changes_scene() && bodies_.empty() && poses_.empty(); }

  /// Hands what `begin_step` has set in `scene` on to a workspace of that scene. The step is to be a start
  /// where the rate of a motor jumps.
  void hand_on(const pbd::Scene& scene, double h, double time, pbd::Workspace& workspace) const;

 private:
  template <class C>
  struct Entry {
    std::size_t index;
    C course;
  };
  std::vector<Entry<Course>> forces_, torques_, angles_, slides_, bodies_;
  std::vector<Entry<PoseCourse>> poses_;
  std::vector<Entry<Closing<pbd::Vec3>>> points_, lines_;
  std::vector<Entry<Closing<double>>> lengths_;
};

}  // namespace pbdcheck
