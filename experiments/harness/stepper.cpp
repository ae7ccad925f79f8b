#include "harness/stepper.h"

#include "harness/interrupt.h"

namespace pbdcheck {
namespace {

/// Adds a part's work, and takes its outcome where that is worse.
void add(const pbd::Report& part, pbd::Report& sum) {
  pbd::Report worse = part.status > sum.status || !(part.residual() <= sum.residual()) ? part : sum;
  worse.outer_iterations = sum.outer_iterations + part.outer_iterations;
  worse.sweeps = sum.sweeps + part.sweeps;
  worse.row_updates = sum.row_updates + part.row_updates;
  if (worse.status < sum.status) worse.status = sum.status, worse.reason = sum.reason;
  sum = worse;
}

}  // namespace

Stepper::Stepper(SceneFile& file, pbd::Workspace& workspace)
    : file_(file), workspace_(workspace), stated_(file.scene) {}

void Stepper::begin(double h, pbd::State& state) {
  file_.script.begin_step(stated_, h, file_.scene, state);
}

/// True if no part diverges.
bool Stepper::advance_in(int parts, const Judge& judge, pbd::State& state, pbd::Report& sum) {
  for (int part = 0; part < parts && sum.status != pbd::Status::diverged; ++part) {
    throw_if_interrupted();
    const double h = part_s();
    begin(h, state);
    file_.script.hand_on(file_.scene, h, state.time, workspace_);
    const pbd::State begun = judge ? state : pbd::State{};
    const pbd::Report report = pbd::step(workspace_, h, state, [this](const pbd::Iterate&) {
      throw_if_interrupted();
      if (watcher_) watcher_();
    });
    add(report, sum);
    if (judge && report.status != pbd::Status::diverged) judge(begun, state, h, report);
  }
  return sum.status != pbd::Status::diverged;
}

pbd::Report Stepper::whole(pbd::State& state, const Judge& judge) {
  pbd::Report report;
  parts_ = 1;
  advance_in(parts_, judge, state, report);
  return report;
}

pbd::Report Stepper::advance(pbd::State& state, const Judge& judge) {
  constexpr int most_parts = 64;  // six halvings
  pbd::Report whole;
  for (parts_ = 1; parts_ <= most_parts; parts_ *= 2) {
    pbd::State reached = state;
    pbd::Report sum;
    if (advance_in(parts_, judge, reached, sum)) {
      state = std::move(reached);
      return sum;
    }
    if (parts_ == 1) whole = sum;
  }
  parts_ = 1;
  return whole;
}

}  // namespace pbdcheck
