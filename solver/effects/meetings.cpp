// What meets on the way of a step, where ways are looked at (contact_search.h): rows of it, and which of them
// join the step.
#include <algorithm>
#include <cmath>
#include <map>

#include "effects/contact_search.h"

namespace pbd {
namespace {

/// Of contacts from `first` on leaves out those that are not `on` both of their shapes.
template <class On>
void leave_out_beside(std::vector<ActiveContact>& contacts, std::size_t first, const On& on) {
  const auto begin = contacts.begin() + static_cast<std::ptrdiff_t>(first);
  contacts.erase(std::stable_partition(begin, contacts.end(), on), contacts.end());
}

}  // namespace

/// rad, in the world, of a body on the way to `end`: as its arcs tell, so that it may be more than half a
/// turn.
Vec3 ContactSearch::turn_between(int body, const Configuration& start, const Configuration& end) {
  return start.pose[body].turn_per_arc * arc_of(body, end);
}

Pose ContactSearch::pose_between(int body, const Configuration& start, const Configuration& end,
                                 double share) {
  const Pose& from = start.pose[body];
  const Vec3 turn = turn_between(body, start, end);
  const Eigen::Matrix3d turned(Eigen::AngleAxisd(share * turn.norm(), turn.stableNormalized()));
  return {from.x + share * (end.pose[body].x - from.x), turned * from.rotation, turned * from.turn_per_arc};
}

bool ContactSearch::is_fast(const Motion& one, const Motion& two) const {
  return effect_.continuous &&
         (one.course - two.course).norm() + one.beside + two.beside > round_radius_of(one, two);
}

/// m, by which the gap of a pair falls at most on its way to `end`.
double ContactSearch::way_between(const Pair& pair, const Configuration& start,
                                  const Configuration& end) const {
  Vec3 against = Vec3::Zero();
  double by_turns = 0;
  for (const std::size_t k : {0, 1}) {
    const Motion& motion = motions_[pair.collider[k]];
    Vec3 shift;
    if (motion.kind == Carrier::triangle) {
      const auto from = corners(motion, start.x), to = corners(motion, end.x);
      shift = (to[0] - from[0] + to[1] - from[1] + to[2] - from[2]) / 3;
      double most = 0;
      for (std::size_t i = 0; i < 3; ++i) most = std::max(most, (to[i] - from[i] - shift).norm());
      by_turns += most;
    } else if (motion.kind == Carrier::node) {
      shift = end.x.col(motion.carrier) - start.x.col(motion.carrier);
    } else {
      shift = end.pose[motion.carrier].x - start.pose[motion.carrier].x;
      if (const double turn = turn_between(motion.carrier, start, end).norm(); turn > 0)
        by_turns += motion.radius * turn;
    }
    against += k == 0 ? shift : Vec3(-shift);
  }
  return std::min(against.norm() + by_turns,
                  travel_between(motions_[pair.collider[0]], motions_[pair.collider[1]]));
}

/// States what touches `at` a share of the way to `end` as a row that says of `end` what the rate there makes
/// of it.
void ContactSearch::meet(const Configuration& at, const Configuration& start, const Configuration& end,
                         double share, ActiveContact& contact) {
  const Touching found = touching_at(contact, at);
  const Vec3 place = place_of(contact, found);
  const auto met = std::make_shared<Meeting>();
  Meeting& meeting = *met;
  meeting.normal = found.normal;
  meeting.left = 1 - share;
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
      meeting.on_way.arm[side] = place - at.x.col(carrier);
      way += sign * (end.x.col(carrier) - start.x.col(carrier));
    } else {
      const Pose& pose = at.pose[carrier];
      meeting.on_way.arm[side] = place - pose.x;
      meeting.on_way.rotation[side] = pose.rotation;
      meeting.turn_per_arc[side] = pose.turn_per_arc;
      const Vec3 turn = turn_between(carrier, start, end);
      way += sign * (end.pose[carrier].x - start.pose[carrier].x + turn.cross(meeting.on_way.arm[side]));
    }
  }
  contact.meeting = met;
  meeting.offset = found.gap + meeting.left * meeting.normal.dot(way) - touching_at(contact, end).gap;
}

/// What of a fast pair touches where the step begins.
void ContactSearch::search_meetings(int first, int second, const Configuration& start,
                                    SearchTask& task) const {
  const Motion &one = motions_[first], &two = motions_[second];
  const double slack = overlooked_ * round_radius_of(one, two);
  const std::size_t before = task.near.size();
  find_points({first, second}, one.frame, two.frame, {slack, 0}, task.points);
  for (const ContactPoint& point : task.points.found)
    task.near.push_back(active(point, first, second, task.points.triangle));
  leave_out_beside(task.near, before, [&](const ActiveContact& contact) {
    return on_shapes(contact, start, slack, task.points);
  });
  for (std::size_t i = before; i < task.near.size(); ++i) meet(start, start, start, 0, task.near[i]);
}

/// Sets `overlapping_` to what of `points_.found` touches at a share of the way, and says that `end` overlaps
/// by more than `allowed`.
void ContactSearch::keep_meetings(const Pair& pair, const Configuration& start, const Configuration& end,
                                  double share, double allowed) {
  overlapping_.clear();
  for (const ContactPoint& point : points_.found)
    overlapping_.push_back(active(point, pair.collider[0], pair.collider[1], points_.triangle));
  leave_out_beside(overlapping_, 0,
                   [&](const ActiveContact& contact) { return on_features(contact, start, end, share); });
  for (ActiveContact& contact : overlapping_) {
    meet(placed_between(contact, start, end, share), start, end, share, contact);
    contact.features.key = ~meetings_++;
  }
  std::erase_if(overlapping_,
                [&](const ActiveContact& contact) { return !(touching_at(contact, end).gap < allowed); });
}

/// True if what begins apart meets on its way to `end`, or there; sets `overlapping_` to how.
bool ContactSearch::find_meetings(const Pair& pair, const Configuration& start, const Configuration& end,
                                  double allowed, double slack) {
  const double behind = std::min(pair.deepest, -slack), way = way_between(pair, start, end);
  if (!meets(pair, start, end, allowed, slack)) {
    if (!(generate_between(pair, start, end, 1, slack) < allowed)) return false;
    inside_ = 1;
    touching_ = entering(pair, start, end, behind, apart_, inside_);
  }
  constexpr int rounds = 4;  // of halvings: more than a double has digits
  for (int k = 0; k < rounds && (inside_ - touching_) * way > slack; ++k)
    touching_ = entering(pair, start, end, behind, touching_, inside_);
  generate_between(pair, start, end, touching_, 3 * slack);
  keep_meetings(pair, start, end, touching_, allowed);
  if (!overlapping_.empty()) return true;
  generate_between(pair, start, end, inside_, 0);
  keep_meetings(pair, start, end, inside_, allowed);
  return true;
}

/// m, by which turns take what met off the line on which its gap goes on, at `end`.
double ContactSearch::bent(const ActiveContact& contact, const Configuration& end) {
  const Meeting& meeting = *contact.meeting;
  double sum = 0;
  for (const int side : {0, 1}) {
    if (side == contact.node_side || side == contact.triangle_side) continue;
    const Vec3& arm = meeting.on_way.arm[side];
    const Vec3 turn = meeting.left * meeting.turn_per_arc[side] * arc_of(contact.carrier[side], end);
    const Eigen::AngleAxisd rotation(turn.norm(), turn.stableNormalized());
    sum += std::abs(meeting.normal.dot(rotation * arm - arm - turn.cross(arm)));
  }
  return sum;
}

/// Of what met, what met first of all that each of both meets, and what did by less than its window later.
void ContactSearch::add_first_met() {
  std::map<std::pair<Carrier, int>, double> first;  // of bodies and nodes
  const auto each_mover = [&](const Met& met, const auto& act) {
    for (const int collider : met.collider) {
      const Motion& motion = motions_[collider];
      if (!motion.moves) continue;
      if (motion.kind != Carrier::triangle)
        act(std::pair{motion.kind, motion.carrier});
      else
        for (const int node : effect_.triangle[motion.carrier]) act(std::pair{Carrier::node, node});
    }
  };
  for (const Met& met : met_)
    each_mover(met, [&](const auto& mover) {
      const auto known = first.emplace(mover, met.share).first;
      known->second = std::min(known->second, met.share);
    });
  for (const Met& met : met_) {
    bool late = false;
    each_mover(met, [&](const auto& mover) { late |= met.share > first.at(mover) + met.window; });
    if (late) continue;
    for (const ActiveContact& contact : met.contacts) add_late(contact, 0);
  }
}

/// Tries a pair, or what of a body and triangles is so, without its meetings, which push it although it comes
/// nowhere near on its way. True if there is one that has not been tried.
bool ContactSearch::let_go() {
  held_.clear();
  std::array<int, 2> first{-1, -1};
  const auto is_triangle = [&](int collider) { return motions_[collider].kind == Carrier::triangle; };
  for (const Pair& pair : far_) {
    const auto [one, two] = pair.collider;
    if (!held_.empty() && !(one == first[0] && is_triangle(two) && is_triangle(first[1]))) continue;
    if (!pair.pushed || !(pair.least > pair.overlooked + pair.bent) || !tried_.insert(pair.collider).second)
      continue;
    first = pair.collider;
    const auto kept = std::stable_partition(late_.begin(), late_.end(), [&](const ActiveContact& contact) {
      return !contact.meeting || contact.pair() != pair.collider;
    });
    held_.insert(held_.end(), kept, late_.end());
    late_.erase(kept, late_.end());
  }
  return !held_.empty();
}

/// True of a pair one of which is of the pair that is tried without its meetings.
bool ContactSearch::is_of_tried(const Pair& pair) const {
  if (held_.empty()) return false;
  const auto tried = held_.front().pair();
  return std::find_first_of(tried.begin(), tried.end(), pair.collider.begin(), pair.collider.end()) !=
         tried.end();
}

}  // namespace pbd
