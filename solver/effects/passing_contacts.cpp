// What meets or passes on the way of a step, where ways are looked at (contact_search.h).
#include <algorithm>
#include <cmath>

#include "effects/contact_search.h"

namespace pbd {

Frame ContactSearch::frame_between(int collider, const Configuration& start, const Configuration& end,
                                   double share) const {
  const Motion& motion = motions_[collider];
  if (motion.kind == Carrier::body) {
    const Pose pose = pose_between(motion.carrier, start, end, share);
    const Frame& own = effect_.collider[collider].frame;
    return {pose.x + pose.rotation * own.origin, pose.rotation * own.rotation};
  }
  const Frame from = placed_frame(collider, start), to = placed_frame(collider, end);
  return {from.origin + share * (to.origin - from.origin), from.rotation};
}

/// Sets `points_.found` to the points of a pair that are within reach at a share of the way from `start` to
/// `end`; returns the least gap, m.
double ContactSearch::generate_between(const Pair& pair, const Configuration& start, const Configuration& end,
                                       double share, double reach) {
  const auto [first, second] = pair.collider;
  const Frame at_first = frame_between(first, start, end, share),
              at_second = frame_between(second, start, end, share);
  if (motions_[second].kind == Carrier::triangle) {
    auto corner = corners(motions_[second], start.x);
    const auto to = corners(motions_[second], end.x);
    for (std::size_t k = 0; k < 3; ++k) corner[k] += share * (to[k] - corner[k]);
    points_.triangle.place(corner);
  }
  find_points(pair.collider, at_first, at_second, Reach{reach}, points_);
  double least = infinity;
  for (const ContactPoint& point : points_.found) least = std::min(least, gap_of(point, at_first, at_second));
  return least;
}

/// m, at a share of the way, of what is within reach.
double ContactSearch::gap_between(const Pair& pair, const Configuration& start, const Configuration& end,
                                  double share, double reach, double slack) {
  const auto within = [&](double each) { return generate_between(pair, start, end, share, each); };
  return gap_by_reach(within, reach, slack);
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

/// Whether a pair that begins in touch goes into each other on its way, deeper than a tenth of its radius,
/// and whether it comes out again: what clips a corner by less has passed nothing.
auto ContactSearch::cut_on_way(const Pair& pair, const Configuration& start, const Configuration& end,
                               double slack) -> Cut {
  constexpr double clipped = 0.1;
  const double travel = way_between(pair, start, end),
               round = round_radius_of(motions_[pair.collider[0]], motions_[pair.collider[1]]);
  double gap = pair.nearest, share = 0, touching_for = 0;
  bool inside = false;
  for (int k = 0; k < most_places && share < 1; ++k) {
    touching_for = gap > slack ? 0 : std::min(std::max(2 * touching_for, slack), round / 2);
    share = std::min(1.0, share + std::max({gap, touching_for, clipped_unseen * round}) / travel);
    gap = gap_between(pair, start, end, share, (1 - share) * travel + slack, slack);
    inside |= gap < pair.deepest - clipped * round;
    if (inside && gap > -slack) return Cut::through;
  }
  return inside ? Cut::in : Cut::none;
}

/// Sets `overlapping_` to meetings of what of a pair touches where the step begins, and has passed at `end`,
/// as its way cuts it; true if it has.
bool ContactSearch::find_passed(const Pair& pair, const Configuration& start, const Configuration& end,
                                double slack, Cut cut) {
  const bool through = cut == Cut::through;
  touching_ = 0;
  generate_between(pair, start, end, 0, 2 * slack);
  if (!through)
    std::erase_if(points_.found,
                  [&](const ContactPoint& point) { return !passes_round(point, pair, start, end); });
  keep_meetings(pair, start, end, 0, -slack);
  return through || !overlapping_.empty();
}

/// Walks the way of a pair that begins apart. True where it is in each other by more than `allowed`
/// (negative, m), between the shares `touching_` and `inside_`; if ways are not looked at, it sets
/// `overlapping_` to the features by which it touches there and that overlap at `end` by more than that. A
/// gap falls by no more than both travel, so that no smaller share needs to be looked at; what touches goes
/// on by half a radius at most. True, and both shares 0, where the way has too many places.
bool ContactSearch::meets(const Pair& pair, const Configuration& start, const Configuration& end,
                          double allowed, double slack) {
  const double travel = way_between(pair, start, end),
               round = round_radius_of(motions_[pair.collider[0]], motions_[pair.collider[1]]);
  double gap = pair.nearest, share = 0, touching_for = 0;
  apart_ = touching_ = inside_ = 0;
  least_ = gap;
  for (int k = 0; k < most_places; ++k) {
    least_ = std::min(least_, gap);
    touching_for = gap > slack ? 0 : std::min(std::max(2 * touching_for, slack), round / 2);
    share += std::max({gap, touching_for, clipped_unseen * round}) / travel;
    if (!(share < 1)) {
      if (pair.pushed)
        least_ = std::min(least_, generate_between(pair, start, end, 1, 2 * pair.overlooked + pair.bent));
      return false;
    }
    gap = gap_between(pair, start, end, share, (1 - share) * travel + slack, slack);
    if (gap > slack) {
      apart_ = share;
      continue;
    }
    if (!(gap < allowed)) continue;
    inside_ = share;
    touching_ = entering(pair, start, end, std::min(pair.deepest, -slack), apart_, inside_);
    if (effect_.continuous) return true;
    generate_between(pair, start, end, touching_, 2 * slack);
    keep_overlapping(pair, start, end, allowed, -slack);
    return true;
  }
  overlapping_.clear();
  touching_ = inside_ = 0;
  return true;
}

/// A contact's carriers at a share of the way, until the next call; what else there is is of no use.
Configuration ContactSearch::placed_between(const ActiveContact& contact, const Configuration& start,
                                            const Configuration& end, double share) {
  if (between_x_.cols() != start.x.cols()) between_x_ = start.x;
  between_pose_.resize(start.pose.size());
  const auto place = [&](int node) {
    between_x_.col(node) = start.x.col(node) + share * (end.x.col(node) - start.x.col(node));
  };
  for (const int side : {0, 1}) {
    const int carrier = contact.carrier[side];
    if (side == contact.node_side) {
      place(carrier);
    } else if (side == contact.triangle_side) {
      for (const int node : effect_.triangle[carrier]) place(node);
    } else {
      between_pose_[carrier] = pose_between(carrier, start, end, share);
    }
  }
  return {between_x_, between_pose_, start.time};
}

std::optional<double> ContactSearch::closes_at(const ActiveContact& contact, const Configuration& start,
                                               const Configuration& end, double first) {
  // Only planes are passed by where their rates say otherwise: what is round is nearer than these say.
  // Surfaces have no carriers.
  if (contact.of_surfaces || contact.meeting || contact.features.kind != ContactPoint::Kind::face)
    return first;
  const auto closed = [&](double share) {
    return touching_at(contact, placed_between(contact, start, end, share)).gap <= 0;
  };
  if (closed(first)) return first;
  constexpr int places = 16, halvings = 20;  // of the way
  double open = first;
  for (int k = 1; k <= places; ++k) {
    double shut = first + (1 - first) * k / places;
    if (!closed(shut)) {
      open = shut;
      continue;
    }
    for (int halving = 0; halving < halvings; ++halving) {
      const double middle = (open + shut) / 2;
      (closed(middle) ? shut : open) = middle;
    }
    return shut;
  }
  return std::nullopt;
}

bool ContactSearch::on_features(const ActiveContact& contact, const Configuration& start,
                                const Configuration& end, double share) {
  return contact.of_surfaces || contact.meeting ||
         on_shapes(contact, placed_between(contact, start, end, share));
}

bool ContactSearch::hold_back(const Bodies& bodies, const Configuration& start, const Configuration& end,
                              std::vector<double>& share) {
  bool any = false;
  for (const NearPair& near : near_pairs_) {
    const double slack =
        overlooked_ * round_radius_of(motions_[near.collider[0]], motions_[near.collider[1]]);
    if (!std::isfinite(slack)) continue;  // of a half space: from below it nodes and triangles are pushed out
    const Pair pair{.collider = near.collider,
                    .nearest = near.nearest,
                    .deepest = std::min(near.nearest, 0.0),
                    .overlooked = slack};
    apart_ = 0;
    // A missed step leaves no more than a clipped corner of what began in touch in each other, either.
    if (pair.nearest > slack) {
      if (!meets(pair, start, end, -slack, slack)) continue;
    } else {
      const Cut cut = cut_on_way(pair, start, end, slack);
      if (!find_passed(pair, start, end, slack, cut) && cut == Cut::none) continue;
    }
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
