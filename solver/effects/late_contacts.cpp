#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/contact_search.h"

namespace pbd {
namespace {

bool has_rows(const SurfaceContact& surfaces, const ContactLists& contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [&](const auto& list) {
    return std::any_of(list.begin(), list.end(), [&](const ActiveContact& each) {
      return each.of_surfaces && each.surface.same_features(surfaces);
    });
  });
}

}  // namespace

double ContactSearch::gap_of(const ContactPoint& point, const Frame& at_first, const Frame& at_second) {
  return point.swapped ? touching(point, at_second, at_first).gap : touching(point, at_first, at_second).gap;
}

/// Sets `overlapping_` to what of `points_.found` overlaps at `end` by more than `allowed`, but not what lies
/// behind where `start` was.
void ContactSearch::keep_overlapping(const Pair& pair, const Configuration& start, const Configuration& end,
                                     double allowed, double behind) {
  overlapping_.clear();
  for (const ContactPoint& point : points_.found) {
    const ActiveContact contact = active(point, pair.collider[0], pair.collider[1], points_.triangle);
    if (touching_at(contact, end).gap < allowed && touching_at(contact, start).gap >= behind)
      overlapping_.push_back(contact);
  }
}

/// True of a triangle that begins in a body by more than is overlooked: by which features, and how deep, is
/// told of it as it is nearest.
bool ContactSearch::begins_cut(const Pair& pair) const {
  return pair.deepest < -pair.overlooked && motions_[pair.collider[1]].kind == Carrier::triangle;
}

/// True of convex shapes that go round each other, and began apart but for `slack` (m): the features by which
/// they are in each other where the step ends hold, wherever these lay where it began.
bool ContactSearch::goes_round_apart(const Pair& pair, double slack) const {
  const auto& [first, second] = pair.collider;
  return (is_round(first) || is_round(second)) && is_convex(first) && is_convex(second) &&
         !(pair.nearest < -slack);
}

/// True of a body's shape without dents.
bool ContactSearch::is_convex(int collider) const {
  const Motion& own = motions_[collider];
  return own.kind == Carrier::body && !std::holds_alternative<ClosedMesh>(*own.shape);
}

bool ContactSearch::is_round(int collider) const {
  const Motion& own = motions_[collider];
  if (own.kind != Carrier::body) return own.kind == Carrier::node;
  return std::holds_alternative<Sphere>(*own.shape) || std::holds_alternative<Capsule>(*own.shape) ||
         std::holds_alternative<Cylinder>(*own.shape);
}

/// Sets `overlapping_` to what of `points_.found` overlaps at `end` by more than `allowed`, and by more than
/// at `start`: what ends less deep is on its way out, though other features were nearest there.
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
  constexpr int halvings =
      15;  // of the way: 1e-4 of r where a shape goes as far as 3 r; more diverge oftener
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
  const auto extent = [](const Motion& own) { return std::isfinite(own.radius) ? own.radius : 0; };
  const double travel = travel_between(one, two), rounded = 1e-12 * (extent(one) + extent(two) + travel);
  const double behind = std::min(pair.deepest, -slack) - rounded;
  const double bound = std::min(pair.parted, -slack) - rounded;
  // What its contacts tell of is theirs to hold, but not where their features lay behind the start: those ask
  // for no more than what they were then.
  const double missing = besides_ * (round + travel);  // by a solved step
  const double held = pair.gives_way ? -infinity : bound - missing;
  const double allowed = std::min(std::max(pair.least_end - rounded, held), bound);
  if (effect_.continuous && (pair.nearest > slack || is_fast(one, two)))
    return find_meetings(pair, start, end, allowed, slack);
  if (effect_.continuous && find_passed(pair, start, end, slack, cut_on_way(pair, start, end, slack)))
    return true;
  if (pair.left) {
    const double grazed = std::max(overlooked_ * round, travel * travel / (2 * round));
    // What clips a corner on its straight way, and ends where it may be, has passed nothing.
    if (pair.nearest > grazed && meets(pair, start, end, std::min(allowed, -grazed), grazed) &&
        !overlapping_.empty())
      return true;
  }
  const double gap = generate_between(pair, start, end, 1, slack);
  if (!(gap < allowed)) return false;
  double overlapping = 1;
  const double apart = entering(pair, start, end, behind, last_apart(pair, start, end, behind), overlapping);
  const double left = (overlapping - apart) * travel;
  // What touches as they come to overlap is how they met, wherever its planes and lines lie at the start; of
  // triangles they may lie far behind.
  const double least_met = two.kind == Carrier::triangle ? behind : -infinity;
  // What is round goes round the features that its contacts have left: these tell if nothing else does.
  const bool goes_round = is_round(pair.collider[0]) || is_round(pair.collider[1]);
  const auto told = [&](double at, double least, bool left_too) {
    generate_between(pair, start, end, at, slack + left);
    keep_overlapping(pair, start, end, allowed, least);
    if (!left_too)
      std::erase_if(overlapping_, [&](const ActiveContact& contact) {
        return is_left({contact.pair(), contact.features.key});
      });
    return !overlapping_.empty();
  };
  // What has neither come to a triangle's middle nor gone as far as it is wide is on the side from which it
  // came: so are its features there.
  const bool grazes = two.kind == Carrier::triangle && is_convex(pair.collider[0]) &&
                      !(pair.nearest < -slack) && gap > -effect_.thickness / 2 && travel < 2 * round;
  for (const bool left_too : {false, true}) {
    if (!left_too && !goes_round) continue;
    if (told(apart, behind, left_too) || told(1, behind, left_too) || told(apart, least_met, left_too))
      return true;
    if ((grazes || goes_round_apart(pair, slack)) && told(1, -infinity, left_too)) return true;
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

/// True if a late contact says the same of what overlaps: its row is solved, and the tolerance leaves the
/// rest; or if one states it as the shapes do at an end. Never of a meeting: each has a name of its own.
bool ContactSearch::is_told(const ActiveContact& found, const Configuration& at) {
  const auto known = late_contact({found.pair(), found.features.key});
  if (known == late_.end()) return false;
  return known->restated ||
         (touching_at(*known, at).gap < 0 && agree(*known, found, at, beside(found.pair())));
}

/// What the contacts tell of pairs that go far; and of bodies that began deep and have been left by a contact
/// how far they are to part, as their first ones asked.
void ContactSearch::see_contacts(const Configuration& end, const ContactLists& contacts) {
  const auto in_order = [](const Pair& a, const Pair& b) { return a.collider < b.collider; };
  for (Pair& pair : far_) pair.least_end = infinity, pair.parted = 0, pair.pushed = false, pair.bent = 0;
  for (const auto& list : contacts)
    for (const ActiveContact& contact : list) {
      if (contact.of_surfaces) continue;
      const auto pair = std::lower_bound(far_.begin(), far_.end(), Pair{contact.pair()}, in_order);
      if (pair == far_.end() || pair->collider != contact.pair()) continue;
      pair->least_end = std::min(pair->least_end, touching_at(contact, end).gap);
      pair->parted = std::min(pair->parted, contact.target);
      if (!contact.meeting || !contact.late || !contact.acts) continue;
      pair->pushed = true;
      pair->bent = std::max(pair->bent, bent(contact, end));
    }
  for (Pair& pair : far_) {
    const bool deep = pair.deepest < -pair.overlooked && motions_[pair.collider[1]].kind == Carrier::body;
    if (deep && !pair.gives_way && pair.least_end < infinity) parted_.try_emplace(pair.collider, pair.parted);
    const auto asked = parted_.find(pair.collider);
    const bool parts = pair.left && asked != parted_.end();
    pair.parted = parts ? std::max(asked->second, pair.deepest) : pair.deepest;
  }
}

bool ContactSearch::see_overlaps(const Configuration& start, const Configuration& end,
                                 const ContactLists& contacts) {
  if (far_.empty()) return false;
  see_contacts(end, contacts);
  met_.clear();
  bool seen = false, refuted = false;  // the trial without a pair's meetings
  for (Pair& pair : far_) {
    pair.least = 0;
    // What a contact that has just been dropped did is not where the pair will be.
    if (std::binary_search(dropped_.begin(), dropped_.end(), pair.collider)) continue;
    least_ = 0;
    if (!find_overlapping(pair, start, end)) {
      pair.least = least_;
      continue;
    }
    const bool unexplained = overlapping_.empty();
    std::erase_if(overlapping_, [&](const ActiveContact& found) { return is_told(found, end); });
    if (!unexplained && overlapping_.empty()) continue;
    seen = true;
    refuted |= is_of_tried(pair);
    if (!unexplained && overlapping_.front().meeting && pair.deepest == 0) {
      const double round = round_radius_of(motions_[pair.collider[0]], motions_[pair.collider[1]]);
      met_.push_back({pair.collider, touching_, round / way_between(pair, start, end), overlapping_});
      continue;
    }
    for (const ActiveContact& found : overlapping_) {
      const double began = begins_cut(pair) ? touching_at(found, start).gap : pair.deepest;
      add_late(found, std::min(pair.deepest, began));
    }
  }
  if (refuted) {
    late_.insert(late_.end(), held_.begin(), held_.end());
    held_.clear();
    return true;
  }
  add_first_met();
  return seen || let_go();
}

/// Adds what deformable surfaces passed or overlap by where a solved iterate ends, as none of their contacts
/// tells: a surface has no inside by which to see it later. What is near, has no rows and ends beside its
/// features counts as left: the late contact takes its place. On its features its gap calls it.
bool ContactSearch::see_passed(const Points& start, const Points& end, const ContactLists& contacts) {
  if (surfaces_clear_ || !surfaces_->searches()) return false;
  passed_.clear();
  const double slack = std::max(overlooked_of_surfaces, besides_) * effect_.thickness / 2;
  surfaces_->find_passed(threads_, start, end, slack, passed_);
  const std::size_t before = late_surfaces_.size();
  for (const PassedContact& found : passed_) {
    const auto same = [&](const SurfaceContact& other) { return other.same_features(found.contact); };
    const auto same_late = [&](const PassedContact& other) {
      return same(other.contact) && !other.contact.met;
    };
    if (std::any_of(late_surfaces_.begin(), late_surfaces_.end(), same_late)) continue;
    if (!is_left(found.contact) && std::any_of(surface_contacts_.begin(), surface_contacts_.end(), same)) {
      SurfaceContact stated = found.contact;
      stated.met.reset();
      const bool called = !beside_features(stated, touching(stated, end));
      if (called || has_rows(found.contact, contacts)) continue;
      left_surfaces_.insert(found.contact.features());
    }
    late_surfaces_.push_back(found);
  }
  return late_surfaces_.size() > before;
}

bool ContactSearch::look_again(const Configuration& start, const Configuration& end,
                               const Configuration& free, double tolerance, const ContactLists& contacts) {
  besides_ = std::max(tolerance, least_beside);
  const bool dropped = drop_left(start, end, free, contacts), seen = see_overlaps(start, end, contacts);
  const bool passed = see_passed(start.x, end.x, contacts);
  return dropped || seen || passed;
}

}  // namespace pbd
