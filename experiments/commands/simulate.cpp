#include <fmt/format.h>

#include <cmath>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/commands.h"
#include "commands/simulation_output.h"
#include "contact_newton.h"
#include "error.h"
#include "harness/constraint_name.h"
#include "harness/files.h"
#include "harness/interrupt.h"
#include "harness/judges.h"
#include "harness/progress.h"
#include "harness/provenance.h"
#include "harness/step_checks.h"
#include "harness/step_judge.h"
#include "harness/stepper.h"
#include "scenes/contacts.h"

namespace pbdcheck {
namespace {

/// What a run's steps reached, summed up.
struct Totals {
  std::int64_t steps = 0;
  std::array<std::int64_t, pbd::status_names.size()> by_status{};
  std::int64_t outer_iterations = 0;
  std::int64_t sweeps = 0;
  std::int64_t row_updates = 0;
  double worst_residual = 0;  // of steps that are not ok
  std::int64_t worst_step = 0;
  std::string worst_constraint;     // empty where none is told
  std::int64_t steps_in_parts = 0;  // that diverged as a whole
  int most_parts = 1;

  /// `name` tells a constraint.
  template <class Name>
  void add(const pbd::Report& report, int parts, const Name& name) {
    ++steps;
    steps_in_parts += parts > 1;
    most_parts = std::max(most_parts, parts);
    ++by_status[static_cast<std::size_t>(report.status)];
    outer_iterations += report.outer_iterations;
    sweeps += report.sweeps;
    row_updates += report.row_updates;
    if (report.status == pbd::Status::ok) return;
    if (!std::isnan(worst_residual) && !(report.residual() <= worst_residual)) {
      worst_residual = report.residual();
      worst_step = steps;
      worst_constraint = report.worst ? name(*report.worst) : "";
    }
  }
  std::int64_t missed() const { return steps - by_status[0]; }
};

/// The worst of the steps that are not ok. Its residual is NaN if it diverged, infinite where nothing moves:
/// there is no scale.
std::string worst_text(const Totals& totals) {
  if (std::isnan(totals.worst_residual))
    return fmt::format("step {} without a finite residual", totals.worst_step);
  const auto most = totals.worst_constraint.empty() ? "" : ", most of it of " + totals.worst_constraint;
  if (std::isinf(totals.worst_residual))
    return fmt::format("the worst where nothing moves (step {}{})", totals.worst_step, most);
  return fmt::format("the worst with {:.3g} (step {}{})", totals.worst_residual, totals.worst_step, most);
}

nlohmann::ordered_json report_json(const Totals& totals, const pbd::Workspace& workspace) {
  auto steps = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < totals.by_status.size(); ++i)
    steps[std::string(pbd::status_names[i])] = totals.by_status[i];
  auto effects = nlohmann::ordered_json::array();
  for (const auto& cost : workspace.costs())
    effects.push_back(
        {{"effect", cost.effect}, {"rows", cost.rows}, {"bytes", cost.bytes}, {"seconds", cost.seconds}});
  return {{"steps", totals.steps},
          {"steps_by_status", steps},
          {"worst_residual", totals.worst_residual},
          {"worst_step", totals.worst_step},
          {"worst_constraint", totals.worst_constraint},
          {"steps_in_parts", totals.steps_in_parts},
          {"most_parts", totals.most_parts},
          {"outer_iterations", totals.outer_iterations},
          {"sweeps", totals.sweeps},
          {"row_updates", totals.row_updates},
          {"effects", effects}};
}

nlohmann::ordered_json settings_json(const SimulateOptions& options, const SceneFile& file) {
  return {{"scene", options.scene.string()}, {"set", options.settings},
          {"step_s", file.step_s},           {"steps", file.steps},
          {"nodes", file.scene.nodes()},     {"method", method_text(file.method)},
          {"export", options.export_format}};
}

nlohmann::ordered_json checks_json(const StepChecks& checks) {
  return {{"steps", checks.judged()},
          {"refuted", checks.refuted_steps()},
          {"missed", checks.missed()},
          {"compared", checks.compared()},
          {"left_out", checks.left_out()}};
}

void write_checks(const std::filesystem::path& path, const StepChecks& checks, TableTotals& totals) {
  Table table(path, {"step", "check", "what", "number", "bound"}, &totals);
  for (const auto& [step, finding] : checks.refuted())
    table.row({step, finding.check, finding.what, finding.number, finding.bound});
  table.close();
}

nlohmann::ordered_json judged_json(const StepJudge& judge) {
  return {{"reference", judge.reference()},
          {"every", judge.every()},
          {"steps", judge.judged()},
          {"unsolved", judge.unsolved()},
          {"missed", judge.missed()},
          {"from_claim_alone", judge.from_claim_alone()},
          {"another_solution", judge.ambiguous()},
          {"features_of_the_begin", judge.by_features()},
          {"worst_error_m", judge.worst_error_m()},
          {"worst_error_of_scale", judge.worst_error_of_scale()}};
}

/// N of "every=N".
std::int64_t every_of(const std::string& text) {
  constexpr std::string_view key = "every=";
  std::int64_t every = 0;
  const char* const last = text.data() + text.size();
  const bool known = text.starts_with(key);
  const auto read = std::from_chars(text.data() + (known ? key.size() : 0), last, every);
  if (!known || read.ec != std::errc{} || read.ptr != last || every < 1)
    throw pbd::SetupError("--judge", "`" + text + "`", "every=N with N = 1, 2, ...");
  return every;
}

/// The judge of its steps: those of other integrators than implicit Euler are stated by the judges of contact
/// alone.
std::string reference_of(const SceneFile& file) {
  if (file.method.integrator == "implicit_euler") return default_reference(file.scene);
  return std::string(pbd::reference::contact_judges()[0].name);
}

/// Refuses what the judge does not solve before anything is computed.
void require_judgeable(const SceneFile& file, std::int64_t every) {
  const std::string& integrator = file.method.integrator;
  const bool euler = integrator == "implicit_euler";
  if (!euler && integrator != "bdf2" && integrator != "generalised_alpha")
    throw pbd::SetupError("--judge", "`" + file.method.integrator + "`",
                          "method.integrator implicit_euler, bdf2, generalised_alpha");
  if (!euler && std::any_of(file.scene.effects.begin(), file.scene.effects.end(),
                            [](const pbd::Effect& effect) { return pbd::damped(effect); }))
    throw pbd::SetupError("--judge", "damping with `" + integrator + "`",
                          "damping with method.integrator implicit_euler");
  if (integrator == "generalised_alpha" && contact_of(file.scene) == nullptr)
    throw pbd::SetupError("--judge", "`generalised_alpha` without contact",
                          "a scene with contact, where its first step is implicit Euler's");
  if (file.method.direction_blend != 1)
    throw pbd::SetupError("--judge", fmt::format("method.direction_blend {}", file.method.direction_blend),
                          "1");
  if (every > file.steps)
    throw pbd::SetupError("--judge", fmt::format("every={}", every),
                          fmt::format("1 to {} steps", file.steps));
  if (knows_contact(reference_of(file)))
    pbd::reference::require_judged(file.scene, file.scene.initial, file.step_s,
                                   pbd::friction_by_name(file.method.friction));
}

/// Of each step, if it is asked for.
struct Judges {
  std::optional<StepChecks> checks;
  std::optional<StepJudge> judge;
};

/// Steps until the end or Ctrl-C; returns why it ended before, if the state is lost.
std::string advance(SceneFile& file, pbd::Workspace& workspace, SimulationOutput& output, Totals& totals,
                    Judges& judges) {
  pbd::State state = file.scene.initial;
  Stepper stepper(file, workspace);
  stepper.begin(file.step_s, state);  // for the probes at the start
  ProgressBar progress("simulate", file.steps);
  std::string lost = output.add(0, state, nullptr);
  const auto judge = [&](const pbd::State& begun, const pbd::State& ended, double h,
                         const pbd::Report& report) {
    const std::int64_t step = totals.steps + 1;
    const auto claim = claim_of(file.scene, workspace, begun, ended, h, report);
    if (judges.checks) judges.checks->add(step, claim, report.status, file.script.changes_scene());
    if (judges.judge && judges.judge->due(step)) judges.judge->add(step, claim, report);
    if (judges.judge) judges.judge->follow(claim);
  };
  const bool judged = judges.checks || judges.judge;
  while (totals.steps < file.steps && lost.empty()) {
    const pbd::Report report = judged ? stepper.advance(state, judge) : stepper.advance(state);
    totals.add(report, stepper.parts(), [&](const pbd::ConstraintIndex& worst) {
      return constraint_name(file, worst,
                             stepper.parts() == 1 ? workspace.contacts() : std::vector<pbd::ContactForce>{});
    });
    if (report.status == pbd::Status::diverged)
      return fmt::format("step {} diverged, in parts, too: {}", totals.steps, report.reason);
    if (stepper.parts() > 1 && totals.steps_in_parts == 1)
      warn(fmt::format("step {} diverged and was made in {} parts; later ones are counted", totals.steps,
                       stepper.parts()));
    if (report.status != pbd::Status::ok && totals.missed() == 1)
      warn(fmt::format("step {} {}: {} (residual {:.3g}, tolerance {:.3g}); later ones are counted",
                       totals.steps, pbd::status_names[static_cast<std::size_t>(report.status)],
                       report.reason, report.residual(), file.method.tolerance));
    lost = output.add(totals.steps, state, &workspace);
    progress.advance(fmt::format("t = {:.4g} s", state.time));
  }
  return lost.empty() ? "" : fmt::format("step {} diverged: {} is not finite", totals.steps, lost);
}

}  // namespace

int simulate(const SimulateOptions& options) {
  const std::int64_t every = options.judge ? every_of(*options.judge) : 0;
  SceneFile file = read_scene_file(options.scene, options.settings);
  if (every > 0) require_judgeable(file, every);
  pbd::Workspace workspace = file.workspace();
  SimulationOutput output(options, file);
  PartialFile record(options.directory / "run.json");

  const auto start = std::chrono::steady_clock::now();
  Totals totals;
  Judges judges;
  auto& [checks, judge] = judges;
  if (options.check) checks.emplace();
  if (every > 0) judge.emplace(options.directory, reference_of(file), every, file.method.rho);
  RunOutcome outcome = RunOutcome::complete;
  std::string reason;
  try {
    reason = advance(file, workspace, output, totals, judges);
    if (!reason.empty()) outcome = RunOutcome::failed;
  } catch (const Interrupted&) {
    outcome = RunOutcome::interrupted;
    reason = "stopped by the user";
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  output.close();
  TableTotals tables = output.totals();
  if (checks) {
    write_checks(options.directory / "checks.csv", *checks, tables);
    if (outcome == RunOutcome::complete && checks->refuted_steps() > 0) {
      outcome = RunOutcome::refuted;
      reason = checks->text();
    }
  }

  if (judge) {
    judge->close();
    tables.rows.insert(judge->totals().rows.begin(), judge->totals().rows.end());
  }

  auto json = run_record(1, outcome, reason);
  json["settings"] = settings_json(options, file);
  json["wall_s"] = wall.count();
  json["rows"] = tables.rows;
  json["report"] = report_json(totals, workspace);
  if (checks) json["checks"] = checks_json(*checks);
  if (judge) json["judged"] = judged_json(*judge);
  record.write(json_text(json));
  record.complete();

  if (totals.missed() > 0)
    warn(fmt::format("{} of {} steps missed the tolerance {:.3g}, {}", totals.missed(), totals.steps,
                     file.method.tolerance, worst_text(totals)));
  if (totals.steps_in_parts > 0)
    warn(fmt::format("{} of {} steps diverged and were made in up to {} parts", totals.steps_in_parts,
                     totals.steps, totals.most_parts));
  if (checks) fmt::print("{}\n", checks->text());
  if (judge) fmt::print("{}\n", judge->text());
  if (outcome == RunOutcome::failed) error_message(reason);
  if (outcome == RunOutcome::interrupted) return exit_interrupted;
  return outcome != RunOutcome::complete || totals.missed() > 0 ? exit_failed : exit_done;
}

}  // namespace pbdcheck
