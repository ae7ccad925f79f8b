#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/contact_search.h"

namespace pbd {

double ContactSearch::gap_of(const ContactPoint& point, const Frame& at_first, const Frame& at_second) {
  return point.swapped ? touching(point, at_second, at_first).gap : touching(point, at_first, at_second).gap;
}

Eigen::Matrix3d ContactSearch::turned_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to,
                                              double share) {
  return Eigen::Quaterniond(from).slerp(share, Eigen::Quaterniond(to)).toRotationMatrix();
}

Frame ContactSearch::frame_between(int collider, const Configuration& start, const Configuration& end,
                                   double share) const {
  const Frame from = placed_frame(collider, start), to = placed_frame(collider, end);
  return {from.origin + share * (to.origin - from.origin), turned_between(from.rotation, to.rotation, share)};
}

/// Sets `found_` to the points of a pair that are within reach at a share of the way from `start` to `end`;
/// returns the least gap, m.
double ContactSearch::generate_between(const Pair& pair, const Configuration& start, const Configuration& end,
                                       double share, double reach) {
  const auto [first, second] = pair.collider;
  const Frame at_first = frame_between(first, start, end, share),
              at_second = frame_between(second, start, end, share);
  if (motions_[second].kind == Carrier::triangle) {
    auto corner = corners(motions_[second], start.x);
    const auto to = corners(motions_[second], end.x);
    for (std::size_t k = 0; k < 3; ++k) corner[k] += share * (to[k] - corner[k]);
    triangle_.place(corner);
  }
  find_points(pair.collider, at_first, at_second, Reach{reach});
  double least = infinity;
  for (const ContactPoint& point : found_) least = std::min(least, gap_of(point, at_first, at_second));
  return least;
}

/// Sets `overlapping_` to what of `found_` overlaps at `end` by more than `allowed`, but not what lies behind
/// where `start` was.
void ContactSearch::keep_overlapping(const Pair& pair, const Configuration& start, const Configuration& end,
                                     double allowed, double behind) {
  overlapping_.clear();
  for (const ContactPoint& point : found_) {
    const ActiveContact contact = active(point, pair.collider[0], pair.collider[1]);
    if (touching_at(contact, end).gap < allowed && touching_at(contact, start).gap >= behind)
      overlapping_.push_back(contact);
  }
}

/// True of a triangle that begins in a body by more than is overlooked: by which features, and how deep, is
/// told of it as it is nearest.
bool ContactSearch::begins_cut(const Pair& pair) const {
  return pair.deepest < -pair.overlooked && motions_[pair.collider[1]].kind == Carrier::triangle;
}

/// Sets `overlapping_` to what of `found_` overlaps at `end` by more than `allowed`, and by more than at
/// `start`: what ends less deep is on its way out, though other features were nearest there.
void ContactSearch::keep_deepening(const Pair& pair, const Configuration& start, const Configuration& end,
                                   double allowed) {
  keep_overlapping(pair, start, end, allowed, -infinity);
  std::erase_if(overlapping_, [&](const ActiveContact& contact) {
    return touching_at(contact, end).gap >= touching_at(contact, start).gap;
  });
}

/// Halves the part of the way between two shares, at the second of which a pair is in each other by more than
/// `behind` (negative, m): sets `overlapping` and returns the last share at which it is not.
double ContactSearch::entering(const Pair& pair, const Configuration& start, const Configuration& end,
                               double behind, double apart, double& overlapping) {
  constexpr int halvings = 15;  // of the way: less than `overlooked` of r where a shape goes as far as 3 r
  for (int k = 0; k < halvings; ++k) {
    const double middle = (apart + overlapping) / 2;
    (generate_between(pair, start, end, middle, pair.overlooked) < behind ? overlapping : apart) = middle;
  }
  return apart;
}

/// A share of the way, as near to its end as is looked for, at which a pair is in each other by no more than
/// `behind`: what grazed earlier is not how it came to be where it ends.
double ContactSearch::last_apart(const Pair& pair, const Configuration& start, const Configuration& end,
                                 double behind) {
  constexpr double nearest = 1.0 / 64;
  for (double left = nearest; left < 1; left *= 2)
    if (!(generate_between(pair, start, end, 1 - left, pair.overlooked) < behind)) return 1 - left;
  return 0;
}

/// States what touches round of `found_` at a share of the way, and has passed at `end`, as the plane
/// between, which b carries: a distance has no sign by which to see that one passed the other.
void ContactSearch::part_by_planes(const Pair& pair, const Configuration& start, const Configuration& end,
                                   double share) {
  const auto [first, second] = pair.collider;
  const std::array<Frame, 2> at{frame_between(first, start, end, share),
                                frame_between(second, start, end, share)};
  for (ContactPoint& point : found_) {
    if (point.kind != ContactPoint::Kind::point && point.kind != ContactPoint::Kind::line) continue;
    if (touching_at(active(point, first, second), end).gap < 0) continue;
    const Frame &a = at[point.swapped ? 1 : 0], &b = at[point.swapped ? 0 : 1];
    point.direction_b = b.rotation.transpose() * touching(point, a, b).normal;
    point.kind = ContactPoint::Kind::face;
  }
}

/// True if what touches round has turned about each other by more than a right angle at `end`, and was in
/// each other on the way by as much as that takes: no rolling, but one that passed the other.
bool ContactSearch::passes_round(const ContactPoint& point, const Pair& pair, const Configuration& start,
                                 const Configuration& end) const {
  if (point.kind != ContactPoint::Kind::point && point.kind != ContactPoint::Kind::line) return false;
  const int first = pair.collider[0], second = pair.collider[1];
  const auto touching_after = [&](double share) {
    const Frame one = frame_between(first, start, end, share), two = frame_between(second, start, end, share);
    return point.swapped ? touching(point, two, one) : touching(point, one, two);
  };
  if (!(touching_after(0).normal.dot(touching_after(1).normal) < 0)) return false;
  constexpr int places = 256;  // two in what is cut so deep, of a way of a hundred sizes
  const double turned = (1 - std::sqrt(0.5)) * (point.radius_a + point.radius_b);
  for (int k = 1; k < places; ++k)
    if (touching_after(k / double(places)).gap < -turned) return true;
  return false;
}

/// Sets `overlapping_` to the planes between what of a pair touches round where the step begins, and has
/// passed at `end`; true if there are any.
bool ContactSearch::find_passed(const Pair& pair, const Configuration& start, const Configuration& end,
                                double slack) {
  generate_between(pair, start, end, 0, 2 * slack);
  std::erase_if(found_, [&](const ContactPoint& point) { return !passes_round(point, pair, start, end); });
  part_by_planes(pair, start, end, 0);
  keep_overlapping(pair, start, end, -slack, -infinity);
  return !overlapping_.empty();
}

/// Walks the way of a pair that begins apart. True where it touches by features that overlap at `end` by more
/// than `allowed`, or is in each other by more than that (negative, m); sets `overlapping_` to those
/// features, if there are any. A gap falls by no more than both travel, so that no smaller share needs to be
/// looked at; what touches goes on by half a radius at most.
bool ContactSearch::meets(const Pair& pair, const Configuration& start, const Configuration& end,
                          double allowed, double slack) {
  constexpr int most = 10000;  // of places that are looked at: a hundred sizes take some hundred
  const Motion &one = motions_[pair.collider[0]], &two = motions_[pair.collider[1]];
  const double travel = travel_between(one, two), round = round_radius_of(one, two);
  double gap = pair.nearest, share = 0, touching_for = 0;
  apart_ = 0;
  for (int k = 0; k < most; ++k) {
    touching_for = gap > slack ? 0 : std::min(std::max(2 * touching_for, slack), round / 2);
    share += std::max(gap, touching_for) / travel;
    if (!(share < 1)) return false;
    gap = generate_between(pair, start, end, share, (1 - share) * travel + slack);
    if (gap > slack) {
      apart_ = share;
      continue;
    }
    const bool inside = gap < allowed;
    if (inside) share = entering(pair, start, end, -slack, apart_, share);
    generate_between(pair, start, end, share, 2 * slack);
    if (inside) part_by_planes(pair, start, end, share);
    keep_overlapping(pair, start, end, allowed, -slack);
    if (inside || !overlapping_.empty()) return true;
  }
  overlapping_.clear();
  return true;
}

/// True if a pair overlaps at `end`, or on the way there where that is to be looked at, as none of the step's
/// contacts tells; sets `overlapping_` to the points by which it has come to, if any are found: shapes in
/// each other tell how they part, not how they met, and what has come over an edge would be thrown back
/// across a face. Without any the step cannot be solved.
bool ContactSearch::find_overlapping(const Pair& pair, const Configuration& start, const Configuration& end) {
  const Motion &one = motions_[pair.collider[0]], &two = motions_[pair.collider[1]];
  const double round = round_radius_of(one, two);
  // Of triangles no less than what a solved step may miss of their nodes.
  const double missed = two.kind == Carrier::triangle ? besides_ * round : 0;
  const double slack = std::max(pair.overlooked, missed);
  const double travel = travel_between(one, two), rounded = 1e-12 * (one.radius + two.radius + travel);
  const double behind = std::min(pair.deepest, -slack) - rounded;
  const double allowed = std::min(pair.least_end - rounded, behind);
  if (effect_.continuous && pair.nearest > slack && meets(pair, start, end, allowed, slack)) return true;
  if (effect_.continuous && !(pair.nearest > slack) && find_passed(pair, start, end, slack)) return true;
  if (pair.left) {
    const double grazed = std::max(overlooked * round, travel * travel / (2 * round));
    // What clips a corner on its straight way, and ends where it may be, has passed nothing.
    if (pair.nearest > grazed && meets(pair, start, end, std::min(allowed, -grazed), grazed) &&
        !overlapping_.empty())
      return true;
  }
  if (!(generate_between(pair, start, end, 1, slack) < allowed)) return false;
  double overlapping = 1;
  const double apart = entering(pair, start, end, behind, last_apart(pair, start, end, behind), overlapping);
  const double left = (overlapping - apart) * travel;
  // What touches as they come to overlap is how they met, wherever its planes and lines lie at the start, but
  // for the planes that stand for rims; of triangles they may lie far behind.
  const bool rims = is_cylinder(pair.collider[0]) || is_cylinder(pair.collider[1]);
  const double least_met = rims || two.kind == Carrier::triangle ? behind : -infinity;
  for (const auto& [at, least] : {std::pair{apart, behind}, {1.0, behind}, {apart, least_met}}) {
    generate_between(pair, start, end, at, slack + left);
    keep_overlapping(pair, start, end, allowed, least);
    if (!overlapping_.empty()) return true;
  }
  if (!begins_cut(pair)) return true;
  keep_deepening(pair, start, end, allowed);
  return !overlapping_.empty();
}

/// In the place of the late contact of the same features, if there is one.
void ContactSearch::add_late(const ActiveContact& found, double target) {
  const auto known = late_contact({found.pair(), found.features.key});
  ActiveContact& contact = known == late_.end() ? late_.emplace_back() : *known;
  contact = found;
  contact.late = true;
  contact.target = target;
}

bool ContactSearch::see_overlaps(const Configuration& start, const Configuration& end,
                                 const ContactLists& contacts) {
  if (far_.empty()) return false;
  const auto in_order = [](const Pair& a, const Pair& b) { return a.collider < b.collider; };
  for (Pair& pair : far_) pair.least_end = infinity;
  for (const auto& list : contacts)
    for (const ActiveContact& contact : list) {
      if (contact.of_surfaces) continue;
      const auto pair = std::lower_bound(far_.begin(), far_.end(), Pair{contact.pair()}, in_order);
      if (pair == far_.end() || pair->collider != contact.pair()) continue;
      pair->least_end = std::min(pair->least_end, touching_at(contact, end).gap);
    }
  bool seen = false;
  for (const Pair& pair : far_) {
    // What a contact that has just been dropped did is not where the pair will be.
    if (std::binary_search(dropped_.begin(), dropped_.end(), pair.collider)) continue;
    if (!find_overlapping(pair, start, end)) continue;
    seen = true;
    for (const ActiveContact& found : overlapping_) {
      const double began = begins_cut(pair) ? touching_at(found, start).gap : pair.deepest;
      add_late(found, std::min(pair.deepest, began));
    }
  }
  return seen;
}

bool ContactSearch::look_again(const Configuration& start, const Configuration& end,
                               const Configuration& free, double tolerance, const ContactLists& contacts) {
  besides_ = std::max(tolerance, least_beside);
  const bool dropped = drop_left(start, end, free, contacts), seen = see_overlaps(start, end, contacts);
  return dropped || seen;
}

bool ContactSearch::hold_back(const Bodies& bodies, const Configuration& start, const Configuration& end,
                              std::vector<double>& share) {
  bool any = false;
  for (const NearPair& near : near_pairs_) {
    const double slack = overlooked * round_radius_of(motions_[near.collider[0]], motions_[near.collider[1]]);
    const Pair pair{.collider = near.collider, .nearest = near.nearest, .overlooked = slack};
    if (!std::isfinite(slack)) continue;
    apart_ = 0;
    if (!(pair.nearest > slack ? meets(pair, start, end, -slack, slack)
                               : find_passed(pair, start, end, slack)))
      continue;
    any = true;
    const auto lower = [&](Eigen::Index column) { share[column] = std::min(share[column], apart_); };
    for (const int collider : near.collider) {
      const Motion& motion = motions_[collider];
      if (motion.kind == Carrier::triangle)
        for (const int node : effect_.triangle[motion.carrier]) lower(node);
      else if (motion.kind == Carrier::node)
        lower(motion.carrier);
      else
        lower(bodies.node(motion.carrier)), lower(bodies.column(motion.carrier));
    }
  }
  return any;
}

}  // namespace pbd
