// Frames of a simulation for ParaView: one VTK unstructured grid (.vtu, ASCII) a frame and a collection
// (.pvd) with their times. Points are in m; point data are `velocity` (m/s) or, of contacts, `force` (N, on
// the first of both), `impulse` (N s, that force times the step's h), `normal`, `slip` (m/s) and `gap` (m).
// Frames of a scene's nodes have its energies (J) as field data, one number a frame: `kinetic_energy`,
// `gravity_energy` and `elastic_energy`, as probes tell them (probes.h).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/files.h"
#include "scene.h"
#include "scenes/named.h"
#include "step/step.h"

namespace pbdcheck {

/// Cells of a VTK grid, the same in every frame.
struct VtkCells {
  std::string connectivity, offsets, types;
  std::size_t entries = 0;
  std::size_t count = 0;
};

/// Of the nodes: the tetrahedra (type 10) of TetStrain, the triangles (5) of TriangleStrain and of surfaces
/// in contact, the links as lines (3), and a vertex (1) for each node none of them uses.
VtkCells node_cells(const pbd::Scene& scene);

/// Values at the points, a column each: three rows or one. Of field data one column for the whole frame.
struct VtkArray {
  std::string_view name;
  Eigen::MatrixXd values;
};

class VtkSeries {
 public:
  /// Frames go to `<directory>/frames/<frame>_000000.vtu`, the collection to `<directory>/<collection>.pvd`.
  VtkSeries(const std::filesystem::path& directory, const std::string& collection, std::string frame,
            const VtkCells& cells);

  /// A surface.
  void add_frame(double time, const pbd::Points& x, const pbd::Points& v);

  /// The scene's nodes and its energies.
  void add_frame(const pbd::Scene& scene, const pbd::State& state);

  /// Points alone, each a vertex (1), of a step of h seconds.
  void add_contacts(double time, double h, const std::vector<pbd::ContactForce>& contacts);

  /// Writes the collection of the frames so far.
  void close();

 private:
  std::string frame_name(std::size_t index) const;
  void add(double time, const pbd::Points& x, const VtkCells& cells, const std::vector<VtkArray>& data,
           const std::vector<VtkArray>& field = {});

  std::filesystem::path directory_;
  std::string frame_;
  PartialFile collection_;
  VtkCells cells_;
  std::vector<double> times_;
};

/// The surfaces of a scene's rigid bodies, moved with them.
class BodySurfaces {
 public:
  BodySurfaces(const pbd::Scene& scene, const std::vector<NamedBody>& bodies);

  bool empty() const { return surface_.triangles.empty(); }
  VtkCells cells() const;

  /// Positions and velocities of the surfaces' nodes.
  void place(const pbd::State& state, pbd::Points& x, pbd::Points& v) const;

 private:
  pbd::TriangleMesh surface_;  // of all bodies, each in its own frame
  struct Part {
    int node;  // the body's in the scene
    Eigen::Index first, count;
  };
  std::vector<Part> parts_;  // one a body
};

}  // namespace pbdcheck
