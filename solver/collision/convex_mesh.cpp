#include "collision/convex_mesh.h"

#include "collision/mesh_overlap.h"

namespace pbd {

void convex_mesh(const RoundedPolyhedron& a, const ClosedMesh& b, const ContactWriter& writer,
                 CollisionScratch& scratch) {
  const MeshPair pair{a, b, writer, scratch};
  pair.nodes();
  pair.edges();
  pair.nodes_of_mesh();
  if (writer.least() < -pair.flush - a.radius) return;
  pair.nodes_inside();
  write_overlap(pair);
}

}  // namespace pbd
