#include "studies/contact/contact_answers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/step_checks.h"

namespace pbdcheck {

using namespace pbd;

ContactRun simulate_contacts(const Scene& scene, const Method& method, double h, std::int64_t steps,
                             const AfterContactStep& after_step) {
  ContactRun run;
  run.end = scene.initial;
  Workspace workspace(scene, method);
  StepChecks checks;
  while (run.steps < steps) {
    throw_if_interrupted();
    const State before = run.end;
    const Report report = step(workspace, h, run.end);
    run.sweeps += report.sweeps;
    run.steps_ok += report.status == Status::ok;
    if (report.status > run.status) run.status = report.status, run.reason = report.reason;
    if (report.status == Status::diverged) break;
    ++run.steps;
    checks.add(run.steps, claim_of(scene, workspace, before, run.end, h, report), report.status, false);
    if (checks.refuted_steps() > 0) {
      run.status = Status::diverged;
      run.reason = checks.text();
      break;
    }
    if (after_step) after_step(run.end, workspace);
  }
  return run;
}

Method contact_method(std::string_view relaxation, std::string_view friction) {
  Method method;
  method.relaxation = relaxation;
  method.friction = friction;
  method.tolerance = 1e-12;
  return method;
}

Method patient_method(std::string_view relaxation, std::string_view friction) {
  Method method = contact_method(relaxation, friction);
  method.max_outer = 10000;
  return method;
}

double relative_difference(double a, double b) {
  return std::abs(a - b) / std::abs(b);
}

Slide slide(double v, double deceleration, double h, std::int64_t steps, double least) {
  Slide moved{v};
  for (std::int64_t k = 0; k < steps; ++k) {
    moved.v = std::max(least, moved.v - h * deceleration);
    moved.x += h * moved.v;
  }
  return moved;
}

KnownAnswers::KnownAnswers(Context& context, std::string experiment, std::vector<Quantity> quantities)
    : context_(context),
      experiment_(std::move(experiment)),
      quantities_(std::move(quantities)),
      table_(context.table("answers", {"quantity", "scene", "integrator", "outer", "relaxation", "friction",
                                       "step_s", "measured", "expected", "unit", "error", "bound", "sweeps",
                                       "steps", "missed_steps", "status", "reason"})) {}

void KnownAnswers::add(std::string_view quantity, std::string_view scene, const Method& method, double h,
                       double measured, double expected, double error, const ContactRun& run, bool judged) {
  const auto asked = std::find_if(quantities_.begin(), quantities_.end(),
                                  [&](const Quantity& each) { return each.name == quantity; });
  if (asked == quantities_.end()) throw std::logic_error("no quantity " + std::string(quantity));
  if (run.status == Status::diverged) measured = error = std::nan("");
  table_.row({asked->name, std::string(scene), method.integrator, method.outer, method.relaxation,
              method.friction, h, measured, expected, asked->unit, error,
              judged ? asked->bound : std::nan(""), run.sweeps, std::int64_t{run.steps},
              std::int64_t{run.steps - run.steps_ok}, status_cell(run.status), run.reason});
  if (!judged) return;
  worst_[asked->name].add(error, method.relaxation);
}

void KnownAnswers::close() {
  table_.close();
  for (const Quantity& quantity : quantities_) {
    const auto worst = worst_.find(quantity.name);
    if (worst == worst_.end()) throw std::logic_error("nothing measured of " + quantity.name);
    context_.verdict(quantity.basis, experiment_ + "." + quantity.name, quantity.statement,
                     fmt::format("largest error, {} ({})", quantity.unit, worst->second.owner()),
                     worst->second.value(), quantity.bound);
  }
}

}  // namespace pbdcheck
