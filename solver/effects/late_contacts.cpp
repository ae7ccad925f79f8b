#include <algorithm>

#include "effects/contact_search.h"

namespace pbd {

double ContactSearch::gap_of(const ContactPoint& point, const Frame& at_first, const Frame& at_second) {
  return point.swapped ? touching(point, at_second, at_first).gap : touching(point, at_first, at_second).gap;
}

Frame ContactSearch::frame_between(int collider, const Configuration& start, const Configuration& end,
                                   double share) const {
  const Frame from = placed_frame(collider, start), to = placed_frame(collider, end);
  const Eigen::Quaterniond turned(from.rotation);
  return {from.origin + share * (to.origin - from.origin),
          turned.slerp(share, Eigen::Quaterniond(to.rotation)).toRotationMatrix()};
}

/// Sets `found_` to the points of a pair that are within reach at a share of the way from `start` to `end`;
/// returns the least gap, m.
double ContactSearch::generate_between(const Pair& pair, const Configuration& start, const Configuration& end,
                                       double share, double reach) {
  const auto [first, second] = pair.collider;
  const Frame at_first = frame_between(first, start, end, share),
              at_second = frame_between(second, start, end, share);
  found_.clear();
  generate(*motions_[first].shape, at_first, *motions_[second].shape, at_second, Reach{reach}, scratch_,
           found_);
  double least = infinity;
  for (const ContactPoint& point : found_) least = std::min(least, gap_of(point, at_first, at_second));
  return least;
}

/// Keeps of `found_` what overlaps at `end` by more than `allowed`, but not what lies behind where `start`
/// was.
void ContactSearch::keep_overlapping(const Pair& pair, const Configuration& start, const Configuration& end,
                                     double allowed, double behind) {
  const auto [first, second] = pair.collider;
  const Frame first_start = placed_frame(first, start), second_start = placed_frame(second, start),
              first_end = placed_frame(first, end), second_end = placed_frame(second, end);
  std::erase_if(found_, [&](const ContactPoint& point) {
    return !(gap_of(point, first_end, second_end) < allowed) ||
           gap_of(point, first_start, second_start) < behind;
  });
}

/// True if a pair overlaps at `end` as none of the step's contacts tells; sets `found_` to the points by
/// which it has come to, if any are found: shapes in each other tell how they part, not how they met, and
/// what has come over an edge would be thrown back across a face. Without any the step cannot be solved.
bool ContactSearch::find_overlapping(const Pair& pair, const Configuration& start, const Configuration& end) {
  constexpr int halvings = 15;  // of the way: less than `overlooked` of r where a shape goes as far as 3 r
  const Motion &one = motions_[pair.collider[0]], &two = motions_[pair.collider[1]];
  const double round = round_radius_of(one, two), slack = overlooked * round;
  const double rounded = 1e-12 * (one.radius + one.travel + two.radius + two.travel);
  const double behind = std::min(pair.deepest, -slack) - rounded;
  const double allowed = std::min(pair.least_end - rounded, behind);
  if (!(generate_between(pair, start, end, 1, slack) < allowed)) return false;
  double apart = 0, overlapping = 1;
  for (int k = 0; k < halvings; ++k) {
    const double middle = (apart + overlapping) / 2;
    (generate_between(pair, start, end, middle, slack) < behind ? overlapping : apart) = middle;
  }
  const double left = (overlapping - apart) * (one.travel + two.travel);
  for (const double share : {apart, 1.0}) {
    generate_between(pair, start, end, share, slack + left);
    keep_overlapping(pair, start, end, allowed, behind);
    if (!found_.empty()) break;
  }
  return true;
}

bool ContactSearch::look_again(const Configuration& start, const Configuration& end,
                               const ContactLists& contacts) {
  if (far_.empty()) return false;
  const auto in_order = [](const Pair& a, const Pair& b) { return a.collider < b.collider; };
  for (Pair& pair : far_) pair.least_end = infinity;
  for (const auto& list : contacts)
    for (const ActiveContact& contact : list) {
      if (contact.of_surfaces) continue;
      const auto pair = std::lower_bound(far_.begin(), far_.end(), Pair{contact.pair()}, in_order);
      if (pair == far_.end() || pair->collider != contact.pair()) continue;
      const double gap = touching(contact.features, frame_of(contact, 0, end), frame_of(contact, 1, end)).gap;
      pair->least_end = std::min(pair->least_end, gap);
    }
  bool seen = false;
  for (const Pair& pair : far_) {
    if (!find_overlapping(pair, start, end)) continue;
    seen = true;
    for (const ContactPoint& point : found_) {
      const auto known = late_contact(pair.collider, point.key);
      ActiveContact& contact = known == late_.end() ? late_.emplace_back() : *known;
      contact = active(point, pair.collider[0], pair.collider[1]);
      contact.late = true;
      contact.target = pair.deepest;
    }
  }
  return seen;
}

}  // namespace pbd
