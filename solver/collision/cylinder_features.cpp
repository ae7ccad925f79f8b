#include "collision/cylinder_features.h"

namespace pbd {

void write_point(const Vec3& y, double radius, Feature feature, int i, const PlacedCylinder& b,
                 const ContactWriter& writer) {
  using Part = PlacedCylinder::Part;
  const PlacedCylinder::Place at = b.place(y);
  const double gap = at.distance - radius;
  if (at.part == Part::side)
    return writer.write(on_line(y, radius, b.centre, b.axis, b.radius),
                        writer.key(feature, i, Feature::axis, 0), gap);
  if (at.part == Part::cap)
    return writer.write(on_face(y, radius, at.nearest, at.normal, 0),
                        writer.key(feature, i, Feature::cap, at.end + 1), gap);
  const bool round = radius > 0;  // else a distance of points has no sign
  writer.write(round ? on_point(y, radius, at.nearest, 0) : on_face(y, 0, at.nearest, at.normal, 0),
               writer.key(feature, i, Feature::rim, at.end + 1), gap);
}

ContactPoint on_plane_by_rim(const PlacedCylinder& a, int end, const Vec3& on_plane, const Vec3& normal,
                             double radius_b) {
  ContactPoint contact = on_face(a.cap(end), 0, on_plane, normal, radius_b);
  contact.direction_a = a.axis;
  contact.across_a = a.across;
  contact.rim_a = a.radius;
  return contact;
}

void write_deepest_rim(const PlacedCylinder& a, const Vec3& on_plane, const Vec3& normal, Feature feature,
                       int j, const ContactWriter& writer) {
  const int end = a.axis.dot(normal) > 0 ? -1 : 1;
  const ContactPoint contact = on_plane_by_rim(a, end, on_plane, normal, 0);
  writer.write(contact, writer.key(Feature::rim, rim_point(end, rim_points), feature, j),
               touching(contact, {}, {}).gap);
}

}  // namespace pbd
