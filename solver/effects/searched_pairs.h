// What the search of contacts (contact_search.h) keeps of pairs of colliders.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <span>
#include <tuple>
#include <vector>

#include "collision/generate.h"
#include "effects/active_contact.h"

namespace pbd {

/// A pair that goes far in a step, so that it is looked at again.
struct FarPair {
  std::array<int, 2> collider;
  double nearest = infinity;    // m, gap as it begins
  double deepest = 0;           // m, the same, at most 0: what overlaps gets no deeper
  double overlooked = 0;        // m, depth that is not looked at
  bool left = false;            // by a contact that had held it apart
  bool gives_way = false;       // by its law's compliance
  double parted = 0;            // m, gap that it may end with
  double least_end = infinity;  // m, gap that its contacts tell of
  bool pushed = false;          // by something that it met
  double bent = 0;              // m, by which turns take what pushes it off how its gap goes on
  double least = 0;             // m, gap on its way
};

/// What met on a way.
struct MetPair {
  std::array<int, 2> collider;
  double share, window;  // of the way, at which they meet, and that they go a round radius in
  std::vector<ActiveContact> contacts;
};

/// A pair that is near where a step begins.
struct NearPair {
  std::array<int, 2> collider;
  double nearest;   // m, gap where the step begins
  std::size_t end;  // of its contacts in `near_`
};

/// A plane that may part the shapes of a pair, and what contacts with its normal are nearest.
struct PairPlane {
  Vec3 normal;             // unit, from the second one to the first
  double apart;            // m, of the shapes along it where the step begins; negative: they overlap
  bool parts = false;      // them, there and on their courses
  double gap = infinity;   // m, the least one of contacts
  Vec3 at = Vec3::Zero();  // m, a place of that gap
  Vec3 along = at;         // m, the way to another one, or 0
  bool area = false;       // places are on no line
};

/// The points of one pair, and the room to find them.
struct PairPoints {
  std::vector<ContactPoint> found;
  CollisionScratch scratch;
  RoundedTriangle triangle;  // the one that was placed last
  std::vector<PairPlane> planes;
  std::vector<std::size_t> plane_of;  // each contact
};

/// A pair found before or now, and its contacts.
struct NearView {
  std::array<int, 2> collider;
  double nearest;
  std::span<const ActiveContact> contacts;
};

/// A part of the pairs that are searched, and what is near of them.
struct SearchTask {
  PairPoints points;
  std::vector<NearPair> pairs;
  std::vector<ActiveContact> near;
};

/// The name of a contact.
struct PairFeatures {
  std::array<int, 2> collider;  // the lower one first
  std::uint64_t key;            // of its features

  auto operator<=>(const PairFeatures&) const = default;  // NOLINT(modernize-use-nullptr): compares with 0
};

/// Of a contact: the same for all triangles that share the feature.
struct TriangleName {
  int body;  // as the effect counts colliders
  std::uint64_t key;
  bool early;     // neither late nor restated: those are kept before it
  std::size_t i;  // in its list

  bool operator<(const TriangleName& other) const {
    return std::tie(body, key, early, i) < std::tie(other.body, other.key, other.early, other.i);
  }
};

/// m, of what `within(reach)` finds, its least gap: the farther it looks, the farther beside each other are
/// features that say less than how far the shapes are apart, so that what seems to touch is looked at
/// again.
template <class Within>
double gap_by_reach(const Within& within, double reach, double slack) {
  constexpr double farther = 4;
  double gap = within(reach), least = -infinity;
  constexpr double rounding = 1e-12;
  for (double nearer = std::max(2 * slack, rounding * reach); !(gap > slack) && nearer < reach;
       nearer *= farther) {
    if (const double found = within(nearer); std::isfinite(found)) return std::max(found, least);
    least = nearer;
  }
  return std::max(gap, least);
}

}  // namespace pbd
