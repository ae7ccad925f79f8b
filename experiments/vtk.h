// Frames of a simulation for ParaView: one VTK unstructured grid (.vtu, ASCII) a frame and a collection
// (.pvd) with their times.
//
// Points are the nodes (m), point data `velocity` (m/s). Cells are the tetrahedra (type 10) of TetStrain, the
// triangles (5) of TriangleStrain, the links as lines (3), and a vertex (1) for each node none of them uses.
#pragma once

#include <filesystem>
#include <vector>

#include "files.h"
#include "scene.h"

namespace pbdcheck {

class VtkSeries {
 public:
  /// Frames go to `<directory>/frames/frame_000000.vtu`, the collection to `<directory>/simulation.pvd`.
  VtkSeries(const std::filesystem::path& directory, const pbd::Scene& scene);

  void add_frame(const pbd::State& state);

  /// Writes the collection of the frames so far.
  void close();

 private:
  std::filesystem::path directory_;
  PartialFile collection_;
  std::string cells_;  // the same in every frame
  std::size_t cell_count_ = 0;
  std::vector<double> times_;
};

}  // namespace pbdcheck
