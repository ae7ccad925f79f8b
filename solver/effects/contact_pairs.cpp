// Which pairs are near where a step begins, and what their features make there.
#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/contact_search.h"
#include "threads/threads.h"

namespace pbd {

/// What a pair's features make where the step begins.
void ContactSearch::search_pair(int first, int second, const Configuration& start, SearchTask& task) const {
  if (!may_touch(first, second)) return;
  const Motion &one = motions_[first], &two = motions_[second];
  if (one.kind == Carrier::node) return search_nodes(first, second, start.x, task);
  const double travel = travel_between(one, two);
  const std::size_t before = task.near.size();
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
  if (effect_.continuous && std::isfinite(nearest)) {
    const auto within = [&](double reach) {
      find_points({first, second}, one.frame, two.frame, {reach, 0}, points);
      double least = infinity;
      for (const ContactPoint& point : points.found)
        least = std::min(least, gap_of(point, one.frame, two.frame));
      return least;
    };
    const double slack = overlooked_ * round_radius_of(one, two);
    nearest = gap_by_reach(within, effect_.margin + travel, slack);
    if (is_fast(one, two)) {
      task.near.resize(before);
      if (!(nearest > slack)) search_meetings(first, second, start, task);
    }
  }
  if (two.kind == Carrier::body && !is_fast(one, two))
    find_needless(std::span(task.near).subspan(before), start, points);
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
                     one.radius + two.radius,
                     one.radius};
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
  searched_ = true;
  if (!colliders_clear_) search_colliders(start);
  if (!std::exchange(surfaces_grown_, false)) return;
  surface_contacts_.clear();
  surfaces_->find(threads_, start.x, surface_reach_, surface_contacts_);
}

void ContactSearch::search_colliders(const Configuration& start) {
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
  if (near_.empty() && late_.empty()) look_for_clearance(start);
}

void ContactSearch::look_for_clearance(const Configuration& start) {
  double way = 0;
  for (const Motion& motion : motions_) way = std::max(way, motion.course.norm() + motion.travel);
  clearance_.look(boxes_, start, way, [&](int first, int second) { return may_touch(first, second); });
}

}  // namespace pbd
