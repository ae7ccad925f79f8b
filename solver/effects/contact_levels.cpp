// In which planes the impulses of faces act.
#include <algorithm>
#include <cmath>

#include "effects/active_contact.h"

namespace pbd {
namespace {

/// True if both are over one face, of which a mesh may have parallel ones.
bool over_one_face(const ActiveContact& one, const ActiveContact& two) {
  constexpr double rounding = 1e-12;
  const ContactPoint &a = one.features, &b = two.features;
  return !one.meeting && !two.meeting && a.kind == ContactPoint::Kind::face && b.kind == a.kind &&
         one.collider == two.collider &&
         (a.direction_b - b.direction_b).squaredNorm() <= rounding * rounding &&
         std::abs(a.direction_b.dot(a.point_b - b.point_b)) <=
             rounding * (a.point_b.norm() + b.point_b.norm());
}

}  // namespace

void find_levels(const Configuration& at, std::vector<ActiveContact>& contacts) {
  for (auto first = contacts.begin(); first != contacts.end();) {
    auto last = first;
    double nearest = infinity;
    for (; last != contacts.end() && last->pair() == first->pair(); ++last) {
      last->gap = touching_at(*last, at).gap;
      nearest = std::min(nearest, last->gap);
    }
    for (auto each = first; each != last; ++each) {
      each->level = each->restitution > 0 ? each->gap : nearest;
      for (auto other = first; each->restitution > 0 && other != last; ++other)
        if (over_one_face(*each, *other)) each->level = std::min(each->level, other->gap);
    }
    first = last;
  }
}

}  // namespace pbd
