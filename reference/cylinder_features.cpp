#include "cylinder_features.h"

#include <cmath>

#include "error.h"

namespace pbd::reference {
namespace {

enum class Part { side, cap, rim };

/// Where a point is of a cylinder.
struct Place {
  Part part = Part::side;
  std::size_t end = 0;  // the cap or rim that is nearer
  bool inside = false;
};

Place place_of(const Surface& cylinder, const Placement& at, const Vec3& point) {
  const Vec3 low = placed(cylinder.corner[0], at), high = placed(cylinder.corner[1], at);
  const Vec3 axis = (high - low).normalized(), from = point - (low + high) / 2;
  const double z = axis.dot(from), over_side = (from - z * axis).norm() - cylinder.cylinder,
               over_cap = std::abs(z) - (high - low).norm() / 2;
  Place place;
  place.end = z < 0 ? 0 : 1;
  place.inside = over_side < 0 && over_cap < 0;
  if (over_side > 0 && over_cap > 0)
    place.part = Part::rim;
  else
    place.part = over_cap > over_side ? Part::cap : Part::side;
  return place;
}

ContactFeature side_of(const Surface& cylinder) {
  ContactFeature feature;
  feature.corner = {cylinder.corner[0], cylinder.corner[1], {}};
  feature.count = 2;
  feature.radius = cylinder.cylinder;
  return feature;
}

ContactFeature rim_of(const Surface& cylinder, std::size_t end) {
  ContactFeature feature;
  feature.corner[0] = cylinder.corner[end];
  feature.rim = cylinder.cylinder;
  feature.axis = (cylinder.corner[1].place - cylinder.corner[0].place).normalized();
  return feature;
}

/// `pair` with its name, if it is near enough and not too deep.
void add_if(const BesideCylinder& both, FeaturePair pair, const std::array<int, 2>& own,
            const std::array<int, 2>& other, bool cylinder_first, std::vector<FeaturePair>& found) {
  const double gap = nearest(pair, both.at).gap;
  const double deepest = both.other.surface.plane ? infinity : both.depth;
  if (gap > both.moved + both.depth || gap < -deepest - both.moved) return;
  if (gap < -deepest && nearest(pair, both.start).gap < -deepest) return;
  const int side = both.cylinder.surface.side, beside = both.other.surface.side;
  pair.surface = cylinder_first ? std::array{side, beside} : std::array{beside, side};
  pair.name = cylinder_first ? std::array{side, own[0], own[1], beside, other[0], other[1]}
                             : std::array{beside, other[0], other[1], side, own[0], own[1]};
  found.push_back(pair);
}

constexpr int point = 0, edge = 1, face = 2, rim = 3;  // kinds of features in names

/// Rims over a half space.
void add_rims(const BesideCylinder& both, std::vector<FeaturePair>& found) {
  constexpr double flat = 1e-6;  // rad: what rim_corners miss of its depth is less than a tenth of that
  const Surface& cylinder = both.cylinder.surface;
  FeaturePair pair;
  pair.b = both.other.feature(face, 0);
  const Vec3 axis = (both.cylinder.x[1] - both.cylinder.x[0]).normalized();
  for (std::size_t end = 0; end < 2; ++end) {
    if (!(axis.cross(both.other.face_normal(0)).norm() > flat)) break;
    pair.a = rim_of(cylinder, end);
    add_if(both, pair, {rim, static_cast<int>(end)}, {face, 0}, true, found);
  }
  for (std::size_t k = 2; k < cylinder.corner.size(); ++k) {
    pair.a = both.cylinder.feature(point, k);
    add_if(both, pair, {point, static_cast<int>(k)}, {face, 0}, true, found);
  }
}

void add_point(const BesideCylinder& both, std::vector<FeaturePair>& found) {
  const Surface& cylinder = both.cylinder.surface;
  FeaturePair pair;
  pair.a = both.other.feature(point, 0);
  Place place = place_of(cylinder, both.at, both.other.x[0]);
  if (place.inside)
    if (const Place begun = place_of(cylinder, both.start, placed(pair.a.corner[0], both.start));
        !begun.inside && begun.part != Part::rim)
      place = begun;
  const int end = static_cast<int>(place.end);
  if (place.part == Part::side) {
    pair.b = side_of(cylinder);
    add_if(both, pair, {edge, 0}, {point, 0}, false, found);
  } else if (place.part == Part::cap) {
    pair.b = both.cylinder.feature(face, place.end);
    add_if(both, pair, {face, end}, {point, 0}, false, found);
  } else if (pair.a.radius > 0) {
    pair.b = rim_of(cylinder, place.end);
    add_if(both, pair, {rim, end}, {point, 0}, false, found);
  }
}

}  // namespace

void find_beside_cylinder(const BesideCylinder& both, std::vector<FeaturePair>& found) {
  if (both.other.surface.plane)
    add_rims(both, found);
  else
    add_point(both, found);
}

bool over_cap(const Surface& cylinder, const Placement& at, const Vec3& point) {
  const Vec3 low = placed(cylinder.corner[0], at), high = placed(cylinder.corner[1], at);
  const Vec3 axis = (high - low).normalized(), from = point - low;
  return (from - axis.dot(from) * axis).norm() <= (1 + beyond) * cylinder.cylinder;
}

void require_beside_cylinder(const Surface& one, const Surface& other) {
  if (!(one.cylinder > 0 || other.cylinder > 0)) return;
  const Surface& beside = one.cylinder > 0 ? other : one;
  const bool is_point = beside.edge.empty() && beside.face.empty() && !beside.deformable;
  if (!beside.plane && !is_point)
    throw SetupError("contact collider", "a cylinder beside another shape",
                     "points, spheres and half spaces beside it: this judge states no others");
}

}  // namespace pbd::reference
