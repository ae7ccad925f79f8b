#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/comparison.h"
#include "commands/contender.h"
#include "commands/way.h"
#include "contact_newton.h"
#include "error.h"
#include "harness/contact_sums.h"
#include "harness/interrupt.h"
#include "harness/judges.h"
#include "harness/measure.h"
#include "harness/progress.h"
#include "harness/step_judge.h"
#include "scenes/choices.h"
#include "scenes/scene_file.h"

namespace pbdcheck {
namespace {

/// compare.csv as it is written.
class Comparison {
 public:
  Comparison(const CompareOptions& options, const SceneFile& file)
      : scene_(options.scene.stem().string()),
        step_s_(file.step_s),
        contact_(contact_of(file.scene) != nullptr),
        table_(options.directory / "compare.csv",
               {"scene", "step_s", "integrator", "outer", "relaxation", "friction", "outer_iterations",
                "sweeps", "row_updates", "wall_s", "error", "status", "reason", "method"},
               &totals_) {}

  /// The reference's own row, marked as in the experiments: outer `judge`, its name as the relaxation.
  void add_judge(const std::string& name, const std::string& integrator, const Judged& judged) {
    pbd::Method method;
    method.integrator = integrator;
    method.outer = "judge";
    method.relaxation = name;
    add({name, method},
        {.outer_iterations = judged.iterations,
         .wall_s = judged.seconds,
         .error = judged.status == "ok" ? 0 : std::nan("")},
        judged.status, judged.reason);
  }

  /// A method's iterates; returns whether it solved the step.
  bool add_trace(const Contender& contender, const Trace& trace) {
    bool ok = trace.report.status == pbd::Status::ok;
    for (const auto& point : trace.points) {
      const bool finite = std::isfinite(point.error);
      ok = ok && finite;
      add(contender, point,
          finite ? pbd::status_names[static_cast<std::size_t>(trace.report.status)] : "diverged",
          finite ? trace.report.reason : "error not finite");
    }
    return ok;
  }

  void skip(const Contender& contender, std::string_view reason) {
    add(contender, {.wall_s = std::nan(""), .error = std::nan("")}, "skipped", reason);
  }

  void close() { table_.close(); }
  const TableTotals& totals() const { return totals_; }

 private:
  void add(const Contender& contender, const TracePoint& point, std::string_view status,
           std::string_view reason) {
    const auto& method = contender.method;
    table_.row({scene_, step_s_, method.integrator, method.outer, method.relaxation,
                contact_ ? method.friction : std::string("none"), std::int64_t{point.outer_iterations},
                point.sweeps, point.row_updates, point.wall_s, point.error, std::string(status),
                std::string(reason), contender.text});
  }

  std::string scene_;
  double step_s_;
  bool contact_;
  TableTotals totals_;
  Table table_;
};

/// Refuses what the reference does not solve, and a step beyond the scene's last.
void require_comparable(const CompareOptions& options, const SceneFile& file, const std::string& reference) {
  for (const auto& name : motion_reference_names())
    if (name == reference)
      throw pbd::SetupError("--reference", "`" + name + "`",
                            joined(reference_names()) + "; this one is of motions, with --until");
  if (contact_of(file.scene) != nullptr && !knows_contact(reference))
    throw pbd::SetupError(
        "--reference " + reference, "a scene with contact",
        "cone_interior_point, cone_ipopt: this reference solves equations, and a gap is none");
  if (knows_contact(reference))
    pbd::reference::require_judged(file.scene, file.scene.initial, file.step_s,
                                   pbd::friction_by_name(file.method.friction));
  for (const auto& joint : file.joints)
    if (joint.bounded && !knows_contact(reference))
      throw pbd::SetupError(
          joint.where, "a limit or a limited force",
          "neither by " + reference + ": cone_interior_point, cone_ipopt know bounds of forces");
  if (options.at_step >= file.steps)
    throw pbd::SetupError("--at-step", std::to_string(options.at_step),
                          fmt::format("0 to {}: the scene has {} steps", file.steps - 1, file.steps));
}

/// The reference of steps by the integrator, `first` of implicit Euler's. Throws SetupError if the one asked
/// for knows no others.
std::string reference_of(const CompareOptions& options, const SceneFile& file, const std::string& integrator,
                         const std::string& first) {
  if (integrator == "implicit_euler") return first;
  const std::string name = options.reference.empty() ? default_reference(file.scene, integrator) : first;
  if (!knows_contact(name))
    throw pbd::SetupError("--reference " + name, "steps of `" + integrator + "`",
                          "cone_interior_point, cone_ipopt: this reference solves implicit Euler's alone");
  require_comparable(options, file, name);
  return name;
}

int compare_step(const CompareOptions& options, SceneFile& file) {
  const std::string first = options.reference.empty() ? default_reference(file.scene) : options.reference;
  require_comparable(options, file, first);
  const auto contenders = parsed_contenders(options.methods, file);
  const std::string integrator = contenders.front().method.integrator;
  const std::string name = reference_of(options, file, integrator, first);
  ComparisonRecord record(options);
  Comparison comparison(options, file);

  Way way(file, integrator);
  way.go(options.at_step);
  if (way.missed > 0)
    warn(fmt::format("{} of {} steps on the way to the compared one missed their tolerance", way.missed,
                     options.at_step));
  const auto map = way.map();
  const Judged judged = judge_step(name, file.scene, way.state, file.step_s,
                                   pbd::friction_by_name(file.method.friction), map ? &*map : nullptr);
  comparison.add_judge(name, integrator, judged);
  Compared compared{.all_ok = way.missed == 0};
  if (judged.status != "ok")
    compared.fail(fmt::format("reference {} {}: {}", name, judged.status, judged.reason));
  ProgressBar progress("compare", static_cast<std::int64_t>(contenders.size()));
  try {
    for (const auto& contender : contenders) {
      if (compared.outcome == RunOutcome::failed) {
        comparison.skip(contender, compared.reason);
        continue;
      }
      throw_if_interrupted();
      const Trace trace =
          measure([&] { return contender.measure_once(file, way.state, way.workspace, judged.x); });
      if (trace.report.status == pbd::Status::ok && trace.met_on_way) {
        compared.all_ok = false;
        comparison.skip(contender, not_judged_if_met);
        warn(fmt::format("`{}` is not compared: {}", contender.text, not_judged_if_met));
      } else if (!comparison.add_trace(contender, trace)) {
        compared.all_ok = false;
        warn(fmt::format("`{}` missed its tolerance: {}", contender.text, trace.report.reason));
      }
      progress.advance(contender.text);
    }
  } catch (const Interrupted&) {
    compared.stop();
  }
  comparison.close();
  auto settings = record.settings(file, name);
  settings["at_step"] = options.at_step;
  return record.close(settings, comparison.totals(), compared);
}

}  // namespace

int compare(const CompareOptions& options) {
  SceneFile file = read_scene_file(options.scene, options.settings);
  return options.until ? compare_motions(options, file) : compare_step(options, file);
}

}  // namespace pbdcheck
