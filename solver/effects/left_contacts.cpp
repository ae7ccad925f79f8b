#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/contact_search.h"

namespace pbd {

/// How far beside a shape its contacts may touch it, m: of what is tiny where it stands, by rounding.
double ContactSearch::beside(const std::array<int, 2>& pair) const {
  constexpr double rounded = 64 * std::numeric_limits<double>::epsilon();
  double size = 0;
  for (const int collider : pair) {
    const Motion& own = motions_[collider];
    size = std::max(size, own.centre.cwiseAbs().maxCoeff() + (std::isfinite(own.radius) ? own.radius : 0));
  }
  return besides_ * round_radius_of(motions_[pair[0]], motions_[pair[1]]) + rounded * size;
}

/// True if a collider is no farther from a point than `slack`, m.
bool ContactSearch::on_shape(int collider, const Vec3& point, const Configuration& at, double slack,
                             PairPoints& points) const {
  const Motion& own = motions_[collider];
  if (own.kind == Carrier::node) return true;  // it is round
  if (own.kind != Carrier::triangle)
    return is_at(*own.shape, placed_frame(collider, at), point, slack, points.scratch, points.found);
  points.found.clear();
  points.triangle.place(corners(own, at.x));
  generate(points.triangle, Sphere{slack}, {point, Eigen::Matrix3d::Identity()}, Reach{0}, points.scratch,
           points.found);
  return !points.found.empty();
}

/// True of what is endless and of surfaces, too.
bool ContactSearch::on_shapes(const ActiveContact& contact, const Configuration& at, double slack,
                              PairPoints& points) const {
  if (contact.of_surfaces) return true;
  const auto& [a, b] = contact.collider;
  if (std::isinf(motions_[a].radius) || std::isinf(motions_[b].radius)) return true;
  const Touching found = touching_at(contact, at);
  return on_shape(a, found.point_a, at, slack, points) && on_shape(b, found.point_b, at, slack, points);
}

bool ContactSearch::on_shapes(const ActiveContact& contact, const Configuration& at) {
  return on_shapes(contact, at, beside(contact.pair()), points_);
}

/// m, how far apart the convex shapes of a contact are along its normal.
double ContactSearch::apart_along_normal(const ActiveContact& contact, const Configuration& at) const {
  const Vec3 normal = touching_at(contact, at).normal;
  const auto least = [&](int side, const Vec3& direction) {
    const int collider = contact.collider[static_cast<std::size_t>(side)];
    return least_along(*motions_[collider].shape, placed_frame(collider, at), direction);
  };
  return least(0, normal) + least(1, -normal);
}

/// False of a contact of convex shapes of which one is round, where these are in each other by other
/// features, as where a ball has rolled from an edge over a face; of a contact whose normal does not turn as
/// it moves, where they are so along that, as where a rim has come to dip below the face that it touches.
bool ContactSearch::is_nearest(const ActiveContact& contact, const Configuration& start,
                               const Configuration& end) {
  using Kind = ContactPoint::Kind;
  const Kind kind = contact.features.kind;
  if (!goes_round_apart({contact.pair()}, 0)) return true;
  const double slack = beside(contact.pair()), gap = std::min(touching_at(contact, end).gap, 0.0);
  if (kind == Kind::face || kind == Kind::edges) {
    const auto& [a, b] = contact.collider;
    const double round = round_radius_of(motions_[a], motions_[b]);
    if (!(apart_along_normal(contact, end) < gap - overlooked_ * round)) return true;
  } else if (!(generate_between({contact.pair()}, start, end, 1, slack) < gap - slack)) {
    return true;
  }
  return !goes_round_apart(begun(contact.pair(), start), slack);
}

bool ContactSearch::is_left(const PairFeatures& features) const {
  return left_.contains(features);
}

/// True if two contacts of the same features say the same of a pair.
bool ContactSearch::agree(const ActiveContact& one, const ActiveContact& two, const Configuration& at,
                          double slack) const {
  const Touching first = touching_at(one, at), second = touching_at(two, at);
  return (first.normal - second.normal).norm() <= besides_ && std::abs(first.gap - second.gap) <= slack;
}

/// True if they agree, and touch at the same place.
bool ContactSearch::is_same(const ActiveContact& one, const ActiveContact& two, const Configuration& at) {
  const double slack = beside(one.pair());
  const Vec3 apart = touching_at(one, at).point_a - touching_at(two, at).point_a;
  return agree(one, two, at, slack) && apart.norm() <= slack;
}

/// True of a contact of two edges that is stated as a plane: where they cross goes on without it.
bool ContactSearch::is_crossing_as_plane(const ActiveContact& contact) {
  const std::uint64_t key = contact.features.key;
  return contact.features.kind == ContactPoint::Kind::face && first_of(key).of == Feature::edge &&
         second_of(key).of == Feature::edge;
}

/// A contact as the shapes state it at `end`, if they do, also where it has come apart.
std::optional<ActiveContact> ContactSearch::stated_at(const ActiveContact& contact,
                                                      const Configuration& start, const Configuration& end) {
  const Pair pair{contact.pair()};
  const auto& [first, second] = pair.collider;
  const double apart = std::max(touching_at(contact, end).gap, 0.0) + beside(pair.collider);
  generate_between(pair, start, end, 1, apart + travel_between(motions_[first], motions_[second]));
  for (const ContactPoint& point : points_.found) {
    const ActiveContact stated = active(point, pair.collider[0], pair.collider[1], points_.triangle);
    if (stated.features.key == contact.features.key) return stated;
  }
  return std::nullopt;
}

/// Puts a contact as it is stated in the place of what it was: it began the step as that did. Edges that turn
/// through parallel have their normal reversed where it begins, and tell nothing of that.
void ContactSearch::restate(const ActiveContact& contact, const Configuration& start, ActiveContact stated) {
  constexpr double alike = 0.9;  // cosine: half a radian
  const auto known = late_contact({contact.pair(), contact.features.key});
  const Touching was = touching_at(contact, start);
  const bool reversed = touching_at(stated, start).normal.dot(was.normal) < alike;
  stated.late = contact.late || reversed;
  stated.restated = true;
  stated.target = contact.late && known != late_.end() ? known->target : std::min(was.gap, 0.0);
  if (known == late_.end())
    late_.push_back(std::move(stated));
  else
    *known = std::move(stated);
}

/// A pair as the step begins, of which contacts beside their shapes tell.
ContactSearch::Pair ContactSearch::begun(const std::array<int, 2>& colliders, const Configuration& start) {
  Pair pair{colliders};
  pair.overlooked = beside(colliders);
  pair.nearest = generate_between(pair, start, start, 0, pair.overlooked);
  pair.deepest = pair.parted = std::min(pair.nearest, 0.0);
  return pair;
}

bool ContactSearch::find_met(const Configuration& start, const Configuration& free,
                             const ContactLists& contacts) {
  const std::size_t before = late_.size();
  std::array<int, 2> last{-1, -1};
  for (const auto& list : contacts)
    for (const ActiveContact& contact : list) {
      if (!contact.passes || contact.pair() == last) continue;
      last = contact.pair();
      const Pair pair = begun(last, start);
      overlapping_.clear();
      find_overlapping(pair, start, free);
      for (const ActiveContact& found : overlapping_) add_late(found, pair.deepest);
    }
  return late_.size() > before;
}

/// m, how far apart contacts of a pair act: under the convex law what slides hovers.
double ContactSearch::hovering(const std::vector<ActiveContact>& contacts, const Configuration& at) {
  double most = 0;
  for (const ActiveContact& contact : contacts)
    most = std::max(most, touching_at(contact, at).gap - contact.target);
  return most;
}

/// Of contacts of a pair that act beside their shapes at `end`, those that the shapes do not have there: what
/// lies corner on corner is beside its shapes by rounding, or by what a solved step misses, and stays.
void ContactSearch::keep_parted(const Configuration& start, const Configuration& end,
                                std::vector<ActiveContact>& contacts) {
  const Pair pair{contacts.front().pair()};
  const double slack = beside(pair.collider);
  generate_between(pair, start, end, 1, slack + hovering(contacts, end));
  std::erase_if(contacts, [&](const ActiveContact& contact) {
    return std::any_of(points_.found.begin(), points_.found.end(), [&](const ContactPoint& point) {
      const ActiveContact found = active(point, pair.collider[0], pair.collider[1], points_.triangle);
      return found.features.key == contact.features.key && agree(contact, found, end, slack);
    });
  });
}

/// Adds what touches of a pair at `end` to the late contacts, but for what has left its features, in the
/// place of those of its contacts that have.
void ContactSearch::add_touching(const std::vector<ActiveContact>& left, const Configuration& start,
                                 const Configuration& end, const Configuration& free) {
  const Pair pair = begun(left.front().pair(), start);
  if (left.front().law.restitution > 0) {
    overlapping_.clear();
    find_overlapping(pair, start, free);
  } else {
    const double reach = pair.overlooked + hovering(left, end);
    generate_between(pair, start, end, 1, reach);
    const double least = goes_round_apart(pair, pair.overlooked) ? -infinity : pair.deepest - pair.overlooked;
    keep_overlapping(pair, start, end, reach, least);
  }
  const auto place = [&](const ActiveContact& own) { return touching_at(own, end).point_a; };
  for (ActiveContact& found : overlapping_) {
    const PairFeatures features{pair.collider, found.features.key};
    if (is_left(features) || late_contact(features) != late_.end()) continue;
    const Vec3 here = place(found);
    const auto nearest = std::min_element(left.begin(), left.end(), [&](const auto& one, const auto& other) {
      return (place(one) - here).norm() < (place(other) - here).norm();
    });
    found.heir_of = nearest->features.key;
    add_late(found, std::min(nearest->target, pair.deepest));
  }
}

/// True of a contact of surfaces that acts beside its features.
bool ContactSearch::leaves(const ActiveContact& contact, const Points& x) const {
  return contact.of_surfaces && contact.acts && !(contact.restitution > 0) &&
         beside_features(contact.surface, touching(contact.surface, x));
}

/// True if contacts of surfaces leave the step. What they held and then passes, or overlaps, is found late.
bool ContactSearch::drop_left_surfaces(const Points& x, const ContactLists& contacts) {
  bool any = false;
  for (const auto& list : contacts)
    for (const ActiveContact& contact : list) {
      if (!leaves(contact, x)) continue;
      any = true;
      left_surfaces_.insert(contact.surface.features());
      if (contact.late)
        std::erase_if(late_surfaces_,
                      [&](const PassedContact& late) { return late.contact.same_features(contact.surface); });
    }
  return any;
}

/// True if contacts act where their features are not, or state them as they are not. The first are left out
/// of the rest of the step, and `find` has their pairs looked at again; what then overlaps by the same
/// features keeps them. The others are stated anew.
bool ContactSearch::drop_left(const Configuration& start, const Configuration& end, const Configuration& free,
                              const ContactLists& contacts) {
  dropped_.clear();
  std::vector<std::vector<ActiveContact>> left;  // of each pair
  for (const auto& list : contacts)
    for (const ActiveContact& contact : list) {
      const PairFeatures features{contact.pair(), contact.features.key};
      if (contact.of_surfaces || contact.meeting || is_left(features)) continue;
      // However a solver shares the impulses of what touches.
      if (!contact.acts && touching_at(contact, end).gap > contact.target + beside(features.collider))
        continue;
      bool there = true;
      if (is_crossing_as_plane(contact)) {
        const auto stated = stated_at(contact, start, end);
        there = stated.has_value();
        if (there && stated->features.kind == ContactPoint::Kind::edges && !is_same(contact, *stated, end)) {
          dropped_.push_back(features.collider);
          restate(contact, start, *stated);
          continue;
        }
      }
      if (contact.restitution > 0 || (there && on_shapes(contact, end) && is_nearest(contact, start, end)))
        continue;
      if (left.empty() || left.back().front().pair() != features.collider) left.emplace_back();
      left.back().push_back(contact);
    }
  for (auto& of_pair : left) {
    keep_parted(start, end, of_pair);
    for (const ActiveContact& contact : of_pair) {
      const PairFeatures features{contact.pair(), contact.features.key};
      left_.insert(features);
      dropped_.push_back(features.collider);
      if (const auto late = late_contact(features); late != late_.end()) late_.erase(late);
    }
    if (!of_pair.empty()) add_touching(of_pair, start, end, free);
  }
  std::sort(dropped_.begin(), dropped_.end());
  return drop_left_surfaces(end.x, contacts) || !dropped_.empty();
}

}  // namespace pbd
