#include "collision/surface_contact.h"

#include <algorithm>

#include "collision/segments.h"

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

/// Of fixed normal and weights, where these met.
SurfaceTouching as_met(const SurfaceContact& contact, const NodePlaces& x) {
  SurfaceTouching found;
  found.normal = contact.toward;
  Vec3 apart = Vec3::Zero();
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double weight = (*contact.met)[k];
    found.weight[static_cast<Eigen::Index>(k)] = weight;
    apart += weight * x[k];
    found.point += std::max(weight, 0.0) * x[k];
  }
  found.gap = found.normal.dot(apart) - contact.thickness;
  return found;
}

struct NearestPoints {
  Vec3 apart;   // from the second one to the first, m
  double s, t;  // shares of the ways from i to j and from k to l
};

NearestPoints nearest_points(const NodePlaces& x, std::size_t i, std::size_t j, std::size_t k,
                             std::size_t l) {
  const Vec3 first = x[j] - x[i], second = x[l] - x[k];
  const double one = first.norm(), two = second.norm();
  const Vec3 along = one > 0 ? Vec3(first / one) : Vec3::Zero(),
             other = two > 0 ? Vec3(second / two) : Vec3::Zero();
  const Nearest found = nearest({x[i], along, one}, {x[k], other, two});
  return {found.apart, one > 0 ? found.s / one : 0, two > 0 ? found.t / two : 0};
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
  if (contact.met) return as_met(contact, x);
  if (contact.kind == SurfaceContact::Kind::node_edge) return node_edge(contact, x);
  return contact.kind == SurfaceContact::Kind::edge_edge ? edge_edge(contact, x) : node_triangle(contact, x);
}

SurfaceTouching nearest_touching(const SurfaceContact& contact, const NodePlaces& x) {
  SurfaceTouching found;
  if (contact.kind == SurfaceContact::Kind::node_triangle) {
    found = node_triangle(contact, x);
    if (on_features(found, contact.kind)) {
      found.normal = found.gap + contact.thickness < 0 ? Vec3(-found.normal) : found.normal;
      found.gap = std::abs(found.gap + contact.thickness) - contact.thickness;
      return found;
    }
  }
  double least = infinity;
  const auto take = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    const NearestPoints points = nearest_points(x, i, j, k, l);
    const double distance = points.apart.norm();
    if (!(distance < least)) return;
    least = distance;
    found = {distance - contact.thickness, points.apart.normalized()};
    found.weight[static_cast<Eigen::Index>(i)] += 1 - points.s;
    found.weight[static_cast<Eigen::Index>(j)] += points.s;
    found.weight[static_cast<Eigen::Index>(k)] += points.t - 1;
    found.weight[static_cast<Eigen::Index>(l)] -= points.t;
    found.point = x[i] + points.s * (x[j] - x[i]);
  };
  if (contact.kind == SurfaceContact::Kind::node_triangle)
    take(0, 0, 1, 2), take(0, 0, 2, 3), take(0, 0, 3, 1);
  else
    take(0, 1, 2, 3);
  return found;
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
