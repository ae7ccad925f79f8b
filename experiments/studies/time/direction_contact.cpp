// How far shapes overlap and ropes stretch by linearisations of one step, and by as many row updates of
// shorter steps of velocity time stepping. Each step begins without the last one's impulses: what a workspace
// remembers of missed steps would let their overlaps part slowly.
#include <cmath>

#include "scenes/contacts.h"
#include "studies/time/direction.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double radius = 0.1;  // m, of the balls

struct TouchingScene {
  std::string name;
  Scene scene;
};

/// A ball rolls down a fixed one of 0.3 m.
Scene rolling_off() {
  constexpr double below = 0.3, tilt = 0.1, speed = 0.3;
  BodyScene build({.friction = 0.8});
  build.fixed(Sphere{below}, {Vec3::Zero()});
  const Vec3 normal(std::sin(tilt), 0, std::cos(tilt)), downhill(std::cos(tilt), 0, -std::sin(tilt));
  build.ball(radius, 1,
             {(below + radius) * normal, Eigen::Quaterniond::Identity(), speed * downhill,
              speed / radius * normal.cross(downhill)});
  return build.finish();
}

/// A ball on a rope of 0.5 m swings along a wall that it leans on.
Scene swinging_along() {
  const Vec3 hook(-0.1, 0, 0.6), hangs(0.2, 0.3, -std::sqrt(0.25 - 0.04 - 0.09));
  BodyScene build({.friction = 0.05});
  build.fixed(HalfSpace{}, {Vec3::Zero(), Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX())});
  build.fixed({}, {hook});
  build.ball(radius, 1, {hook + hangs});
  Scene scene = build.finish();
  scene.effects.emplace_back(BodyDistance{{{1, 2}}, {{Vec3::Zero(), Vec3::Zero()}}, {hangs.norm()}, {0}});
  return scene;
}

/// Five cubes on each other, pushed over.
Scene toppling() {
  Scene scene = column(5);
  for (int body = 1; body < std::ssize(scene.bodies); ++body) scene.initial.v(0, body) = 0.4 * body;
  return scene;
}

double violation_of(const Scene& scene, const Workspace& workspace, const State& state) {
  double most = 0;
  for (const ContactForce& contact : workspace.contacts()) most = larger(most, -contact.gap / radius);
  for (const Effect& effect : scene.effects)
    if (const auto* ropes = std::get_if<BodyDistance>(&effect))
      for (std::size_t k = 0; k < ropes->body.size(); ++k) {
        const auto& [a, b] = ropes->body[k];
        const double length = (state.x.col(b) - state.x.col(a)).norm();  // points are centres
        most = larger(most, std::abs(length / ropes->rest_length[k] - 1));
      }
  return most;
}

DirectionRun violations(const Scene& scene, const Method& method, double h, double duration) {
  DirectionRun found;
  State state = scene.initial;
  const auto count = std::lround(duration / h);
  double squares = 0;
  std::int64_t row_updates = 0;
  while (found.steps < count && found.status != Status::diverged) {
    Workspace workspace(scene, method);
    const Report report = step(workspace, h, state);
    ++found.steps;
    row_updates += report.row_updates;
    found.missed += report.status != Status::ok;
    if (report.status == Status::diverged) found.status = report.status, found.reason = report.reason;
    const double violation = violation_of(scene, workspace, state);
    found.violation_largest = larger(found.violation_largest, violation);
    squares += violation * violation;
  }
  found.violation_rms = std::sqrt(squares / found.steps);
  found.work_per_s = static_cast<double>(row_updates) / (found.steps * h);
  return found;
}

}  // namespace

void direction_contact(Context& context) {
  const std::vector<TouchingScene> scenes{{"ball rolls off a ball", rolling_off()},
                                          {"ball on a rope along a wall", swinging_along()},
                                          {"five cubes topple", toppling()}};
  std::vector<Scheme> schemes = velocity_schemes();
  schemes.push_back({"position"});
  schemes.back().method.outer = "plain";
  const std::vector<int> counts = context.full() ? std::vector{1, 2, 4, 8, 16, 32} : std::vector{1, 2, 4, 8};
  const double duration = context.full() ? 10 : 1;  // s
  Table table = direction_table(context, "contact",
                                {"linearisations_per_frame", "step_s", "duration_s", "row_updates_per_s",
                                 "error", "violation_rms", "missed_steps", "steps", "status", "reason"});
  std::vector<DirectionRun> runs(scenes.size() * schemes.size() * counts.size());
  const auto at = [&](std::size_t k) {
    return std::tuple{k / (schemes.size() * counts.size()), k / counts.size() % schemes.size(),
                      k % counts.size()};
  };
  const auto step_of = [&](const Scheme& scheme, int count) {
    return scheme.family == "velocity" ? direction_frame / count : direction_frame;
  };
  context.parallel(std::ssize(runs), [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const auto [scene, scheme, count] = at(k);
    Method method = schemes[scheme].method;
    method.relaxation = "gauss_seidel";
    method.max_sweeps = 20;
    method.warm_start = false;
    if (schemes[scheme].family == "position") method.max_outer = counts[count];
    runs[k] = violations(scenes[scene].scene, method, step_of(schemes[scheme], counts[count]), duration);
  });
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto [scene, scheme, count] = at(k);
    const DirectionRun& run = runs[k];
    Scheme shown = schemes[scheme];
    shown.method.relaxation = "gauss_seidel";
    add_row(table, scenes[scene].name, shown,
            {std::int64_t{counts[count]}, step_of(shown, counts[count]), duration, run.work_per_s,
             run.violation_largest, run.violation_rms, std::int64_t{run.missed}, std::int64_t{run.steps}},
            run);
  }
  table.close();
}

}  // namespace pbdcheck
