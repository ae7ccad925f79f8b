// What meets or passes on the way of a step, where ways are looked at (contact_search.h).
#include <algorithm>
#include <cmath>

#include "effects/contact_search.h"

namespace pbd {

bool ContactSearch::is_fast(const Motion& one, const Motion& two) const {
  return effect_.continuous &&
         (one.course - two.course).norm() + one.beside + two.beside > round_radius_of(one, two);
}

/// What touches at a share of the way to `end`, as a row that says of `end` what its rate there makes of it.
Meeting ContactSearch::meeting_of(const ActiveContact& contact, const Configuration& at,
                                  const Configuration& start, const Configuration& end, double share) {
  const Touching found = touching_at(contact, at);
  const Vec3 place = place_of(contact, found);
  Meeting meeting;
  meeting.normal = found.normal;
  if (contact.triangle_side >= 0) meeting.weight = weights_at(contact.triangle, at.x, place);
  Vec3 way = Vec3::Zero();  // m, that a goes against b where it touches
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1 : -1;
    const int carrier = contact.carrier[side];
    if (side == contact.triangle_side) {
      for (int k = 0; k < 3; ++k) {
        const int node = contact.triangle.node[k];
        way += sign * meeting.weight[k] * (end.x.col(node) - start.x.col(node));
      }
    } else if (side == contact.node_side) {
      way += sign * (end.x.col(carrier) - start.x.col(carrier));
    } else {
      const Pose& pose = at.pose[carrier];
      meeting.of_bodies.arm[side] = place - pose.x;
      meeting.of_bodies.rotation[side] = pose.rotation;
      meeting.turn_per_arc[side] = pose.turn_per_arc;
      const Vec3 turn = turn_between(carrier, start, end);
      way += sign * (end.pose[carrier].x - start.pose[carrier].x + turn.cross(meeting.of_bodies.arm[side]));
    }
  }
  ActiveContact stated = contact;
  stated.meeting = std::make_shared<Meeting>(meeting);
  meeting.offset = found.gap + (1 - share) * meeting.normal.dot(way) - touching_at(stated, end).gap;
  return meeting;
}

/// m, at a share of the way, of what is within reach.
double ContactSearch::gap_between(const Pair& pair, const Configuration& start, const Configuration& end,
                                  double share, double reach, double slack) {
  const auto within = [&](double each) { return generate_between(pair, start, end, share, each); };
  return gap_by_reach(within, reach, slack);
}

/// Sets `overlapping_` to what of `points_.found` touches at a share of the way, and says that `end` overlaps
/// by more than `allowed`.
void ContactSearch::keep_meetings(const Pair& pair, const Configuration& start, const Configuration& end,
                                  double share, double allowed) {
  overlapping_.clear();
  for (const ContactPoint& point : points_.found)
    overlapping_.push_back(active(point, pair.collider[0], pair.collider[1], points_.triangle));
  const auto beside = std::stable_partition(
      overlapping_.begin(), overlapping_.end(),
      [&](const ActiveContact& contact) { return on_features(contact, start, end, share); });
  if (beside != overlapping_.begin()) overlapping_.erase(beside, overlapping_.end());
  for (ActiveContact& contact : overlapping_) {
    const Configuration at = placed_between(contact, start, end, share);
    contact.meeting = std::make_shared<Meeting>(meeting_of(contact, at, start, end, share));
    contact.features.kind = ContactPoint::Kind::point;
    contact.features.key = ~meetings_++;
  }
  std::erase_if(overlapping_,
                [&](const ActiveContact& contact) { return !(touching_at(contact, end).gap < allowed); });
}

/// True if what begins apart meets on its way to `end`, or there; sets `overlapping_` to how.
bool ContactSearch::find_meetings(const Pair& pair, const Configuration& start, const Configuration& end,
                                  double allowed, double slack) {
  if (!meets(pair, start, end, allowed, slack)) {
    if (!(generate_between(pair, start, end, 1, slack) < allowed)) return false;
    inside_ = 1;
    touching_ = entering(pair, start, end, -slack, apart_, inside_);
  }
  const double way = way_between(pair, start, end);
  constexpr int rounds = 4;  // of halvings: more than a double has digits
  for (int k = 0; k < rounds && (inside_ - touching_) * way > slack; ++k)
    touching_ = entering(pair, start, end, -slack, touching_, inside_);
  generate_between(pair, start, end, touching_, 3 * slack);
  keep_meetings(pair, start, end, touching_, allowed);
  if (!overlapping_.empty()) return true;
  generate_between(pair, start, end, inside_, 0);
  keep_meetings(pair, start, end, inside_, allowed);
  return true;
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

/// m, by which the gap of a pair falls at most on its way to `end`.
double ContactSearch::way_between(const Pair& pair, const Configuration& start,
                                  const Configuration& end) const {
  Vec3 against = Vec3::Zero();
  double beside = 0;
  for (const std::size_t k : {0, 1}) {
    const Motion& motion = motions_[pair.collider[k]];
    Vec3 shift;
    if (motion.kind == Carrier::triangle) {
      const auto from = corners(motion, start.x), to = corners(motion, end.x);
      shift = (to[0] - from[0] + to[1] - from[1] + to[2] - from[2]) / 3;
      double most = 0;
      for (std::size_t i = 0; i < 3; ++i) most = std::max(most, (to[i] - from[i] - shift).norm());
      beside += most;
    } else if (motion.kind == Carrier::node) {
      shift = end.x.col(motion.carrier) - start.x.col(motion.carrier);
    } else {
      shift = end.pose[motion.carrier].x - start.pose[motion.carrier].x;
      if (const double turn = turn_between(motion.carrier, start, end).norm(); turn > 0)
        beside += motion.radius * turn;
    }
    against += k == 0 ? shift : Vec3(-shift);
  }
  return std::min(against.norm() + beside,
                  travel_between(motions_[pair.collider[0]], motions_[pair.collider[1]]));
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
  generate_between(pair, start, end, 0, 2 * slack);
  if (!through)
    std::erase_if(points_.found,
                  [&](const ContactPoint& point) { return !passes_round(point, pair, start, end); });
  keep_meetings(pair, start, end, 0, -slack);
  return through || !overlapping_.empty();
}

/// Walks the way of a pair that begins apart. True where it is in each other by more than `allowed`
/// (negative, m), between the shares `touching_` and `inside_`; if ways are not looked at, too, where it
/// touches by features that overlap at `end` by more than that, to which it sets `overlapping_` then. A gap
/// falls by no more than both travel, so that no smaller share needs to be looked at; what touches goes on by
/// half a radius at most. True, and both shares 0, where the way has too many places.
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
      least_ = std::min(least_, gap_between(pair, start, end, 1, gap + slack, slack));
      return false;
    }
    gap = gap_between(pair, start, end, share, (1 - share) * travel + slack, slack);
    if (gap > slack) {
      apart_ = share;
      continue;
    }
    const bool inside = gap < allowed;
    if (effect_.continuous && !inside) continue;
    if (inside) {
      inside_ = share;
      share = touching_ = entering(pair, start, end, -slack, apart_, inside_);
    }
    if (effect_.continuous) return true;
    generate_between(pair, start, end, share, 2 * slack);
    keep_overlapping(pair, start, end, allowed, -slack);
    if (inside || !overlapping_.empty()) return true;
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
    const double slack = overlooked * round_radius_of(motions_[near.collider[0]], motions_[near.collider[1]]);
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
