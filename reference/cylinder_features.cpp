#include "cylinder_features.h"

#include <cmath>

namespace pbd::reference {
namespace {

/// Where a point is of a cylinder.
struct Place {
  int kind = feature_kind::edge;  // the side, a cap or a rim
  std::size_t end = 0;            // the cap or rim that is nearer; of the side 0
  bool inside = false;
};

Place place_of(const Surface& cylinder, const Placement& at, const Vec3& point) {
  const Vec3 low = placed(cylinder.corner[0], at), high = placed(cylinder.corner[1], at);
  const Vec3 axis = (high - low).normalized(), from = point - (low + high) / 2;
  const double z = axis.dot(from), over_side = (from - z * axis).norm() - cylinder.cylinder,
               over_cap = std::abs(z) - (high - low).norm() / 2;
  Place place;
  place.inside = over_side < 0 && over_cap < 0;
  if (over_side > 0 && over_cap > 0)
    place.kind = feature_kind::rim;
  else if (over_cap > over_side)
    place.kind = feature_kind::face;
  if (place.kind != feature_kind::edge && z >= 0) place.end = 1;
  return place;
}

/// Rims of a beside edges, the side or rims of b.
void rims_across(const PlacedSurface& a, const PlacedSurface& b, int kind, const Between& both) {
  both.each_near(a, feature_kind::rim, b, kind, [&](std::size_t end, std::size_t k) {
    FeaturePair pair = Between::pair_of(a, feature_kind::rim, end, b, kind, k);
    Vec3 before = Vec3::Constant(infinity);
    for (const int half : {-1, 1}) {
      pair.half = half;
      pair.name[2] = static_cast<int>(end) + (half > 0 ? 2 : 0);
      const Nearest found_at = nearest(pair, both.at);
      if ((found_at.on_a - before).norm() <= beyond * pair.a.rim) return;  // there is one alone
      before = found_at.on_a;
      const auto& along = found_at.weight[1];
      if (kind == feature_kind::edge && !(along[0] >= -beyond && along[1] >= -beyond)) continue;
      if (found_at.crossing > parallel &&
          a.lies_along(found_at.normal, found_at.on_a, feature_kind::rim, end, leaning) &&
          b.lies_along(-found_at.normal, found_at.on_b, kind, k, leaning))
        both.add_if(pair, both.depth);
    }
  });
}

}  // namespace

void corners_beside_cylinder(const PlacedSurface& other, const PlacedSurface& cylinder, const Between& both) {
  const auto near = [&](int kind, std::size_t i, std::size_t k) {
    FeaturePair pair = Between::pair_of(other, feature_kind::corner, i, cylinder, kind, k);
    Place place = place_of(cylinder.surface, both.at, other.x[i]);
    if (place.inside && both.ways_out == nullptr)
      if (const Place begun = place_of(cylinder.surface, both.start, placed(pair.a.corner[0], both.start));
          !begun.inside && begun.kind != feature_kind::rim)
        place = begun;
    if (place.kind == kind && place.end == k && (kind != feature_kind::rim || pair.a.radius > 0))
      both.add_if(pair, both.depth);
  };
  for (const int kind : {feature_kind::edge, feature_kind::face, feature_kind::rim})
    both.each_near(other, feature_kind::corner, cylinder, kind,
                   [&](std::size_t i, std::size_t k) { near(kind, i, k); });
}

void rims_across(const PlacedSurface& a, const PlacedSurface& b, const Between& both) {
  rims_across(a, b, feature_kind::edge, both);
  rims_across(b, a, feature_kind::edge, both);
  rims_across(a, b, feature_kind::rim, both);
}

}  // namespace pbd::reference
