#include "collision/cylinder_features.h"

namespace pbd {
namespace {

/// With a's rim at that end about a's point in its place.
ContactPoint of_rim(const PlacedCylinder& a, int end, ContactPoint contact) {
  contact.direction_a = end * a.axis;
  contact.across_a = a.across;
  contact.rim_a = a.radius;
  return contact;
}

/// With a's rim next to one of its points against b's line or rim.
ContactPoint next_to(const Vec3& on_rim, ContactPoint contact) {
  contact.kind = ContactPoint::Kind::rim;
  contact.across_a = (on_rim - contact.point_a).normalized();
  return contact;
}

}  // namespace

ContactPoint rim_on_point(const PlacedCylinder& a, int end, const Vec3& point_b, double radius_b) {
  return of_rim(a, end, on_point(a.cap(end), 0, point_b, radius_b));
}

ContactPoint rim_on_line(const PlacedCylinder& a, int end, const Vec3& on_rim, const Vec3& on_line,
                         const Vec3& along, double radius_b) {
  return next_to(on_rim, of_rim(a, end, pbd::on_line(a.cap(end), 0, on_line, along, radius_b)));
}

ContactPoint rim_on_rim(const PlacedCylinder& a, int end, const Vec3& on_rim, const PlacedCylinder& b,
                        int end_b) {
  ContactPoint contact = of_rim(a, end, pbd::on_line(a.cap(end), 0, b.cap(end_b), end_b * b.axis, 0));
  contact.rim_b = b.radius;
  return next_to(on_rim, contact);
}

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
  const auto key = writer.key(feature, i, Feature::rim, at.end + 1);
  if (radius > 0)
    writer.exchanged().write(rim_on_point(b, at.end, y, radius), key, gap);
  else  // a distance of points has no sign
    writer.write(on_face(y, 0, at.nearest, at.normal, 0), key, gap);
}

ContactPoint on_plane_by_rim(const PlacedCylinder& a, int end, const Vec3& on_plane, const Vec3& normal,
                             double radius_b) {
  return of_rim(a, end, on_face(a.cap(end), 0, on_plane, normal, radius_b));
}

void write_deepest_rim(const PlacedCylinder& a, const Vec3& on_plane, const Vec3& normal, Feature feature,
                       int j, const ContactWriter& writer) {
  const int end = a.axis.dot(normal) > 0 ? -1 : 1;
  const ContactPoint contact = on_plane_by_rim(a, end, on_plane, normal, 0);
  writer.write(contact, writer.key(Feature::rim, rim_point(end, rim_points), feature, j),
               touching(contact, {}, {}).gap);
}

}  // namespace pbd
