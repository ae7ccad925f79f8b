#include "collision/surface_contact.h"

#include <algorithm>

namespace pbd {
namespace {

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : otherwise;
}

SurfaceTouching node_triangle(const SurfaceContact& contact, const Points& x) {
  const auto at = [&](std::size_t k) -> Vec3 { return x.col(contact.node[k]); };
  const Vec3 u = at(2) - at(1), v = at(3) - at(1), from = at(0) - at(1);
  const Vec3 across = u.cross(v);
  SurfaceTouching found;
  found.normal = contact.side * unit_or(across, Vec3::UnitZ());
  const double squared = across.squaredNorm();
  const double b2 = squared > 0 ? from.cross(v).dot(across) / squared : 0.0;
  const double b3 = squared > 0 ? u.cross(from).dot(across) / squared : 0.0;
  found.weight = {1, b2 + b3 - 1, -b2, -b3};
  found.gap = found.normal.dot(from) - contact.thickness;
  found.point = at(0);
  return found;
}

SurfaceTouching edge_edge(const SurfaceContact& contact, const Points& x) {
  const auto at = [&](std::size_t k) -> Vec3 { return x.col(contact.node[k]); };
  const Vec3 e = at(1) - at(0), f = at(3) - at(2), apart = at(2) - at(0);
  const Vec3 across = e.cross(f);
  const double squared = across.squaredNorm();
  SurfaceTouching found;
  const bool crossing = crossed(e, f);
  found.normal = contact.side * (crossing ? Vec3(across.normalized()) : e.unitOrthogonal());
  const double s = crossing ? apart.cross(f).dot(across) / squared : 0.5;
  const double t = crossing ? apart.cross(e).dot(across) / squared : 0.5;
  found.weight = {1 - s, s, t - 1, -t};
  found.gap = -found.normal.dot(apart) - contact.thickness;
  found.point = at(0) + s * e;
  return found;
}

SurfaceTouching node_edge(const SurfaceContact& contact, const Points& x) {
  const Vec3 from = x.col(contact.node[0]) - x.col(contact.node[2]),
             f = x.col(contact.node[3]) - x.col(contact.node[2]);
  const double squared = f.squaredNorm(), t = squared > 0 ? std::clamp(from.dot(f) / squared, 0.0, 1.0)
                                              : contact.of_spheres() ? 0.0
                                                                     : 0.5;
  const Vec3 apart = from - t * f;
  SurfaceTouching found;
  found.normal = unit_or(apart, contact.toward);
  found.weight = {1, 0, t - 1, -t};
  found.gap = apart.norm() - contact.thickness;
  found.point = x.col(contact.node[0]);
  return found;
}

template <class T>
void keep_each_once(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

template <std::size_t K>
AxisBox box_of(const std::array<int, K>& nodes, const Points& x, const std::vector<double>& reach,
               double margin) {
  AxisBox box;
  for (const int node : nodes) {
    const Vec3 slack = Vec3::Constant(reach[node] + margin);
    box.extend(Vec3(x.col(node) - slack)).extend(Vec3(x.col(node) + slack));
  }
  return box;
}

/// The contact on the side on which x is, if it is near enough.
void add(SurfaceContact contact, const Points& x, const std::vector<double>& reach,
         std::vector<SurfaceContact>& out) {
  double most = 0;
  for (const int node : contact.node) most = std::max(most, reach[node]);
  SurfaceTouching found = touching(contact, x);
  if (found.gap + contact.thickness < 0) contact.side = -1;
  found = touching(contact, x);
  if (found.gap < 2 * most && on_features(found, contact.kind, between_features)) out.push_back(contact);
}

}  // namespace

SurfaceTouching touching(const SurfaceContact& contact, const Points& x) {
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

SurfaceSearch::SurfaceSearch(const std::vector<std::array<int, 3>>& triangles, double thickness, bool touch,
                             const std::vector<NodeSphere>& spheres)
    : triangles_(triangles), half_(thickness / 2), touch_(touch) {
  for (const auto& [a, b, c] : triangles) {
    nodes_.insert(nodes_.end(), {a, b, c});
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      edges_.push_back({std::min(from, to), std::max(from, to)});
  }
  keep_each_once(nodes_);
  keep_each_once(edges_);
  if (touch)
    for (const int node : nodes_) points_.push_back({{node}, half_});
  for (const NodeSphere& sphere : spheres) {
    points_.push_back({sphere, sphere.radius});
    nodes_.push_back(sphere.node);
  }
  std::vector<std::array<int, 2>> across, neighbours;
  for (const auto& nodes : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      across.push_back({edge(nodes[k], nodes[(k + 1) % 3]), nodes[(k + 2) % 3]});
  for (const auto& [a, b] : edges_) neighbours.insert(neighbours.end(), {{a, b}, {b, a}});
  across_ = Lists(std::move(across));
  neighbours_ = Lists(std::move(neighbours));
}

bool SurfaceSearch::Point::touches(const std::array<int, 3>& triangle) const {
  return std::none_of(triangle.begin(), triangle.end(), [&](int other) {
    return other == node || std::binary_search(kept.begin(), kept.end(), other);
  });
}

SurfaceContact SurfaceSearch::Point::contact(SurfaceContact::Kind kind, double half_thickness) const {
  return {.kind = kind, .thickness = half_thickness + margin, .radius = radius};
}

SurfaceSearch::Lists::Lists(std::vector<std::array<int, 2>> pairs) {
  keep_each_once(pairs);
  first.push_back(0);
  for (const auto& [list, entry] : pairs) {
    first.resize(static_cast<std::size_t>(list) + 1, static_cast<int>(all.size()));
    all.push_back(entry);
  }
  first.push_back(static_cast<int>(all.size()));
}

int SurfaceSearch::edge(int from, int to) const {
  const std::array<int, 2> ends{std::min(from, to), std::max(from, to)};
  return static_cast<int>(std::lower_bound(edges_.begin(), edges_.end(), ends) - edges_.begin());
}

void SurfaceSearch::find_nodes(const Points& x, const std::vector<double>& reach,
                               std::vector<SurfaceContact>& out) {
  each_node_and_triangle([&](const auto& nodes, double margin) { return box_of(nodes, x, reach, margin); },
                         [&](const Point& point, const auto& nodes) {
                           SurfaceContact contact = point.contact(SurfaceContact::Kind::node_triangle, half_);
                           contact.node = nodes;
                           add(contact, x, reach, out);
                         });
}

void SurfaceSearch::find_edges(const Points& x, const std::vector<double>& reach,
                               std::vector<SurfaceContact>& out) {
  each_pair_of_edges([&](const auto& nodes, double margin) { return box_of(nodes, x, reach, margin); },
                     [&](const auto& nodes) {
                       const auto& [a, b, c, d] = nodes;
                       if (!crossed(x.col(b) - x.col(a), x.col(d) - x.col(c))) return;
                       add({.node = nodes, .kind = SurfaceContact::Kind::edge_edge, .thickness = 2 * half_},
                           x, reach, out);
                     });
}

/// True if an edge's triangles and a node's neighbours lie away from each other along n, or may when they
/// have moved by as much (m): else something of these is nearer. Triangles that are level have the node over
/// them.
bool SurfaceSearch::away_from(const SurfaceContact& contact, int edge, const SurfaceTouching& touching,
                              const Points& x, double moved) const {
  constexpr double level = 1e-9, rounding = 1e-6;  // rad
  const Vec3 from = touching.point - (touching.gap + contact.thickness) * touching.normal;
  const auto beyond = [&](int other) {
    const Vec3 to = x.col(other) - from;
    return to.dot(touching.normal) < -level * to.norm();
  };
  const auto farther = [&](int other) {
    const Vec3 to = x.col(other) - touching.point;
    return to.dot(touching.normal) >= -rounding * to.norm() - moved;
  };
  const auto triangles = across(edge), others = neighbours(contact.node[0]);
  return std::all_of(triangles.begin(), triangles.end(), beyond) &&
         std::all_of(others.begin(), others.end(), farther);
}

/// The end that a node's nearest point of an edge is, but for a thousandth of it; -1 if it is between them.
int SurfaceSearch::end_of(const SurfaceContact& contact, const SurfaceTouching& touching) {
  constexpr double close = 1e-3;
  if (-touching.weight[2] >= 1 - close) return contact.node[2];
  return -touching.weight[3] >= 1 - close ? contact.node[3] : -1;
}

/// A node that is nearest to an edge, within the thickness and what they move by (m). Two nodes touch once,
/// whichever edges end there.
std::optional<SurfaceContact> SurfaceSearch::beside(const Point& point, int edge, const Points& x,
                                                    double moved) {
  const int node = point.node;
  const auto& [c, d] = edges_[static_cast<std::size_t>(edge)];
  const auto others = across(edge);
  if (std::none_of(others.begin(), others.end(), [&, c = c, d = d](int third) {
        return point.touches({c, d, third});
      }))
    return std::nullopt;
  SurfaceContact contact = point.contact(SurfaceContact::Kind::node_edge, half_);
  contact.node = {node, node, c, d};
  const SurfaceTouching found = touching(contact, x);
  if (found.gap >= moved || !away_from(contact, edge, found, x, moved)) return std::nullopt;
  if (const int end = end_of(contact, found); end >= 0) {
    const std::array<int, 2> nodes{std::min(node, end), std::max(node, end)};
    if (std::find(ends_.begin(), ends_.end(), nodes) != ends_.end()) return std::nullopt;
    ends_.push_back(nodes);
  }
  contact.toward = found.normal;
  return contact;
}

void SurfaceSearch::find_nodes_beside(const Points& x, const std::vector<double>& reach,
                                      std::vector<SurfaceContact>& out) {
  each_node_and_edge([&](const auto& nodes, double margin) { return box_of(nodes, x, reach, margin); },
                     [&](const Point& point, int edge) {
                       const auto& [c, d] = edges_[static_cast<std::size_t>(edge)];
                       const double moved = 2 * std::max({reach[point.node], reach[c], reach[d]});
                       if (const auto found = beside(point, edge, x, moved)) out.push_back(*found);
                     });
}

void SurfaceSearch::find(const Points& x, const std::vector<double>& reach,
                         std::vector<SurfaceContact>& out) {
  if (!searches()) return;
  find_nodes(x, reach, out);
  find_edges(x, reach, out);
  find_nodes_beside(x, reach, out);
}

}  // namespace pbd
