#include "commands/way.h"

#include <fmt/format.h>

#include <stdexcept>

#include "harness/step_checks.h"
#include "harness/stepper.h"

namespace pbdcheck {

Way::Way(SceneFile& own, const std::string& integrator)
    : file(own),
      workspace(own.workspace()),
      state(own.scene.initial),
      memory(integrator == "implicit_euler" ? pbd::Method{} : own.method) {}

void Way::go(int steps) {
  Stepper stepper(file, workspace);
  const auto follow = [&](const pbd::State& begun, const pbd::State& ended, double h,
                          const pbd::Report& report) {
    memory.follow(claim_of(file.scene, workspace, begun, ended, h, report));
  };
  for (int i = 1; i <= steps; ++i) {
    const auto report = stepper.whole(state, follow);
    if (report.status == pbd::Status::diverged)
      throw std::runtime_error(
          fmt::format("step {} on the way to the compared one diverged: {}", i, report.reason));
    if (report.status != pbd::Status::ok) ++missed;
  }
  stepper.begin(file.step_s, state);
}

std::optional<pbd::reference::IntegratorMap> Way::map() const {
  if (!memory.smooth_map(file.scene, state, file.step_s)) return {};
  pbd::Workspace next(file.scene, file.method);
  next.go_on_from(workspace);
  pbd::State end = state;
  const auto report = pbd::step(next, file.step_s, end);
  return memory.map_of(claim_of(file.scene, next, state, end, file.step_s, report));
}

}  // namespace pbdcheck
