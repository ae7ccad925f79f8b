#include "collision/mesh_mesh.h"

#include "collision/mesh_overlap.h"

namespace pbd {

void mesh_mesh(const ClosedMesh& a, const ClosedMesh& b, const ContactWriter& in_b, const ContactWriter& in_a,
               CollisionScratch& scratch) {
  scratch.a.place(a, in_b.frame_a);
  scratch.b.place(b, in_a.frame_a);
  MeshPair pair{scratch.a, b, in_b, scratch, &a};
  MeshPair exchanged{scratch.b, a, in_a, scratch, &b};
  pair.flush = exchanged.flush = std::min(pair.flush, exchanged.flush);
  pair.nodes();
  pair.edges();
  exchanged.nodes();
  if (in_b.least() < -pair.flush) return;
  pair.nodes_inside();  // overlapping by nodes that are not the lowest ones
  exchanged.nodes_inside();
  write_overlap(pair);
  write_overlap(exchanged);
}

}  // namespace pbd
