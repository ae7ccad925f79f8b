#include "harness/vtk.h"

#include <fmt/format.h>

#include <iterator>

#include "harness/probes.h"

namespace pbdcheck {
namespace {

constexpr int vtk_vertex = 1;
constexpr int vtk_line = 3;
constexpr int vtk_triangle = 5;
constexpr int vtk_tetrahedron = 10;

template <class Nodes>
void add_cell(VtkCells& cells, const Nodes& nodes, int type) {
  for (const int node : nodes) cells.connectivity += fmt::format("{} ", node);
  cells.entries += nodes.size();
  ++cells.count;
  cells.offsets += fmt::format("{} ", cells.entries);
  cells.types += fmt::format("{} ", type);
}

std::string data_array(std::string_view attributes, std::string_view text) {
  return fmt::format("<DataArray {} format=\"ascii\">\n{}\n</DataArray>\n", attributes, text);
}

std::string numbers(const Eigen::MatrixXd& columns) {
  std::string text;
  for (const auto column : columns.colwise())
    fmt::format_to(std::back_inserter(text), "{:.17g}\n", fmt::join(column, " "));
  return text;
}

std::string float_array(const VtkArray& array, std::string_view more = {}) {
  return data_array(fmt::format(R"(type="Float64" NumberOfComponents="{}" Name="{}"{})", array.values.rows(),
                                array.name, more),
                    numbers(array.values));
}

std::string field_data(const std::vector<VtkArray>& field) {
  std::string text;
  for (const VtkArray& each : field) text += float_array(each, R"( NumberOfTuples="1")");
  return field.empty() ? "" : "<FieldData>\n" + text + "</FieldData>\n";
}

std::string text_of(const VtkCells& cells) {
  return "<Cells>\n" + data_array(R"(type="Int32" Name="connectivity")", cells.connectivity) +
         data_array(R"(type="Int32" Name="offsets")", cells.offsets) +
         data_array(R"(type="UInt8" Name="types")", cells.types) + "</Cells>\n";
}

constexpr std::string_view file_tag = "<VTKFile type=\"{}\" version=\"0.1\" byte_order=\"LittleEndian\">\n";

}  // namespace

VtkCells node_cells(const pbd::Scene& scene) {
  VtkCells cells;
  std::vector<bool> used(scene.mass.size(), false);
  const auto add_all = [&]<class Effect>(const pbd::Effect& effect, int type) {
    if (const auto* typed = std::get_if<Effect>(&effect))
      for (const auto& nodes : typed->node) {
        add_cell(cells, nodes, type);
        for (const int node : nodes) used[static_cast<std::size_t>(node)] = true;
      }
  };
  for (const auto& effect : scene.effects) {
    add_all.operator()<pbd::TetStrain>(effect, vtk_tetrahedron);
    add_all.operator()<pbd::TriangleStrain>(effect, vtk_triangle);
    add_all.operator()<pbd::Distance>(effect, vtk_line);
    if (const auto* contact = std::get_if<pbd::Contact>(&effect))
      for (const auto& nodes : contact->triangle) {
        add_cell(cells, nodes, vtk_triangle);
        for (const int node : nodes) used[static_cast<std::size_t>(node)] = true;
      }
  }
  for (int node = 0; node < scene.nodes(); ++node)
    if (!used[static_cast<std::size_t>(node)]) add_cell(cells, std::array{node}, vtk_vertex);
  return cells;
}

VtkSeries::VtkSeries(const std::filesystem::path& directory, const std::string& collection, std::string frame,
                     const VtkCells& cells)
    : directory_(directory),
      frame_(std::move(frame)),
      collection_(directory / (collection + ".pvd")),
      cells_(cells) {
  require_writable(directory_ / "frames");
}

std::string VtkSeries::frame_name(std::size_t index) const {
  return fmt::format("frames/{}_{:06}.vtu", frame_, index);
}

void VtkSeries::add(double time, const pbd::Points& x, const VtkCells& cells,
                    const std::vector<VtkArray>& data, const std::vector<VtkArray>& field) {
  std::string arrays;
  for (const VtkArray& each : data) arrays += float_array(each);
  write_file(directory_ / frame_name(times_.size()),
             fmt::format(file_tag, "UnstructuredGrid") + "<UnstructuredGrid>\n" + field_data(field) +
                 fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", x.cols(), cells.count) +
                 "<Points>\n" + float_array({"points", x}) + "</Points>\n" + text_of(cells) +
                 fmt::format("<PointData Vectors=\"{}\">\n", data.front().name) + arrays +
                 "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  times_.push_back(time);
}

void VtkSeries::add_frame(double time, const pbd::Points& x, const pbd::Points& v) {
  add(time, x, cells_, {{"velocity", v}});
}

void VtkSeries::add_frame(const pbd::Scene& scene, const pbd::State& state) {
  std::vector<VtkArray> energies;
  for (const EnergyTerm& term : energy_terms)
    energies.push_back({term.name, Eigen::MatrixXd::Constant(1, 1, term.of(scene, state))});
  add(state.time, state.x, cells_, {{"velocity", state.v}}, energies);
}

void VtkSeries::add_contacts(double time, double h, const std::vector<pbd::ContactForce>& contacts) {
  const auto count = std::ssize(contacts);
  pbd::Points place(3, count), force(3, count), impulse(3, count), normal(3, count), slip(3, count);
  Eigen::RowVectorXd gap(count);
  VtkCells cells;
  for (int i = 0; i < count; ++i) {
    const pbd::ContactForce& contact = contacts[static_cast<std::size_t>(i)];
    place.col(i) = contact.point;
    force.col(i) = contact.force;
    impulse.col(i) = h * contact.force;
    normal.col(i) = contact.normal;
    slip.col(i) = contact.slip;
    gap[i] = contact.gap;
    add_cell(cells, std::array{i}, vtk_vertex);
  }
  add(time, place, cells,
      {{"force", force}, {"impulse", impulse}, {"normal", normal}, {"slip", slip}, {"gap", gap}});
}

void VtkSeries::close() {
  collection_.write(fmt::format(file_tag, "Collection") + "<Collection>\n");
  for (std::size_t i = 0; i < times_.size(); ++i)
    collection_.write(fmt::format("<DataSet timestep=\"{:.17g}\" file=\"{}\"/>\n", times_[i], frame_name(i)));
  collection_.write("</Collection>\n</VTKFile>\n");
  collection_.complete();
}

BodySurfaces::BodySurfaces(const pbd::Scene& scene, const std::vector<NamedBody>& bodies)
    : surface_{pbd::Points(3, 0), {}} {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const pbd::TriangleMesh own = surface_of(bodies[b].shape);
    const Eigen::Index first = surface_.x.cols(), count = own.x.cols();
    surface_.x.conservativeResize(3, first + count);
    surface_.x.rightCols(count) = bodies[b].to_body * own.x;
    for (const auto& [i, j, k] : own.triangles) {
      const auto shift = static_cast<int>(first);
      surface_.triangles.push_back({i + shift, j + shift, k + shift});
    }
    parts_.push_back({scene.bodies[b].node, first, count});
  }
}

VtkCells BodySurfaces::cells() const {
  VtkCells cells;
  for (const auto& triangle : surface_.triangles) add_cell(cells, triangle, vtk_triangle);
  return cells;
}

void BodySurfaces::place(const pbd::State& state, pbd::Points& x, pbd::Points& v) const {
  x.resize(3, surface_.x.cols());
  v.resize(3, surface_.x.cols());
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const auto& [node, first, count] = parts_[b];
    const Eigen::Matrix3d rotation = state.orientation[b].toRotationMatrix();
    const pbd::Vec3 spin = rotation * state.spin.col(static_cast<Eigen::Index>(b));
    for (Eigen::Index i = first; i < first + count; ++i) {
      const pbd::Vec3 lever = rotation * surface_.x.col(i);
      x.col(i) = state.x.col(node) + lever;
      v.col(i) = state.v.col(node) + spin.cross(lever);
    }
  }
}

}  // namespace pbdcheck
