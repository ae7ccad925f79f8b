#include "collision/surface_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pbd {
namespace {

template <class T>
void keep_each_once(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// The contact on the side on which x is, if it is near enough.
std::optional<PassedContact> near_by(SurfaceContact contact, const Points& x, const SurfaceReach& reach) {
  const auto& [a, b, c, d] = contact.node;
  if (contact.kind == SurfaceContact::Kind::edge_edge && !crossed(x.col(b) - x.col(a), x.col(d) - x.col(c)))
    return std::nullopt;
  SurfaceTouching found = touching(contact, x);
  if (found.gap + contact.thickness < 0) {
    contact.side = -1;
    found = touching(contact, x);
  }
  if (!(found.gap < reach.of(contact.node) && on_features(found, contact.kind, between_features)))
    return std::nullopt;
  return PassedContact{contact};
}

}  // namespace

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

/// Of a node and an edge, if there is a triangle about that which the node may touch.
std::optional<SurfaceContact> SurfaceSearch::of_edge(const Point& point, int edge) const {
  const auto& [c, d] = edges_[static_cast<std::size_t>(edge)];
  const auto others = across(edge);
  if (std::none_of(others.begin(), others.end(), [&, c = c, d = d](int third) {
        return point.touches({c, d, third});
      }))
    return std::nullopt;
  SurfaceContact contact = point.contact(SurfaceContact::Kind::node_edge, half_);
  contact.node = {point.node, point.node, c, d};
  return contact;
}

/// A node that is nearest to an edge, within the thickness and what they move by (m).
std::optional<SurfaceSearch::Beside> SurfaceSearch::beside(const Point& point, int edge, const Points& x,
                                                           double moved) const {
  auto contact = of_edge(point, edge);
  if (!contact) return std::nullopt;
  const SurfaceTouching found = touching(*contact, x);
  if (found.gap >= moved || !away_from(*contact, edge, found, x, moved)) return std::nullopt;
  contact->toward = found.normal;
  const int end = end_of(*contact, found);
  if (end < 0) return Beside{*contact};
  return Beside{*contact, {std::min(point.node, end), std::max(point.node, end)}};
}

/// m, that the nodes go from one place to another on average: this brings no two of them nearer.
Vec3 SurfaceSearch::course(const Points& from, const Points& to) const {
  Vec3 sum = Vec3::Zero();
  for (const int node : nodes_) sum += to.col(node) - from.col(node);
  return sum / static_cast<double>(nodes_.size());
}

/// m, of the node that goes farthest beside that; infinite if one is not finite.
double SurfaceSearch::farthest_beside_course(const Points& from, const Points& to) const {
  const Vec3 shared = course(from, to);
  if (!shared.allFinite()) return infinity;
  double most = 0;
  for (const int node : nodes_) most = std::max(most, (to.col(node) - from.col(node) - shared).squaredNorm());
  return std::sqrt(most);
}

/// m, from where it was last looked; infinite if it never was.
double SurfaceSearch::moved_since_clear(const Points& x) const {
  return clear_at_.cols() == x.cols() ? farthest_beside_course(clear_at_, x) : infinity;
}

bool SurfaceSearch::stays_clear(const Points& x, const Points& to) const {
  return !searches() ||
         (clear_gap_ > 0 && clear_gap_ > 2 * (moved_since_clear(x) + farthest_beside_course(x, to)));
}

/// A node is not looked at beside its own triangle, but beside the one across that one's far side, which is
/// as far as its height: half of the least height leaves a regular sheet clear, with room for its strains.
void SurfaceSearch::look_for_clearance(int threads, const Points& x) {
  double height = infinity;
  for (const auto& [a, b, c] : triangles_) {
    const Vec3 u = x.col(b) - x.col(a), v = x.col(c) - x.col(a);
    height = std::min(height, u.cross(v).norm() / std::max({u.norm(), v.norm(), (v - u).norm()}));
  }
  clear_at_ = x;
  clear_gap_ = 0;
  looked_ = height / 2 - 2 * half_;
  if (!(looked_ > 0 && looked_ < infinity)) return;
  const auto around = [&](const auto& nodes, double margin) {
    AxisBox box;
    for (const int node : nodes) box.extend(Vec3(x.col(node)));
    const Vec3 reach = Vec3::Constant(margin + looked_ / 2);
    return AxisBox(box.min() - reach, box.max() + reach);
  };
  std::atomic<bool> near = false;  // then nothing more is looked at
  const auto see = [&](const SurfaceTouching& found) {
    if (!(found.gap >= looked_)) near = true;
  };
  search(
      threads, around,
      [&](const SurfaceContact& contact) -> std::optional<PassedContact> {
        if (!near) see(nearest_touching(contact, places(contact, x)));
        return std::nullopt;
      },
      [&](const Point& point, int edge) -> std::optional<Beside> {
        if (near) return std::nullopt;
        if (const auto contact = of_edge(point, edge)) see(touching(*contact, x));
        return std::nullopt;
      });
  if (!near) clear_gap_ = (1 - way_rounding) * looked_;
}

/// Brings together what the tasks found. Two nodes touch once, whichever edges end there.
void SurfaceSearch::gather() {
  met_.clear();
  beside_.clear();
  ends_.clear();
  for (const Task& task : tasks_) met_.insert(met_.end(), task.on_triangles.begin(), task.on_triangles.end());
  for (const Task& task : tasks_) met_.insert(met_.end(), task.on_edges.begin(), task.on_edges.end());
  for (const Task& task : tasks_) beside_.insert(beside_.end(), task.beside.begin(), task.beside.end());
  for (std::size_t i = 0; i < beside_.size(); ++i)
    if (beside_[i].ends[0] >= 0) ends_.emplace_back(beside_[i].ends, i);
  std::sort(ends_.begin(), ends_.end());
  for (std::size_t k = 1; k < ends_.size(); ++k)
    if (ends_[k].first == ends_[k - 1].first) beside_[ends_[k].second].again = true;
  std::erase_if(beside_, [](const Beside& each) { return each.again; });
}

void SurfaceSearch::find(int threads, const Points& x, const SurfaceReach& reach,
                         std::vector<SurfaceContact>& out) {
  if (!searches()) return;
  const double moved = moved_since_clear(x);
  if (clear_gap_ > 2 * moved + reach.most()) return;
  constexpr double worth = 0.25;  // of what was looked up to: what was near before that moves on by as much
  if (!found_ && moved > worth * looked_) {
    look_for_clearance(threads, x);
    if (clear_gap_ > reach.most()) return;
  }
  search(
      threads, [&](const auto& nodes, double margin) { return reach.box(nodes, x, margin); },
      [&](const SurfaceContact& contact) { return near_by(contact, x, reach); },
      [&](const Point& point, int edge) {
        const auto& [c, d] = edges_[static_cast<std::size_t>(edge)];
        return beside(point, edge, x, reach.of({point.node, point.node, c, d}));
      });
  for (const PassedContact& each : met_) out.push_back(each.contact);
  for (const Beside& each : beside_) out.push_back(each.contact);
  found_ = !met_.empty() || !beside_.empty();
}

}  // namespace pbd
