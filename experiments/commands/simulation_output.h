// What a simulation writes while it runs: probes, and frames for ParaView.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "harness/results.h"
#include "harness/vtk.h"
#include "scenes/scene_file.h"

namespace pbdcheck {

class SimulationOutput {
 public:
  /// Removes what an earlier simulation has written there: a folder holds one.
  SimulationOutput(const SimulateOptions& options, const SceneFile& file);

  /// Writes the state down unless a probe's value is not finite: returns that one's column, or nothing. The
  /// last step of the workspace was of h seconds.
  std::string add(std::int64_t step, const pbd::State& state, const pbd::Workspace* stepped, double h);

  void close();

  const TableTotals& totals() const { return totals_; }

 private:
  const SceneFile& file_;
  TableTotals totals_;
  std::vector<std::string> columns_{"step", "time_s"};
  std::optional<Table> probes_;
  std::optional<VtkSeries> frames_, body_frames_, contact_frames_;
  std::optional<BodySurfaces> surfaces_;
};

}  // namespace pbdcheck
