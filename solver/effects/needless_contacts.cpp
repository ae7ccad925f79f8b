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
  return plane.parts &&
         plane.apart - closing(other, overlooked) * plane.normal.dot(other.normal) >= -overlooked;
}

}  // namespace

/// The plane along a normal from the second one of a pair. It parts the shapes if it does where the step
/// begins and where their courses lead.
PairPlane ContactSearch::plane_along(const std::array<int, 2>& pair, const Vec3& normal,
                                     double overlooked) const {
  const Motion &one = motions_[pair[0]], &two = motions_[pair[1]];
  const double apart =
      least_along(*one.shape, one.frame, normal) + least_along(*two.shape, two.frame, -normal);
  const double closed = std::min(normal.dot(one.course - two.course), 0.0);
  return {.normal = normal, .apart = apart, .parts = apart + closed >= -overlooked};
}

/// A contact with its normal from the second one of the pair.
void ContactSearch::add_to_planes(const Touching& contact, const std::array<int, 2>& pair, double overlooked,
                                  PairPoints& points) const {
  constexpr double alike = 1e-6;  // rad: what a direction is known to (tolerances.h)
  const auto same = [&](const PairPlane& plane) { return (plane.normal - contact.normal).norm() <= alike; };
  auto plane = std::find_if(points.planes.begin(), points.planes.end(), same);
  if (plane == points.planes.end())
    plane = points.planes.insert(plane, plane_along(pair, contact.normal, overlooked));
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

/// Adds a plane that parts the shapes, if what touches where the features of one have met tells of any: these
/// go on so far that what is over each other there is no sliver.
void ContactSearch::find_parting(const PairPlane& plane, const std::array<int, 2>& pair, double overlooked,
                                 PairPoints& points) const {
  constexpr double over = 0.1;  // of the round radius
  const Motion &one = motions_[pair[0]], &two = motions_[pair[1]];
  Frame met = two.frame;
  met.origin += (plane.gap + over * round_radius_of(one, two)) * plane.normal;
  find_points(pair, one.frame, met, {effect_.margin + travel_between(one, two), 0}, points);
  for (const ContactPoint& point : points.found) {
    const Vec3 normal = point.swapped ? Vec3(-touching(point, met, one.frame).normal)
                                      : touching(point, one.frame, met).normal;
    const PairPlane other = plane_along(pair, normal, overlooked);
    if (parts(other, plane, overlooked)) return points.planes.push_back(other);
  }
}

/// Marks which contacts of two bodies are needless. What touches over an area has no other plane; of the rest
/// another one is looked for where the nearest have met.
void ContactSearch::find_needless(std::span<ActiveContact> contacts, const Configuration& start,
                                  PairPoints& points) const {
  if (contacts.empty() || contacts.front().law.compliance > 0) return;
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
  const auto is_needless = [&](const PairPlane& plane) {
    return !(plane.area && plane.apart >= -overlooked) &&
           std::any_of(points.planes.begin(), points.planes.end(),
                       [&](const PairPlane& other) { return parts(other, plane, overlooked); });
  };
  const PairPlane* nearest = nullptr;
  for (const PairPlane& plane : points.planes)
    if (!plane.area && !is_needless(plane) && (nearest == nullptr || plane.gap < nearest->gap))
      nearest = &plane;
  if (nearest != nullptr) find_parting(*nearest, pair, overlooked, points);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    contacts[i].needless = is_needless(points.planes[points.plane_of[i]]);
}

}  // namespace pbd
