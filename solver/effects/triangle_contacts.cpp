#include <algorithm>

#include "effects/contact_search.h"

namespace pbd {

std::array<Vec3, 3> ContactSearch::corners(const Motion& motion, const Points& x) const {
  const auto& [a, b, c] = effect_.triangle[motion.carrier];
  return {x.col(a), x.col(b), x.col(c)};
}

AxisBox ContactSearch::box_of(const Motion& motion, const Points& x) const {
  if (motion.kind != Carrier::triangle) return bounds_of(*motion.shape, motion.frame);
  AxisBox box;
  for (const Vec3& corner : corners(motion, x)) box.extend(corner);
  const Vec3 rounded = Vec3::Constant(points_.triangle.radius);
  return {box.min() - rounded, box.max() + rounded};
}

void ContactSearch::place_triangle(const Points& x, const std::vector<double>& inverse_mass,
                                   Motion& motion) const {
  const auto [a, b, c] = corners(motion, x);
  motion.centre = (a + b + c) / 3;
  motion.radius = points_.triangle.radius +
                  std::sqrt(std::max({(a - motion.centre).squaredNorm(), (b - motion.centre).squaredNorm(),
                                      (c - motion.centre).squaredNorm()}));
  motion.height = (b - a).cross(c - a).norm() / std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
  motion.moves = false;
  for (const int node : effect_.triangle[motion.carrier])
    motion.moves = motion.moves || inverse_mass[node] > 0;
}

/// A node that goes by d against the others turns the triangle by at most d over its height.
Displacement ContactSearch::triangle_displacement(const Motion& motion, const Points& from,
                                                  const Points& to) const {
  const auto before = corners(motion, from), after = corners(motion, to);
  Displacement moved{0, 0};
  double apart = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 shift = after[k] - before[k], next = after[(k + 1) % 3] - before[(k + 1) % 3];
    moved.shift = std::max(moved.shift, (shift - motion.course).norm());
    apart = std::max(apart, (shift - next).norm());
  }
  if (apart > 0) moved.turn = motion.height > 0 ? apart / motion.height : infinity;
  return moved;
}

/// Numbers nodes and edges through the scene, and faces through the effect, so that a feature that triangles
/// share has one name.
void ContactSearch::name_by_scene(const Motion& triangle, ActiveContact& contact) const {
  const auto& nodes = effect_.triangle[triangle.carrier];
  FeatureName own = first_of(contact.features.key);
  if (own.of == Feature::node)
    own.i = nodes[static_cast<std::size_t>(own.i)];
  else if (own.of == Feature::edge)
    own.i = surfaces_->edge(nodes[static_cast<std::size_t>(own.i)],
                            nodes[static_cast<std::size_t>((own.i + 1) % 3)]);
  else
    own.i += 2 * triangle.carrier;
  contact.features.key = key_of(own, second_of(contact.features.key));
}

/// False of an edge or a node from which the surface rises towards the body: that is nearer to a triangle
/// beside it. Its normal would follow the body about the edge, whose triangles have planes of their own. Not
/// so that of two edges that cross: what rises by no more than both turn in the step may come to fall.
bool ContactSearch::nearest_of_surface(const ActiveContact& contact, const Configuration& at) const {
  if (contact.features.kind == ContactPoint::Kind::face) return true;
  double level = 1e-9;  // sine: what is over an edge but for rounding is over none of its triangles
  if (contact.features.kind == ContactPoint::Kind::edges)
    for (const int collider : contact.collider) level += motions_[static_cast<std::size_t>(collider)].turn;
  const FeatureName own = first_of(contact.features.key);
  const Vec3 normal = touching_at(contact, at).normal,
             away = contact.triangle_side == 0 ? Vec3(-normal) : normal;
  const auto level_or_below = [&](const Vec3& to) { return away.dot(to) <= level * to.norm(); };
  if (own.of == Feature::node) {
    const auto others = surfaces_->neighbours(own.i);
    return std::all_of(others.begin(), others.end(),
                       [&](int node) { return level_or_below(at.x.col(node) - at.x.col(own.i)); });
  }
  if (own.of != Feature::edge) return true;
  const auto& [first, second] = surfaces_->ends(own.i);
  const Vec3 from = at.x.col(first), along = (at.x.col(second) - from).normalized();
  const auto others = surfaces_->across(own.i);
  return std::all_of(others.begin(), others.end(), [&](int node) {
    const Vec3 to = at.x.col(node) - from;
    return level_or_below(to - along.dot(to) * along);
  });
}

/// The first triangle's contact of those with one name.
void ContactSearch::keep_each_once(std::vector<ActiveContact>& contacts) {
  names_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::array<int, 2> pair = contacts[i].pair();  // the body first
    names_.push_back({pair[0], contacts[i].features.key, !contacts[i].late && !contacts[i].restated, i});
  }
  std::sort(names_.begin(), names_.end());
  const auto again = [](const TriangleName& one, const TriangleName& two) {
    return one.body == two.body && one.key == two.key;
  };
  names_.erase(std::unique(names_.begin(), names_.end(), again), names_.end());
  if (names_.size() == contacts.size()) return;
  std::sort(names_.begin(), names_.end(),
            [](const TriangleName& one, const TriangleName& two) { return one.i < two.i; });
  for (std::size_t k = 0; k < names_.size(); ++k) contacts[k] = contacts[names_[k].i];
  contacts.resize(names_.size());
}

}  // namespace pbd
