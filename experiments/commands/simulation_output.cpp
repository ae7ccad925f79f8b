#include "commands/simulation_output.h"

#include <cmath>
#include <filesystem>

#include "harness/files.h"
#include "harness/probes.h"
#include "scenes/contacts.h"

namespace pbdcheck {
namespace {

void remove_earlier(const std::filesystem::path& directory) {
  for (const auto* name :
       {"run.json", "probes.csv", "checks.csv", "judged.csv", "simulation.pvd", "bodies.pvd", "contacts.pvd"})
    if (std::filesystem::is_regular_file(directory / name)) std::filesystem::remove(directory / name);
  if (!std::filesystem::is_directory(directory / "frames")) return;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "frames")) {
    const auto name = entry.path().filename().string();
    const bool own =
        name.starts_with("frame_") || name.starts_with("bodies_") || name.starts_with("contacts_");
    if (own && entry.is_regular_file() && entry.path().extension() == ".vtu")
      std::filesystem::remove(entry.path());
  }
}

}  // namespace

SimulationOutput::SimulationOutput(const SimulateOptions& options, const SceneFile& file) : file_(file) {
  require_writable(options.directory);
  remove_earlier(options.directory);
  if (!file.probes.empty()) {
    for (auto& column : probe_columns(file)) columns_.push_back(std::move(column));
    probes_.emplace(options.directory / "probes.csv", columns_, &totals_);
  }
  if (options.export_format != "vtk") return;
  frames_.emplace(options.directory, "simulation", "frame", node_cells(file.scene));
  surfaces_.emplace(file.scene, file.bodies);
  if (!surfaces_->empty()) body_frames_.emplace(options.directory, "bodies", "bodies", surfaces_->cells());
  if (contact_of(file.scene) != nullptr)
    contact_frames_.emplace(options.directory, "contacts", "contacts", VtkCells{});
}

std::string SimulationOutput::add(std::int64_t step, const pbd::State& state, const pbd::Workspace* stepped,
                                  double h) {
  std::vector<Cell> row{step, state.time};
  append_probes(file_, state, stepped, row);
  for (std::size_t i = 0; i < row.size(); ++i)
    if (const auto* number = std::get_if<double>(&row[i]); number != nullptr && !std::isfinite(*number))
      return columns_[i];
  if (probes_) probes_->row(row);
  if (frames_) frames_->add_frame(file_.scene, state);
  if (body_frames_) {
    pbd::Points x, v;
    surfaces_->place(state, x, v);
    body_frames_->add_frame(state.time, x, v);
  }
  if (contact_frames_)
    contact_frames_->add_contacts(
        state.time, h, stepped != nullptr ? stepped->contacts() : std::vector<pbd::ContactForce>{});
  return "";
}

void SimulationOutput::close() {
  if (probes_) probes_->close();
  if (frames_) frames_->close();
  if (body_frames_) body_frames_->close();
  if (contact_frames_) contact_frames_->close();
}

}  // namespace pbdcheck
