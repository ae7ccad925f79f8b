#include "collision/half_space.h"

#include "collision/cylinder_features.h"

namespace pbd {

void polyhedron_half_space(const RoundedPolyhedron& a, const ContactWriter& writer) {
  const Vec3 normal = writer.frame_b.rotation.col(2);
  const Vec3& origin = writer.frame_b.origin;
  for (int i = 0; i < a.node_count(); ++i)
    writer.write(on_face(a.node(i), a.radius, origin, normal, 0),
                 writer.key(Feature::node, i, Feature::face, 0), normal.dot(a.node(i) - origin) - a.radius);
}

void cylinder_half_space(const Cylinder& a, const ContactWriter& writer) {
  const auto anywhere = [](const Vec3&) { return true; };
  write_rims(PlacedCylinder(a, writer.frame_a), writer.frame_b.origin, writer.frame_b.rotation.col(2), 0,
             Feature::face, 0, -infinity, writer, anywhere, anywhere);
}

}  // namespace pbd
