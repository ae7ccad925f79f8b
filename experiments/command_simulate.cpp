#include <fmt/format.h>

#include <cmath>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "choices.h"
#include "commands.h"
#include "files.h"
#include "interrupt.h"
#include "probes.h"
#include "progress.h"
#include "provenance.h"
#include "vtk.h"

namespace pbdcheck {
namespace {

/// What a run's steps reached, summed up.
struct Totals {
  std::int64_t steps = 0;
  std::array<std::int64_t, pbd::status_names.size()> by_status{};
  std::int64_t outer_iterations = 0;
  std::int64_t sweeps = 0;
  std::int64_t row_updates = 0;
  double worst_residual = 0;
  std::int64_t worst_step = 0;

  void add(const pbd::Report& report) {
    ++steps;
    ++by_status[static_cast<std::size_t>(report.status)];
    outer_iterations += report.outer_iterations;
    sweeps += report.sweeps;
    row_updates += report.row_updates;
    if (!std::isnan(worst_residual) && !(report.residual() <= worst_residual)) {
      worst_residual = report.residual();
      worst_step = steps;
    }
  }
  std::int64_t missed() const { return steps - by_status[0]; }
};

class Output {
 public:
  Output(const SimulateOptions& options, const SceneFile& file) : file_(file) {
    require_writable(options.directory);
    if (!file.probes.empty()) {
      std::vector<std::string> columns{"step", "time_s"};
      for (auto& column : probe_columns(file.probes, file.scene)) columns.push_back(std::move(column));
      probes_.emplace(options.directory / "probes.csv", std::move(columns));
    }
    if (options.export_format == "vtk") frames_.emplace(options.directory, file.scene);
  }

  void add(std::int64_t step, const pbd::State& state) {
    if (frames_) frames_->add_frame(state);
    if (!probes_) return;
    std::vector<Cell> row{step, state.time};
    append_probes(file_.probes, file_.scene, state, row);
    probes_->row(row);
  }

  void close() {
    if (probes_) probes_->close();
    if (frames_) frames_->close();
  }

 private:
  const SceneFile& file_;
  std::optional<Table> probes_;
  std::optional<VtkSeries> frames_;
};

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

/// Steps until the end, Ctrl-C or divergence.
Totals advance(const SceneFile& file, pbd::Workspace& workspace, Output& output) {
  Totals totals;
  pbd::State state = file.scene.initial;
  Progress progress("simulate", file.steps);
  output.add(0, state);
  while (totals.steps < file.steps && !interrupted()) {
    const auto report = pbd::step(file.scene, file.method, file.step_s, state, workspace);
    totals.add(report);
    if (report.status != pbd::Status::ok && totals.missed() == 1)
      warn(fmt::format("step {} {}: {} (residual {:.3g}, tolerance {:.3g}); later ones are counted",
                       totals.steps, pbd::status_names[static_cast<std::size_t>(report.status)],
                       report.reason, report.residual(), file.method.tolerance));
    if (report.status == pbd::Status::diverged) break;
    output.add(totals.steps, state);
    progress.advance(fmt::format("t = {:.4g} s", state.time));
  }
  return totals;
}

}  // namespace

int simulate(const SimulateOptions& options) {
  if (!options.export_format.empty())
    require_name("--export", options.export_format, std::vector<std::string>{"vtk"});
  const SceneFile file = read_scene_file(options.scene, options.settings);
  pbd::Workspace workspace(file.scene, file.method);
  Output output(options, file);

  const auto start = std::chrono::steady_clock::now();
  const Totals totals = advance(file, workspace, output);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  output.close();

  const bool stopped = interrupted() && totals.steps < file.steps;
  auto record = provenance(1);
  record["settings"] = settings_json(options, file);
  record["wall_s"] = wall.count();
  record["status"] = stopped ? "interrupted" : "complete";
  record["report"] = report_json(totals, workspace);
  write_json(options.directory / "run.json", record);

  if (totals.missed() > 0)
    warn(fmt::format("{} of {} steps missed the tolerance {:.3g}, the worst with {:.3g} (step {})",
                     totals.missed(), totals.steps, file.method.tolerance, totals.worst_residual,
                     totals.worst_step));
  if (stopped) return exit_interrupted;
  return totals.missed() > 0 ? exit_failed : exit_done;
}

}  // namespace pbdcheck
