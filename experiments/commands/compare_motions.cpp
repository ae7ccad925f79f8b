#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/comparison.h"
#include "commands/contender.h"
#include "error.h"
#include "harness/contact_sums.h"
#include "harness/integrator_rules.h"
#include "harness/interrupt.h"
#include "harness/judges.h"
#include "harness/pilot.h"
#include "harness/progress.h"
#include "harness/trajectory.h"
#include "scenes/choices.h"

namespace pbdcheck {
namespace {

constexpr std::int64_t finer = 8;           // steps of the reference for each of the compared ones
constexpr long most_evaluated = 1'000'000;  // nodes times evaluations of an ODE that nobody asked for

/// compare.csv of motions, a row a method.
class MotionTable {
 public:
  MotionTable(const CompareOptions& options, const SceneFile& file)
      : scene_(options.scene.stem().string()),
        until_(*options.until),
        file_(file),
        table_(options.directory / "compare.csv",
               {"scene",       "duration_s",   "step_s",        "integrator",       "outer",
                "relaxation",  "friction",     "tolerance",     "outer_iterations", "sweeps",
                "row_updates", "missed_steps", "bytes",         "wall_s",           "error",
                "error_bar",   "energy_error", "penetration_m", "status",           "reason",
                "method",      "truth"},
               &totals_) {}

  /// The reference's own row: as its error it has its error bar. All rows tell the bar.
  void add_reference(const std::string& name, const Truth& truth, double wall_s) {
    truth_ = truth;
    Contender reference{name, {}};
    reference.method.integrator = "none";
    reference.method.tolerance = std::nan("");
    reference.method.outer = "reference";
    reference.method.relaxation = name;
    Trajectory found;
    found.wall_s = wall_s;
    const bool ok = truth.reason.empty();
    add(reference, found, truth.error_bar, ok ? 0 : std::nan(""), ok ? "ok" : "not_converged", truth.reason);
  }

  void skip(const Contender& contender, const std::string& reason) {
    Trajectory found;
    found.wall_s = std::nan("");
    add(contender, found, std::nan(""), std::nan(""), "skipped", reason);
  }

  void add(const Contender& contender, const Trajectory& found, double error, double energy_error,
           const std::string& status, const std::string& reason) {
    std::vector<Cell> cells{scene_, until_, until_ / static_cast<double>(contender.steps)};
    const auto append = [&](const std::vector<Cell>& more) {
      cells.insert(cells.end(), more.begin(), more.end());
    };
    append(method_cells(file_.scene, contender.method));
    append(work_cells(found));
    append({error, truth_.error_bar, energy_error, found.penetration_m, status, reason, contender.text,
            truth_.method});
    table_.row(cells);
  }

  void close() { table_.close(); }
  const TableTotals& totals() const { return totals_; }

 private:
  std::string scene_;
  double until_;
  const SceneFile& file_;
  Truth truth_;
  TableTotals totals_;
  Table table_;
};

/// The one asked for, else the ODE where the scene has one. Throws SetupError.
std::string motion_reference(const CompareOptions& options, const SceneFile& file) {
  const auto& names = motion_reference_names();
  if (options.reference == names.back()) return options.reference;
  if (!options.reference.empty() && options.reference != names.front())
    throw pbd::SetupError("--reference", "`" + options.reference + "` with --until",
                          joined(names) + ": the others solve single steps");
  try {
    require_ode(file);
    return names.front();
  } catch (const pbd::SetupError& error) {
    if (options.reference.empty()) return names.back();
    throw pbd::SetupError("--reference ode: " + std::string(error.what()));
  }
}

/// Where nobody asked for the ODE and that takes too long, as stiff ones do, `reference` becomes finer steps.
Truth truth_of(std::string& reference, const CompareOptions& options, const SceneFile& file,
               const std::vector<Contender>& contenders) {
  const auto& names = motion_reference_names();
  if (reference == names.front()) {
    const bool asked = !options.reference.empty();
    pbd::reference::OdeSettings settings;
    if (!asked) settings.max_evaluations = most_evaluated / file.scene.nodes();
    Truth truth = ode_truth(file, *options.until, settings);
    if (asked || truth.reason.empty()) return truth;
    note(fmt::format("{}: the reference is {}", truth.reason, names.back()));
    reference = names.back();
  }
  std::int64_t most = 1;
  double tightest = 1;
  for (const auto& contender : contenders) {
    most = std::max(most, contender.steps);
    tightest = std::min(tightest, contender.method.tolerance);
  }
  return pilot_truth(file, *options.until, tightest, finer * most);
}

/// One method's motion and its row; returns whether all is well.
bool measure_motion(const Contender& contender, const SceneFile& file, double until, const Truth& truth,
                    MotionTable& table) {
  const Trajectory found =
      timed_trajectory(file, until, {.method = contender.method, .steps = contender.steps, .by_count = true});
  const double error = end_error(file.scene, found, truth.end);
  std::string status = status_cell(found.status), reason = found.reason;
  if (found.status == pbd::Status::ok && !std::isfinite(error)) {
    status = status_cell(pbd::Status::diverged);
    reason = "error not finite";
  } else if (found.status == pbd::Status::ok && found.missed_steps > 0) {
    status = status_cell(pbd::Status::not_converged);
    reason = fmt::format("{} of {} steps missed their tolerance", found.missed_steps, contender.steps);
  }
  table.add(contender, found, error, energy_error(file.scene, found, truth.end), status, reason);
  if (!reason.empty()) warn(fmt::format("`{}` {}: {}", contender.text, status, reason));
  if (!truth.tells(error) && std::isfinite(error))
    note(
        fmt::format("`{}`: the reference does not tell its error, {:.2g}, from none", contender.text, error));
  return reason.empty();
}

}  // namespace

int compare_motions(const CompareOptions& options, const SceneFile& file) {
  const double until = *options.until, whole = static_cast<double>(file.steps) * file.step_s;
  constexpr double rounding = 1e-9;
  if (until > whole * (1 + rounding))
    throw pbd::SetupError("--until", fmt::format("{:g}", until),
                          fmt::format("above 0 to {:g}: the scene lasts {:g} s", whole, whole));
  const auto contenders = parsed_movers(options.methods, file, until);
  std::string reference = motion_reference(options, file);
  ComparisonRecord record(options);
  MotionTable table(options, file);
  Compared compared;
  Truth truth;
  ProgressBar progress("compare", static_cast<std::int64_t>(contenders.size()) + 1);
  try {
    const auto start = std::chrono::steady_clock::now();
    truth = truth_of(reference, options, file, contenders);
    table.add_reference(reference, truth,
                        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (truth.reason.empty())
      note(fmt::format("reference: {}, error bar {:.2g}; it tells errors from {:.2g} on", truth.method,
                       truth.error_bar, truth.told(0)));
    else
      compared.fail(fmt::format("reference {}: {}: {}", reference, truth.method, truth.reason));
    progress.advance(reference);
    for (const auto& contender : contenders) {
      if (compared.outcome == RunOutcome::failed)
        table.skip(contender, compared.reason);
      else if (!measure_motion(contender, file, until, truth, table))
        compared.all_ok = false;
      progress.advance(contender.text);
    }
  } catch (const Interrupted&) {
    compared.stop();
  }
  table.close();
  auto settings = record.settings(file, reference);
  settings["until_s"] = until;
  settings["truth"] = truth.method;
  settings["error_bar"] = truth.error_bar;
  return record.close(settings, table.totals(), compared);
}

}  // namespace pbdcheck
