// Which colliders may touch at all: not those of bodies that a joint connects or the effect names, nor a node
// the body that carries it or that it is attached to, nor nodes of one element, nor one of these a triangle
// of the other.
#pragma once

#include <array>
#include <vector>

#include "scene.h"

namespace pbd {

class AllowedPairs {
 public:
  AllowedPairs(const Scene& scene, const Contact& effect);

  bool bodies(int first, int second) const;
  bool node_and_body(int node, int body) const;
  /// Where nodes touch each other.
  bool nodes(int first, int second) const;
  /// The nodes of a node's elements, itself among them, ascending; where nodes touch each other or triangles.
  std::vector<int> linked_to(int node) const;

 private:
  std::vector<std::array<int, 2>> apart_;     // bodies, the lower one first
  std::vector<std::array<int, 2>> attached_;  // nodes and bodies
  std::vector<std::array<int, 2>> linked_;    // nodes of one element, both ways, where nodes touch any
};

}  // namespace pbd
