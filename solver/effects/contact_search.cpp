#include "effects/contact_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "threads/threads.h"

namespace pbd {
ContactSearch::ContactSearch(const Scene& scene, const Contact& effect)
    : effect_(effect),
      allowed_(scene, effect),
      clearance_(effect),
      motions_(effect.collider.size() + effect.node.size() +
               (effect.collider.empty() ? 0 : effect.triangle.size())) {
  points_.triangle.radius = effect.thickness / 2;
  if (!effect.triangle.empty()) {
    side_.assign(static_cast<std::size_t>(scene.nodes()), -1);
    const auto number = [&](int node) -> int& { return side_[static_cast<std::size_t>(node)]; };
    auto side = static_cast<int>(effect.collider.size());
    for (const int node : effect.node) number(node) = side++;
    for (const auto& triangle : effect.triangle) {
      for (const int node : triangle) number(node) = side;
      ++side;
    }
    std::vector<NodeSphere> spheres;
    for (std::size_t i = 0; i < effect.node.size(); ++i)
      if (const int node = effect.node[i]; number(node) < first_triangle())
        spheres.push_back({node, effect.radius[i], allowed_.linked_to(node)});
    surfaces_.emplace(effect.triangle, effect.thickness, effect.surfaces_touch, spheres);
    surface_reach_ = SurfaceReach(effect.triangle, surfaces_->nodes());
  }
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    Motion& motion = motions_[k];
    if (k >= effect.collider.size() + effect.node.size()) {
      motion.kind = Carrier::triangle;
      motion.carrier = static_cast<int>(k - effect.collider.size() - effect.node.size());
      continue;
    }
    if (k >= effect.collider.size()) {
      const std::size_t node = k - effect.collider.size();
      motion.kind = Carrier::node;
      motion.node_shape = Sphere{effect.radius[node]};
      motion.carrier = effect.node[node];
      motion.radius = effect.radius[node];
      continue;
    }
    const Collider& collider = effect.collider[k];
    motion.carrier = collider.body;
    motion.radius = farthest_point(collider);
    motion.round = round_radius(collider.shape);
  }
}

ActiveContact ContactSearch::of_surfaces(const SurfaceContact& found, Eigen::Index nodes) const {
  const auto side = [&](int node) { return static_cast<std::size_t>(side_[static_cast<std::size_t>(node)]); };
  ActiveContact contact;
  contact.of_surfaces = true;
  contact.carrier = {-1, -1};
  contact.features.point_a = contact.features.point_b = Vec3::Zero();
  contact.surface = found;
  contact.between_surfaces = side_[static_cast<std::size_t>(found.node[0])] >= first_triangle();
  contact.law = effect_.between(side(found.node[0]), side(found.node[3]));
  const bool triangle = found.kind == SurfaceContact::Kind::node_triangle;
  contact.collider = {found.node[0], found.node[triangle ? 1 : 2]};
  const auto number = [](int node) { return static_cast<std::uint64_t>(node); };
  const std::uint64_t rest = number(found.node[triangle ? 2 : 3]),
                      other = number(found.node[triangle ? 3 : 1]);
  contact.features.key =
      3 * (rest + static_cast<std::uint64_t>(nodes) * other) + static_cast<std::uint64_t>(found.kind);
  return contact;
}

void ContactSearch::add_surfaces(Eigen::Index nodes, ContactLists& contacts) {
  const auto add = [&](const ActiveContact& contact) {
    contacts[contact.law.friction > 0 ? surfaces_rough : surfaces_smooth].push_back(contact);
  };
  for (const SurfaceContact& found : surface_contacts_) {
    if (is_left(found)) continue;
    ActiveContact contact = of_surfaces(found, nodes);
    if (contact.law.restitution == 0) contact.apart = near * surface_reach_.of(found.node);
    add(contact);
  }
  std::erase_if(late_surfaces_, [&](const PassedContact& late) {  // near by now: it went farther
    return !is_left(late.contact) &&
           std::any_of(surface_contacts_.begin(), surface_contacts_.end(),
                       [&](const SurfaceContact& found) { return found.same_features(late.contact); });
  });
  for (const PassedContact& found : late_surfaces_) {
    ActiveContact contact = of_surfaces(found.contact, nodes);
    contact.late = true;
    contact.target = found.target;
    add(contact);
  }
}

int ContactSearch::side_of_surface(int node) const {
  const int side = side_[static_cast<std::size_t>(node)];
  return side < first_triangle() ? side : first_triangle() + node;
}

bool ContactSearch::may_touch(int first, int second) const {
  const int body = motions_[first].carrier;  // nodes and triangles stand behind bodies
  const Motion& two = motions_[second];
  if (motions_[first].kind == Carrier::node)
    return two.kind == Carrier::node && allowed_.nodes(body, two.carrier);
  if (two.kind == Carrier::body) return allowed_.bodies(body, two.carrier);
  if (two.kind == Carrier::node) return allowed_.node_and_body(two.carrier, body);
  const auto& nodes = effect_.triangle[two.carrier];
  return std::all_of(nodes.begin(), nodes.end(),
                     [&](int node) { return allowed_.node_and_body(node, body); });
}

ActiveContact ContactSearch::active(const ContactPoint& point, int first, int second,
                                    const RoundedTriangle& triangle) const {
  const std::array<int, 2> sides = point.swapped ? std::array{second, first} : std::array{first, second};
  const auto local = [&](int collider) {
    return motions_[collider].kind == Carrier::body ? effect_.collider[collider].frame : Frame{};
  };
  ActiveContact contact;
  contact.features = placed(point, local(sides[0]), local(sides[1]));
  contact.collider = sides;
  for (const int side : {0, 1}) {
    const Motion& own = motions_[sides[side]];
    contact.carrier[side] = own.carrier;
    if (own.kind == Carrier::node) contact.node_side = side;
    if (own.kind == Carrier::body && !effect_.collider[sides[side]].surface_velocity.isZero(0)) {
      const Collider& collider = effect_.collider[sides[side]];
      contact.surface_velocity[side] = collider.frame.rotation * collider.surface_velocity;
      contact.conveys = true;
    }
    if (own.kind != Carrier::triangle) continue;
    contact.triangle_side = side;
    contact.triangle = feature_of(point, side, triangle, effect_.triangle[own.carrier]);
    name_by_scene(own, contact);
  }
  contact.law = effect_.between(first, second);
  return contact;
}

/// The late contact of a pair's features, if there is one.
std::vector<ActiveContact>::iterator ContactSearch::late_contact(const PairFeatures& features) {
  return std::find_if(late_.begin(), late_.end(), [&](const ActiveContact& contact) {
    return contact.features.key == features.key && contact.pair() == features.collider;
  });
}

/// Of what is near, and what came to touch later, the contacts of a pair.
void ContactSearch::add_pair(const NearPair& pair, std::span<const ActiveContact> near,
                             ContactLists& contacts) {
  const Motion &one = motions_[pair.collider[0]], &two = motions_[pair.collider[1]];
  const auto add = [&](const ActiveContact& contact) {
    const std::size_t group = contact.of_surfaces         ? surfaces_rough
                              : two.kind == Carrier::body ? bodies_rough
                              : two.kind == Carrier::node ? nodes_rough
                                                          : triangles_rough;
    contacts[group + (contact.law.friction > 0 ? 0 : 1)].push_back(contact);
  };
  bool needless = false;
  for (const ActiveContact& contact : near) {
    needless |= contact.needless;
    if (contact.needless) continue;
    const PairFeatures features{pair.collider, contact.features.key};
    if (contact.meeting || (!is_left(features) && late_contact(features) == late_.end())) add(contact);
  }
  for (const ActiveContact& contact : late_)
    if (contact.pair() == pair.collider) add(contact);
  const double travel = travel_between(one, two);
  const bool bounded = std::isfinite(one.radius) && std::isfinite(two.radius);
  const double round = round_radius_of(one, two), deepest = std::min(pair.nearest, 0.0);
  const auto of_pair = left_.lower_bound({pair.collider, 0});
  const bool left = of_pair != left_.end() && of_pair->collider == pair.collider;
  const double depth = (left ? std::min(besides_, overlooked_) : overlooked_) * round;
  if ((bounded || is_fast(one, two)) &&
      (left || needless || wary * travel * travel > 8 * round * (overlooked_ * round + deepest)))
    far_.push_back({pair.collider, pair.nearest, deepest, depth, left,
                    effect_.between(pair.collider[0], pair.collider[1]).compliance > 0});
}

void ContactSearch::find_points(const std::array<int, 2>& pair, const Frame& at_first, const Frame& at_second,
                                const Reach& reach, PairPoints& points) const {
  points.found.clear();
  const Motion &one = motions_[pair[0]], &two = motions_[pair[1]];
  if (two.kind != Carrier::triangle)
    return generate(*one.shape, at_first, *two.shape, at_second, reach, points.scratch, points.found);
  generate(points.triangle, *one.shape, at_first, reach, points.scratch, points.found);
  for (ContactPoint& point : points.found) point.swapped = !point.swapped;
}

void ContactSearch::find(const Configuration& start, ContactLists& contacts) {
  for (auto& list : contacts) list.clear();
  if (!searched_) search(start);
  far_.clear();
  std::size_t begin = 0;
  for (const NearPair& pair : near_pairs_) {
    add_pair(pair, std::span(near_).subspan(begin, pair.end - begin), contacts);
    begin = pair.end;
  }
  keep_each_once(contacts[triangles_rough]);
  keep_each_once(contacts[triangles_smooth]);
  add_surfaces(start.x.cols(), contacts);
}

}  // namespace pbd
