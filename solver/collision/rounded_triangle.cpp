#include "collision/rounded_triangle.h"

namespace pbd {
namespace {

/// Twice the area along the normal (m^2).
Vec3 area_vector(const Points& x, const std::array<int, 3>& node) {
  const Vec3 first = x.col(node[0]);
  return (x.col(node[1]) - first).cross(x.col(node[2]) - first);
}

/// The unit normal, or where there is no area a unit vector across the first edge.
Vec3 normal_of(const Vec3& area, const Vec3& edge) {
  const double length = area.norm();
  return length > 0 ? Vec3(area / length) : edge.unitOrthogonal();
}

/// Barycentric coordinates of what is nearest on the plane; of a triangle without area a third each.
Vec3 barycentric(const Vec3& u, const Vec3& v, const Vec3& from) {
  const Vec3 area = u.cross(v);
  const double squared = area.squaredNorm();
  if (!(squared > 0)) return Vec3::Constant(1.0 / 3);
  const double second = from.cross(v).dot(area) / squared, third = u.cross(from).dot(area) / squared;
  return {1 - second - third, second, third};
}

}  // namespace

RoundedTriangle::RoundedTriangle() {
  solid.x.resize(3, 3);
  solid.faces = {{Vec3::UnitZ(), 0, 0, 3}, {-Vec3::UnitZ(), 0, 3, 3}};
  solid.corners = {0, 1, 2, 0, 2, 1};
  solid.sides = {0, 1, 2, 2, 1, 0};
  solid.edges = {{{0, 1}, {0, 1}}, {{1, 2}, {0, 1}}, {{2, 0}, {0, 1}}};
}

void RoundedTriangle::place(const std::array<Vec3, 3>& corner) {
  for (int k = 0; k < 3; ++k) solid.x.col(k) = corner[static_cast<std::size_t>(k)];
  const Vec3 normal = normal_of(area_vector(solid.x, {0, 1, 2}), corner[1] - corner[0]);
  const double offset = normal.dot(corner[0]);
  solid.faces[0].normal = normal;
  solid.faces[0].offset = offset;
  solid.faces[1].normal = -normal;
  solid.faces[1].offset = -offset;
}

TriangleFeature feature_of(const ContactPoint& contact, int side, const RoundedTriangle& triangle,
                           const std::array<int, 3>& node) {
  using Kind = ContactPoint::Kind;
  const Points& x = triangle.solid.x;
  TriangleFeature feature;
  feature.node = node;
  const bool lines_b = contact.kind == Kind::line || contact.kind == Kind::rim;
  const bool line = contact.kind == Kind::edges || (lines_b && side == 1);
  if (contact.kind == Kind::face && side == 1) {
    feature.kind = TriangleFeature::Kind::plane;
    feature.side = contact.direction_b.dot(triangle.solid.faces[0].normal) < 0 ? -1 : 1;
  } else if (line) {
    feature.kind = TriangleFeature::Kind::edge;
    feature.ends = triangle.solid.edges[first_of(contact.key).i].node;
  } else {
    feature.kind = TriangleFeature::Kind::point;
    const Vec3& point = side == 0 ? contact.point_a : contact.point_b;
    feature.weight = barycentric(x.col(1) - x.col(0), x.col(2) - x.col(0), point - x.col(0));
    const FeatureName name = first_of(contact.key);
    if (name.of == Feature::node) feature.weight = Vec3::Unit(name.i);
  }
  return feature;
}

void follow(const TriangleFeature& feature, const Points& x, int side, ContactPoint& contact) {
  Vec3& point = side == 0 ? contact.point_a : contact.point_b;
  Vec3& direction = side == 0 ? contact.direction_a : contact.direction_b;
  const auto at = [&](int k) { return x.col(feature.node[static_cast<std::size_t>(k)]); };
  switch (feature.kind) {
    case TriangleFeature::Kind::point:
      point = feature.weight[0] * at(0) + feature.weight[1] * at(1) + feature.weight[2] * at(2);
      break;
    case TriangleFeature::Kind::edge:
      point = at(feature.ends[0]);
      direction = (at(feature.ends[1]) - point).normalized();
      break;
    case TriangleFeature::Kind::plane:
      point = at(0);
      direction = feature.side * normal_of(area_vector(x, feature.node), at(1) - at(0));
      break;
  }
}

Vec3 weights_at(const TriangleFeature& feature, const Points& x, const Vec3& place) {
  if (feature.kind == TriangleFeature::Kind::point) return feature.weight;
  const auto at = [&](int k) { return x.col(feature.node[static_cast<std::size_t>(k)]); };
  if (feature.kind == TriangleFeature::Kind::plane)
    return barycentric(at(1) - at(0), at(2) - at(0), place - at(0));
  const Vec3 from = at(feature.ends[0]), whole = at(feature.ends[1]) - from;
  const double squared = whole.squaredNorm(), along = squared > 0 ? whole.dot(place - from) / squared : 0.5;
  Vec3 weights = Vec3::Zero();
  weights[feature.ends[0]] = 1 - along;
  weights[feature.ends[1]] = along;
  return weights;
}

}  // namespace pbd
