// Contacts that another plane makes needless, as where a body slides flush from a table to the next one,
// whose side is in front of it: shapes that a plane parts stay apart along that, however their features meet
// along another one. The step has no rows of them before a solved iterate brings the shapes into each other.
#include <algorithm>

#include "collision/bounds.h"
#include "effects/contact_search.h"

namespace pbd {
namespace {

/// m, by which the features of a plane go on to where they have met: ten times what is overlooked beyond.
double closing(const PairPlane& plane, double overlooked) {
  constexpr double farther = 10;
  return plane.gap + farther * overlooked;
}

/// True if a plane parts the shapes, and does so where the features of another one have met, too.
bool parts(const PairPlane& plane, const PairPlane& other, double overlooked) {
  return plane.apart >= -overlooked &&
         plane.apart - closing(other, overlooked) * plane.normal.dot(other.normal) >= -overlooked;
}

}  // namespace

/// m, how far the shapes of a pair are apart where the step begins, along a normal from the second one.
double ContactSearch::apart_along(const std::array<int, 2>& pair, const Vec3& normal) const {
  const Motion &one = motions_[pair[0]], &two = motions_[pair[1]];
  return least_along(*one.shape, one.frame, normal) + least_along(*two.shape, two.frame, -normal);
}

/// A contact with its normal from the second one of the pair.
void ContactSearch::add_to_planes(const Touching& contact, const std::array<int, 2>& pair, double overlooked,
                                  PairPoints& points) const {
  constexpr double alike = 1e-6;
  const auto same = [&](const PairPlane& plane) { return (plane.normal - contact.normal).norm() <= alike; };
  auto plane = std::find_if(points.planes.begin(), points.planes.end(), same);
  if (plane == points.planes.end())
    plane = points.planes.insert(plane, {contact.normal, apart_along(pair, contact.normal)});
  points.plane_of.push_back(static_cast<std::size_t>(plane - points.planes.begin()));
  if (contact.gap < plane->gap - overlooked) {
    plane->gap = contact.gap;
    plane->at = contact.point_a;
    plane->along = Vec3::Zero();
    plane->area = false;
  }
  if (contact.gap > plane->gap + overlooked) return;
  Vec3 way = contact.point_a - plane->at;
  way -= plane->normal.dot(way) * plane->normal;
  if (plane->along.isZero(0) && way.norm() > overlooked) plane->along = way;
  plane->area |= plane->along.cross(way).norm() > overlooked * plane->along.norm();
}

/// Looks for planes where the features of one have met, and gone on so far that what is over each other there
/// is no sliver: true if one parts the shapes, which then is the last one.
bool ContactSearch::find_parting(PairPlane plane, const std::array<int, 2>& pair, double overlooked,
                                 PairPoints& points) const {
  constexpr double over = 0.1;  // of the round radius
  const Motion &one = motions_[pair[0]], &two = motions_[pair[1]];
  Frame met = two.frame;
  met.origin += (plane.gap + over * round_radius_of(one, two)) * plane.normal;
  find_points(pair, one.frame, met, {effect_.margin + travel_between(one, two), 0}, points);
  return std::any_of(points.found.begin(), points.found.end(), [&](const ContactPoint& point) {
    const Vec3 normal = point.swapped ? Vec3(-touching(point, met, one.frame).normal)
                                      : touching(point, one.frame, met).normal;
    PairPlane other{normal, apart_along(pair, normal)};
    if (!parts(other, plane, overlooked)) return false;
    points.planes.push_back(other);
    return true;
  });
}

/// Marks which contacts of two bodies are needless. What touches over an area has no other plane.
void ContactSearch::find_needless(std::span<ActiveContact> contacts, const Configuration& start,
                                  PairPoints& points) const {
  if (contacts.empty()) return;
  const std::array<int, 2> pair = contacts.front().pair();
  const Motion &one = motions_[pair[0]], &two = motions_[pair[1]];
  if (std::isinf(one.radius) || std::isinf(two.radius)) return;
  const double overlooked = overlooked_ * round_radius_of(one, two);
  points.planes.clear();
  points.plane_of.clear();
  for (const ActiveContact& contact : contacts) {
    Touching found = touching_at(contact, start);
    if (contact.collider != pair) found.normal = -found.normal;
    add_to_planes(found, pair, overlooked, points);
  }
  const auto apart = [&](const PairPlane& plane) { return plane.apart >= -overlooked; };
  if (std::none_of(points.planes.begin(), points.planes.end(), apart)) return;
  for (std::size_t i = 0, count = points.planes.size(); i < count; ++i) {
    const PairPlane plane = points.planes[i];
    if (plane.area && apart(plane)) continue;
    const auto parting = [&](const PairPlane& other) { return parts(other, plane, overlooked); };
    points.planes[i].needless = std::any_of(points.planes.begin(), points.planes.end(), parting) ||
                                find_parting(plane, pair, overlooked, points);
  }
  for (std::size_t i = 0; i < contacts.size(); ++i)
    contacts[i].needless = points.planes[points.plane_of[i]].needless;
}

}  // namespace pbd
