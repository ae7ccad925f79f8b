#include "effects/contact_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rows/threads.h"

namespace pbd {

ContactSearch::ContactSearch(const Scene& scene, const Contact& effect)
    : effect_(effect),
      allowed_(scene, effect),
      clearance_(effect),
      motions_(effect.collider.size() + effect.node.size() +
               (effect.collider.empty() ? 0 : effect.triangle.size())) {
  points_.triangle.radius = effect.thickness / 2;
  if (!effect.triangle.empty()) surfaces_.emplace(effect.triangle);
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

void ContactSearch::add_surfaces(Eigen::Index nodes, ContactLists& contacts) {
  const int material = effect_.surface_material;
  const ContactLaw& law = effect_.law[material * effect_.materials + material];
  for (const SurfaceContact& found : surface_contacts_) {
    ActiveContact contact;
    contact.of_surfaces = true;
    contact.carrier = {-1, -1};
    contact.features.point_a = contact.features.point_b = Vec3::Zero();
    contact.surface = found;
    contact.law = law;
    const bool triangle = found.kind == SurfaceContact::Kind::node_triangle;
    contact.collider = {found.node[0], found.node[triangle ? 1 : 2]};
    const auto number = [](int node) { return static_cast<std::uint64_t>(node); };
    const std::uint64_t rest = number(found.node[triangle ? 2 : 3]),
                        other = number(found.node[triangle ? 3 : 1]);
    contact.features.key =
        3 * (rest + static_cast<std::uint64_t>(nodes) * other) + static_cast<std::uint64_t>(found.kind);
    contacts[law.friction > 0 ? surfaces_rough : surfaces_smooth].push_back(contact);
  }
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

/// The smaller one, m; nodes touch by planes, and have none that counts, nor do triangles.
double ContactSearch::round_radius_of(const Motion& one, const Motion& two) {
  const auto round = [](const Motion& own) { return own.kind == Carrier::body ? own.round : infinity; };
  return std::min(round(one), round(two));
}

/// The late contact of a pair's features, if there is one.
std::vector<ActiveContact>::iterator ContactSearch::late_contact(const PairFeatures& features) {
  return std::find_if(late_.begin(), late_.end(), [&](const ActiveContact& contact) {
    return contact.features.key == features.key && contact.pair() == features.collider;
  });
}

/// What a pair's features make where the step begins.
void ContactSearch::search_pair(int first, int second, const Configuration& start, SearchTask& task) const {
  if (!may_touch(first, second)) return;
  const Motion &one = motions_[first], &two = motions_[second];
  if (one.kind == Carrier::node) return search_nodes(first, second, start.x, task);
  const double travel = travel_between(one, two);
  PairPoints& points = task.points;
  if (two.kind == Carrier::triangle) points.triangle.place(corners(two, start.x));
  find_points({first, second}, one.frame, two.frame, {effect_.margin + travel, one.turn + two.turn}, points);
  double nearest = infinity;
  for (const ContactPoint& point : points.found) {
    nearest = std::min(nearest, gap_of(point, one.frame, two.frame));
    ActiveContact contact = active(point, first, second, points.triangle);
    if (contact.law.restitution == 0) contact.apart = near * travel;
    if (two.kind != Carrier::triangle || nearest_of_surface(contact, start)) task.near.push_back(contact);
  }
  task.pairs.push_back({{first, second}, nearest, task.near.size()});
}

/// Spheres of two nodes, if they are near.
void ContactSearch::search_nodes(int first, int second, const Points& x, SearchTask& task) const {
  const Motion &one = motions_[first], &two = motions_[second];
  ActiveContact contact;
  contact.of_surfaces = true;
  contact.carrier = {-1, -1};
  contact.features.point_a = contact.features.point_b = Vec3::Zero();
  contact.surface = {{one.carrier, one.carrier, two.carrier, two.carrier},
                     SurfaceContact::Kind::node_edge,
                     1,
                     Vec3::UnitZ(),
                     one.radius + two.radius};
  contact.collider = {first, second};
  contact.law = effect_.between(first, second);
  const double gap = touching(contact.surface, x).gap;
  if (!(contact.surface.thickness > 0) || gap > effect_.margin + travel_between(one, two)) return;
  task.near.push_back(contact);
  task.pairs.push_back({{first, second}, gap, task.near.size()});
}

/// Searches the pairs that are asked for. With k tasks each takes every k-th pair, since those of bodies,
/// which take longest, follow each other. What a pair gives depends on no other.
void ContactSearch::search_asked(const Configuration& start) {
  tasks_.resize(threads_ > 1 ? most_tasks : 1);
  each_task(threads_, tasks_.size(), [&](std::size_t k) {
    SearchTask& task = tasks_[k];
    task.points.triangle.radius = points_.triangle.radius;
    task.pairs.clear();
    task.near.clear();
    for (std::size_t i = k; i < asked_.size(); i += tasks_.size())
      search_pair(asked_[i][0], asked_[i][1], start, task);
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
  for (const ActiveContact& contact : near) {
    const PairFeatures features{pair.collider, contact.features.key};
    if (!is_left(features) && late_contact(features) == late_.end()) add(contact);
  }
  for (const ActiveContact& contact : late_)
    if (contact.pair() == pair.collider) add(contact);
  const double travel = travel_between(one, two);
  const bool bounded = std::isfinite(one.radius) && std::isfinite(two.radius);
  const double round = round_radius_of(one, two), deepest = std::min(pair.nearest, 0.0);
  const auto of_pair = left_.lower_bound({pair.collider, 0});
  const bool left = of_pair != left_.end() && of_pair->collider == pair.collider;
  const double depth = (left ? std::min(besides_, overlooked) : overlooked) * round;
  if (bounded && (left || wary * travel * travel > 8 * round * (overlooked * round + deepest)))
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

/// True if one is a half space and the other one begins farther above it than a gap may fall. Where it goes
/// on above it is no less searched for: what slides by the convex law is held from afar.
bool ContactSearch::is_above(int first, int second) const {
  const auto above = [&](const Motion& lower, const Motion& other) {
    return lower.kind == Carrier::body && std::holds_alternative<HalfSpace>(*lower.shape) &&
           lower.frame.rotation.col(2).dot(other.centre - lower.frame.origin) - other.radius >
               effect_.margin + travel_between(lower, other);
  };
  const Motion &one = motions_[first], &two = motions_[second];
  return above(one, two) || above(two, one);
}

/// Pairs are as they were found before in the step unless one of them goes farther now; so are surfaces.
void ContactSearch::search(const Configuration& start) {
  near_before_.swap(near_);
  pairs_before_.swap(near_pairs_);
  near_.clear();
  near_pairs_.clear();
  boxes_.clear();
  for (const Motion& motion : motions_) {
    AxisBox box = box_of(motion, start.x);
    box.extend(AxisBox(box.min() + motion.course, box.max() + motion.course));
    const Vec3 slack = Vec3::Constant(motion.travel + effect_.margin);
    // Nodes, where they do not touch each other, and triangles are not paired here, nor bodies with
    // themselves.
    const bool alone = motion.kind == Carrier::node && effect_.nodes_touch;
    const int group = motion.kind == Carrier::body ? motion.carrier : alone ? -2 - motion.carrier : -1;
    boxes_.push_back({{box.min() - slack, box.max() + slack}, motion.moves, group});
  }
  asked_.clear();
  views_.clear();
  auto before = pairs_before_.begin();
  std::size_t begin = 0;  // of its contacts
  for (const auto& pair : broad_phase_.pairs(boxes_)) {
    for (; before != pairs_before_.end() && before->collider < pair; ++before) begin = before->end;
    const bool known = before != pairs_before_.end() && before->collider == pair &&
                       !motions_[pair[0]].grown && !motions_[pair[1]].grown;
    if (known)
      views_.push_back({pair, before->nearest, std::span(near_before_).subspan(begin, before->end - begin)});
    else if (!is_above(pair[0], pair[1]))
      asked_.push_back(pair);
  }
  search_asked(start);
  for (const SearchTask& task : tasks_) {
    begin = 0;
    for (const auto& [pair, nearest, end] : task.pairs) {
      views_.push_back({pair, nearest, std::span(task.near).subspan(begin, end - begin)});
      begin = end;
    }
  }
  std::sort(views_.begin(), views_.end(),
            [](const NearView& one, const NearView& two) { return one.collider < two.collider; });
  for (const auto& [pair, nearest, contacts] : views_) {
    near_.insert(near_.end(), contacts.begin(), contacts.end());
    near_pairs_.push_back({pair, nearest, near_.size()});
  }
  for (Motion& motion : motions_) motion.grown = false;
  if (std::exchange(surfaces_grown_, false) && effect_.surfaces_touch) {
    surface_contacts_.clear();
    surfaces_->find(start.x, node_travel_, effect_.thickness, surface_contacts_);
  }
  searched_ = true;
  if (near_.empty() && late_.empty() && !(surfaces_ && effect_.surfaces_touch)) look_for_clearance(start);
}

void ContactSearch::look_for_clearance(const Configuration& start) {
  double way = 0;
  for (const Motion& motion : motions_) way = std::max(way, motion.course.norm() + motion.travel);
  clearance_.look(boxes_, start, way, [&](int first, int second) { return may_touch(first, second); });
}

void ContactSearch::find(const Configuration& start, ContactLists& contacts) {
  for (auto& list : contacts) list.clear();
  if (clear_) return;
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
