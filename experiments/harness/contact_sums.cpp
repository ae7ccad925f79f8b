#include "harness/contact_sums.h"

#include <algorithm>

namespace pbdcheck {

ContactForceSum contact_force(const pbd::Contact& contact, const std::vector<pbd::ContactForce>& found,
                              int body, int other) {
  const auto is_of = [&](int side, int wanted) {
    const auto index = static_cast<std::size_t>(side);
    return index < contact.collider.size() && contact.collider[index].body == wanted;
  };
  ContactForceSum sum;
  for (const auto& each : found)
    for (const std::size_t side : {0, 1}) {
      if (!is_of(each.collider[side], body)) continue;
      if (other >= 0 && !is_of(each.collider[1 - side], other)) continue;
      const pbd::Vec3 force = side == 0 ? each.force : (-each.force).eval();
      sum.force += force;
      sum.friction += force - force.dot(each.normal) * each.normal;
    }
  return sum;
}

std::int64_t pressing(const std::vector<pbd::ContactForce>& found) {
  return std::count_if(found.begin(), found.end(), [](const auto& each) { return !each.force.isZero(0); });
}

std::optional<double> least_gap(const std::vector<pbd::ContactForce>& found) {
  std::optional<double> least;
  for (const auto& each : found) least = std::min(least.value_or(each.gap), each.gap);
  return least;
}

}  // namespace pbdcheck
