// Surfaces that cross, by an edge of one that goes through a triangle of the other: code that shares nothing
// with the solver's search of contacts.
#pragma once

#include <vector>

#include "scene.h"

namespace pbdcheck {

/// Triangles of a scene's contact that edges go through, theirs and those of the shapes of bodies, or that
/// have an edge that goes through one of those shapes: they keep a distance to each other, but where nodes
/// are held in one plane, which rounding does not let cross. Of round shapes polyhedra inside count, of half
/// spaces nodes below. Edges and triangles with a common node do not cross, nor do, if surfaces do not touch
/// each other, their own.
class Crossings {
 public:
  explicit Crossings(const pbd::Scene& scene);

  double count(const pbd::State& state) const;

 private:
  /// Triangles with the edges of their own, by nodes or in a body's frame.
  struct Part {
    int body = -1;  // -1: nodes of the scene
    bool plane = false;
    pbd::Frame frame{};
    pbd::Points x{};  // m, of a body's shape
    std::vector<std::array<int, 3>> triangle{};
    std::vector<std::array<int, 2>> edge{};
  };
  pbd::Points places(const Part& part, const pbd::State& state) const;

  const pbd::Scene& scene_;
  bool own_ = false;  // surfaces touch each other
  Part soft_;
  std::vector<Part> shapes_;
};

}  // namespace pbdcheck
