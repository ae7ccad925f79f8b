#include "collision/surface_contact.h"

#include <algorithm>

namespace pbd {
namespace {

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : otherwise;
}

SurfaceTouching node_triangle(const SurfaceContact& contact, const NodePlaces& x) {
  const Vec3 u = x[2] - x[1], v = x[3] - x[1], from = x[0] - x[1];
  const Vec3 across = u.cross(v);
  SurfaceTouching found;
  found.normal = contact.side * unit_or(across, Vec3::UnitZ());
  const double squared = across.squaredNorm();
  const double b2 = squared > 0 ? from.cross(v).dot(across) / squared : 0.0;
  const double b3 = squared > 0 ? u.cross(from).dot(across) / squared : 0.0;
  found.weight = {1, b2 + b3 - 1, -b2, -b3};
  found.gap = found.normal.dot(from) - contact.thickness;
  found.point = x[0];
  return found;
}

SurfaceTouching edge_edge(const SurfaceContact& contact, const NodePlaces& x) {
  const Vec3 e = x[1] - x[0], f = x[3] - x[2], apart = x[2] - x[0];
  const Vec3 across = e.cross(f);
  const double squared = across.squaredNorm();
  SurfaceTouching found;
  const bool crossing = crossed(e, f);
  found.normal = contact.side * (crossing ? Vec3(across.normalized()) : e.unitOrthogonal());
  const double s = crossing ? apart.cross(f).dot(across) / squared : 0.5;
  const double t = crossing ? apart.cross(e).dot(across) / squared : 0.5;
  found.weight = {1 - s, s, t - 1, -t};
  found.gap = -found.normal.dot(apart) - contact.thickness;
  found.point = x[0] + s * e;
  return found;
}

SurfaceTouching node_edge(const SurfaceContact& contact, const NodePlaces& x) {
  const Vec3 from = x[0] - x[2], f = x[3] - x[2];
  const double squared = f.squaredNorm(), t = squared > 0 ? std::clamp(from.dot(f) / squared, 0.0, 1.0)
                                              : contact.of_spheres() ? 0.0
                                                                     : 0.5;
  const Vec3 apart = from - t * f;
  SurfaceTouching found;
  found.normal = unit_or(apart, contact.toward);
  found.weight = {1, 0, t - 1, -t};
  found.gap = apart.norm() - contact.thickness;
  found.point = x[0];
  return found;
}

}  // namespace

NodePlaces places(const SurfaceContact& contact, const Points& x) {
  const auto& [a, b, c, d] = contact.node;
  return {x.col(a), x.col(b), x.col(c), x.col(d)};
}

SurfaceTouching touching(const SurfaceContact& contact, const Points& x) {
  return touching(contact, places(contact, x));
}

SurfaceTouching touching(const SurfaceContact& contact, const NodePlaces& x) {
  if (contact.kind == SurfaceContact::Kind::node_edge) return node_edge(contact, x);
  return contact.kind == SurfaceContact::Kind::edge_edge ? edge_edge(contact, x) : node_triangle(contact, x);
}

bool crossed(const Vec3& e, const Vec3& f) {
  constexpr double least_sine = 1e-10;
  return e.cross(f).squaredNorm() > least_sine * least_sine * e.squaredNorm() * f.squaredNorm();
}

bool on_features(const SurfaceTouching& touching, SurfaceContact::Kind kind, double beside) {
  const auto& w = touching.weight;
  const bool first =
      kind == SurfaceContact::Kind::node_triangle ? w[1] <= beside : w[0] >= -beside && w[1] >= -beside;
  return first && w[2] <= beside && w[3] <= beside;
}

}  // namespace pbd
