#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/commands.h"
#include "commands/simulation_judges.h"
#include "commands/simulation_output.h"
#include "commands/simulation_totals.h"
#include "harness/constraint_name.h"
#include "harness/files.h"
#include "harness/interrupt.h"
#include "harness/progress.h"
#include "harness/provenance.h"
#include "harness/step_checks.h"
#include "harness/step_judge.h"
#include "harness/stepper.h"

namespace pbdcheck {
namespace {

nlohmann::ordered_json settings_json(const SimulateOptions& options, const SceneFile& file) {
  return {{"scene", options.scene.string()}, {"set", options.settings},
          {"step_s", file.step_s},           {"steps", file.steps},
          {"nodes", file.scene.nodes()},     {"method", method_text(file.method)},
          {"export", options.export_format}};
}

/// Of each step, if it is asked for.
struct Judges {
  std::optional<StepChecks> checks;
  std::optional<StepJudge> judge;
};

/// Steps until the end or Ctrl-C; returns why it ended before, if the state is lost.
std::string advance(SceneFile& file, pbd::Workspace& workspace, SimulationOutput& output,
                    SimulationTotals& totals, Judges& judges) {
  pbd::State state = file.scene.initial;
  Stepper stepper(file, workspace);
  stepper.begin(file.step_s, state);  // for the probes at the start
  ProgressBar progress("simulate", file.steps);
  std::string lost = output.add(0, state, nullptr, file.step_s);
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
    lost = output.add(totals.steps, state, &workspace, stepper.part_s());
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
  SimulationTotals totals;
  Judges judges;
  auto& [checks, judge] = judges;
  if (options.check) checks.emplace();
  if (every > 0)
    judge.emplace(options.directory, default_reference(file.scene, file.method.integrator), every,
                  file.method);
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

  auto json = run_record(file.method.threads, outcome, reason);
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
                     file.method.tolerance, totals.worst_missed.text()));
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
