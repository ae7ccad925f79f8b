#include "scenes/script.h"

#include <algorithm>
#include <variant>

namespace pbdcheck {
namespace {

/// The effect of this kind: a scene file makes one.
template <class E>
auto& only(auto& scene) {
  return std::get<E>(*std::find_if(scene.effects.begin(), scene.effects.end(), [](const pbd::Effect& effect) {
    return std::holds_alternative<E>(effect);
  }));
}

/// The straight line through the motor's places where the step begins and ends.
template <class E>
void set_motor(const pbd::Scene& stated, std::size_t i, const Course& course, double begin, double end,
               std::vector<double> E::*rest, pbd::Scene& scene) {
  const E& from = only<E>(stated);
  E& to = only<E>(scene);
  to.rate[i] = from.rate[i] * course.mean(begin, end);
  (to.*rest)[i] = (from.*rest)[i] + from.rate[i] * course.integral(begin) - to.rate[i] * begin;
}

}  // namespace

double Course::integral(double end) const {
  double sum = value.front() * std::min(end, time.front());
  for (std::size_t k = 1; k < time.size() && time[k - 1] < end; ++k) {
    const double until = std::min(end, time[k]), from = time[k - 1];
    const double slope = (value[k] - value[k - 1]) / (time[k] - from);
    sum += (until - from) * (value[k - 1] + slope * (until - from) / 2);
  }
  return sum + value.back() * std::max(end - time.back(), 0.0);
}

bool Course::jumps(double begin, double end) const {
  constexpr double much = 0.1;
  const double h = end - begin;
  const auto [low, high] = std::minmax_element(value.begin(), value.end());
  const double least = much * (*high - *low);
  for (std::size_t k = 1; k < time.size(); ++k)
    if (time[k] - time[k - 1] < h && std::abs(value[k] - value[k - 1]) > least && time[k - 1] < end &&
        time[k] > begin - h)
      return true;
  return false;
}

void Script::begin_step(const pbd::Scene& stated, double h, pbd::Scene& scene, pbd::State& state) const {
  const double begin = state.time, end = begin + h;
  for (const auto& [i, course] : forces_)
    only<pbd::ExternalForce>(scene).force[i] =
        course.mean(begin, end) * only<pbd::ExternalForce>(stated).force[i];
  for (const auto& [i, course] : torques_)
    only<pbd::ExternalTorque>(scene).torque[i] =
        course.mean(begin, end) * only<pbd::ExternalTorque>(stated).torque[i];
  for (const auto& [i, course] : angles_)
    set_motor(stated, i, course, begin, end, &pbd::AngleJoint::rest_angle, scene);
  for (const auto& [i, course] : slides_)
    set_motor(stated, i, course, begin, end, &pbd::SlideJoint::rest_position, scene);
  for (const auto& [i, course] : bodies_) {
    const double factor = course.mean(begin, end);
    const auto body = static_cast<Eigen::Index>(i);
    const int node = stated.bodies[i].node;
    state.v.col(node) = factor * stated.initial.v.col(node);
    state.spin.col(body) = factor * stated.initial.spin.col(body);
  }
  for (const auto& [i, closing] : points_)
    only<pbd::PointJoint>(scene).point[i][0] = only<pbd::PointJoint>(stated).point[i][0] + closing.left(end);
  for (const auto& [i, closing] : lines_)
    only<pbd::LineJoint>(scene).point[i][0] = only<pbd::LineJoint>(stated).point[i][0] + closing.left(end);
  for (const auto& [i, closing] : lengths_)
    only<pbd::BodyDistance>(scene).rest_length[i] =
        only<pbd::BodyDistance>(stated).rest_length[i] + closing.left(end);
  for (const auto& [i, course] : poses_) {
    const int node = stated.bodies[i].node;
    const auto [velocity, spin] = course.over(begin, end, {state.x.col(node), state.orientation[i]});
    state.v.col(node) = velocity;
    state.spin.col(static_cast<Eigen::Index>(i)) = spin;
  }
}

void Script::hand_on(const pbd::Scene& scene, double h, double time, pbd::Workspace& workspace) const {
  const auto follows = [&](const pbd::Effect& effect) {
    return (std::holds_alternative<pbd::ExternalForce>(effect) && !forces_.empty()) ||
           (std::holds_alternative<pbd::ExternalTorque>(effect) && !torques_.empty()) ||
           (std::holds_alternative<pbd::AngleJoint>(effect) && !angles_.empty()) ||
           (std::holds_alternative<pbd::SlideJoint>(effect) && !slides_.empty()) ||
           (std::holds_alternative<pbd::PointJoint>(effect) && !points_.empty()) ||
           (std::holds_alternative<pbd::LineJoint>(effect) && !lines_.empty()) ||
           (std::holds_alternative<pbd::BodyDistance>(effect) && !lengths_.empty());
  };
  for (std::size_t i = 0; i < scene.effects.size(); ++i)
    if (follows(scene.effects[i])) workspace.change(i, scene.effects[i]);
  const auto jumps = [&](const Entry<Course>& entry) { return entry.course.jumps(time, time + h); };
  if (std::any_of(angles_.begin(), angles_.end(), jumps) ||
      std::any_of(slides_.begin(), slides_.end(), jumps))
    workspace.begin_anew();
}

}  // namespace pbdcheck
