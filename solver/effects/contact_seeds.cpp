#include "effects/contact_seeds.h"

#include <algorithm>

namespace pbd {

void ContactSeeds::sort() {
  std::sort(seeds_.begin(), seeds_.end());
}

const Vec3* ContactSeeds::find(const std::array<int, 2>& collider, std::uint64_t key) const {
  const Seed wanted{collider, key, Vec3::Zero()};
  const auto seed = std::lower_bound(seeds_.begin(), seeds_.end(), wanted);
  return seed == seeds_.end() || wanted < *seed ? nullptr : &seed->impulse;
}

}  // namespace pbd
