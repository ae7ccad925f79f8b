#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <limits>

#include "commands.h"
#include "error.h"
#include "files.h"
#include "interrupt.h"
#include "judges.h"
#include "measure.h"
#include "progress.h"
#include "scene_file.h"

namespace pbdcheck {
namespace {

/// The state after `steps` steps of the scene's own method; `missed` counts those that missed their
/// tolerance.
pbd::State advanced(const SceneFile& file, int steps, int& missed) {
  pbd::State state = file.scene.initial;
  pbd::Workspace workspace(file.scene, file.method);
  for (int i = 0; i < steps && !interrupted(); ++i)
    if (pbd::step(file.scene, file.method, file.step_s, state, workspace).status != pbd::Status::ok) ++missed;
  return state;
}

void add_trace(Table& table, const std::string& scene, double h, const pbd::Method& method,
               const Trace& trace) {
  const std::string status(pbd::status_names[static_cast<std::size_t>(trace.report.status)]);
  for (const auto& point : trace.points)
    table.row({scene, h, method.integrator, method.outer, method.relaxation, std::string("none"),
               std::int64_t{point.outer_iterations}, point.sweeps, point.row_updates, point.wall_s,
               point.error, status, std::string(trace.report.reason)});
}

/// The reference's own row, marked as in the experiments: outer `judge`, its name as the relaxation.
void add_judge(Table& table, const std::string& scene, double h, const std::string& name,
               const Judged& judged) {
  table.row({scene, h, std::string("implicit_euler"), std::string("judge"), name, std::string("none"),
             std::int64_t{judged.iterations}, std::int64_t{0}, std::int64_t{0}, judged.seconds, 0.0,
             judged.status, judged.reason});
}

std::vector<pbd::Method> parsed_methods(const CompareOptions& options, const pbd::Method& base) {
  if (options.methods.empty())
    throw pbd::SetupError("compare", "no --method", "one or more --method \"KEY=VALUE ...\"");
  std::vector<pbd::Method> methods;
  for (const auto& text : options.methods) methods.push_back(parse_method(text, base, "--method"));
  for (const auto& method : methods)
    if (method.integrator != "implicit_euler")
      throw pbd::SetupError("--method integrator", "`" + method.integrator + "`",
                            "implicit_euler, the step the references solve");
  return methods;
}

/// Draws `compare.csv` of a folder by the project's plotting script; a warning if that fails.
void draw(const std::filesystem::path& directory) {
  const std::string script = PBDCHECK_PLOTS "/compare.py", folder = directory.string();
  const char* const arguments[] = {PBDCHECK_PYTHON, script.c_str(), folder.c_str(), nullptr};
  pid_t child = 0;
  int status = 0;
  const bool started =
      posix_spawn(&child, arguments[0], nullptr, nullptr, const_cast<char* const*>(arguments), environ) == 0;
  if (!started || waitpid(child, &status, 0) < 0 || status != 0)
    warn(fmt::format("no figure drawn: {} {} failed", arguments[0], script));
}

}  // namespace

int compare(const CompareOptions& options) {
  const SceneFile file = read_scene_file(options.scene, options.settings);
  const auto methods = parsed_methods(options, file.method);
  const auto names = reference_names();
  const std::string name = options.reference.empty() && !names.empty() ? names[0] : options.reference;
  int missed = 0;
  const pbd::State state = advanced(file, options.at_step, missed);
  if (interrupted()) return exit_interrupted;
  if (missed > 0)
    warn(fmt::format("{} of {} steps on the way to the compared one missed their tolerance", missed,
                     options.at_step));
  const Judged judged = judge_step(name, file.scene, state, file.step_s);
  if (judged.status != "ok") warn(fmt::format("reference {} {}: {}", name, judged.status, judged.reason));

  require_writable(options.directory);
  const std::string scene = options.scene.stem().string();
  Table table(options.directory / "compare.csv",
              {"scene", "step_s", "integrator", "outer", "relaxation", "friction", "outer_iterations",
               "sweeps", "row_updates", "wall_s", "error", "status", "reason"});
  add_judge(table, scene, file.step_s, name, judged);
  bool all_ok = judged.status == "ok" && missed == 0;
  Progress progress("compare", static_cast<std::int64_t>(methods.size()));
  for (const auto& method : methods) {
    if (interrupted()) break;
    const Trace trace = measure(file.scene, state, file.step_s, method, judged.x);
    if (trace.report.status != pbd::Status::ok)
      warn(fmt::format("{} {} missed its tolerance: {}", method.outer, method.relaxation,
                       trace.report.reason));
    all_ok = all_ok && trace.report.status == pbd::Status::ok;
    add_trace(table, scene, file.step_s, method, trace);
    progress.advance(method.outer + " " + method.relaxation);
  }
  table.close();
  if (interrupted()) return exit_interrupted;
  draw(options.directory);
  return all_ok ? exit_done : exit_failed;
}

}  // namespace pbdcheck
