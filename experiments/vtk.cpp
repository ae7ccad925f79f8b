#include "vtk.h"

#include <fmt/format.h>

#include <iterator>

namespace pbdcheck {
namespace {

constexpr int vtk_vertex = 1;
constexpr int vtk_line = 3;
constexpr int vtk_triangle = 5;
constexpr int vtk_tetrahedron = 10;

struct Cells {
  std::string connectivity, offsets, types;
  std::size_t entries = 0;
  std::size_t count = 0;
  std::vector<bool> used;

  template <class Nodes>
  void add(const Nodes& nodes, int type) {
    for (const int node : nodes) {
      connectivity += fmt::format("{} ", node);
      used[static_cast<std::size_t>(node)] = true;
    }
    entries += nodes.size();
    ++count;
    offsets += fmt::format("{} ", entries);
    types += fmt::format("{} ", type);
  }

  template <class Effect>
  void add_all(const pbd::Effect& effect, int type) {
    if (const auto* typed = std::get_if<Effect>(&effect))
      for (const auto& nodes : typed->node) add(nodes, type);
  }
};

Cells cells_of(const pbd::Scene& scene) {
  Cells cells;
  cells.used.assign(scene.mass.size(), false);
  for (const auto& effect : scene.effects) {
    cells.add_all<pbd::TetStrain>(effect, vtk_tetrahedron);
    cells.add_all<pbd::TriangleStrain>(effect, vtk_triangle);
    cells.add_all<pbd::Distance>(effect, vtk_line);
  }
  for (int node = 0; node < scene.nodes(); ++node)
    if (!cells.used[static_cast<std::size_t>(node)]) cells.add(std::array{node}, vtk_vertex);
  return cells;
}

std::string data_array(std::string_view attributes, std::string_view text) {
  return fmt::format("<DataArray {} format=\"ascii\">\n{}\n</DataArray>\n", attributes, text);
}

std::string numbers(const pbd::Points& points) {
  std::string text;
  for (int i = 0; i < points.cols(); ++i)
    fmt::format_to(std::back_inserter(text), "{:.17g} {:.17g} {:.17g}\n", points(0, i), points(1, i),
                   points(2, i));
  return text;
}

std::string frame_name(std::size_t frame) {
  return fmt::format("frames/frame_{:06}.vtu", frame);
}

constexpr std::string_view file_tag = "<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"LittleEndian\">\n";

}  // namespace

VtkSeries::VtkSeries(const std::filesystem::path& directory, const pbd::Scene& scene)
    : directory_(directory), collection_(directory / "simulation.pvd") {
  require_writable(directory_ / "frames");
  const Cells cells = cells_of(scene);
  cell_count_ = cells.count;
  cells_ = "<Cells>\n" + data_array(R"(type="Int32" Name="connectivity")", cells.connectivity) +
           data_array(R"(type="Int32" Name="offsets")", cells.offsets) +
           data_array(R"(type="UInt8" Name="types")", cells.types) + "</Cells>\n";
}

void VtkSeries::add_frame(const pbd::State& state) {
  const std::string vectors = R"(type="Float64" NumberOfComponents="3")";
  write_file(
      directory_ / frame_name(times_.size()),
      fmt::format(file_tag, "UnstructuredGrid") + "<UnstructuredGrid>\n" +
          fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", state.x.cols(), cell_count_) +
          "<Points>\n" + data_array(vectors, numbers(state.x)) + "</Points>\n" + cells_ +
          "<PointData Vectors=\"velocity\">\n" +
          data_array(vectors + R"( Name="velocity")", numbers(state.v)) +
          "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  times_.push_back(state.time);
}

void VtkSeries::close() {
  collection_.write(fmt::format(file_tag, "Collection") + "<Collection>\n");
  for (std::size_t i = 0; i < times_.size(); ++i)
    collection_.write(fmt::format("<DataSet timestep=\"{:.17g}\" file=\"{}\"/>\n", times_[i], frame_name(i)));
  collection_.write("</Collection>\n</VTKFile>\n");
  collection_.complete();
}

}  // namespace pbdcheck
