// Impulses of a step's contacts by the names of their features: what those of the next step begin with.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "geometry.h"

namespace pbd {

class ContactSeeds {
 public:
  void clear() { seeds_.clear(); }

  /// `impulse` (N s) on the first collider's side, in the world.
  void add(const std::array<int, 2>& collider, std::uint64_t key, const Vec3& impulse) {
    seeds_.push_back({collider, key, impulse});
  }
  void sort();  // after the last one

  /// Null if there is none.
  const Vec3* find(const std::array<int, 2>& collider, std::uint64_t key) const;

 private:
  struct Seed {
    std::array<int, 2> collider;
    std::uint64_t key;
    Vec3 impulse;

    bool operator<(const Seed& other) const {
      return std::tie(collider, key) < std::tie(other.collider, other.key);
    }
  };
  std::vector<Seed> seeds_;
};

}  // namespace pbd
