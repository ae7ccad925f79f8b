#include "parting_planes.h"

namespace pbd::reference {
namespace {

/// Least of m . x over a surface with an end, m.
double least_along(const PlacedSurface& own, const Vec3& m) {
  double least = infinity;
  for (const Vec3& x : own.x) least = std::min(least, m.dot(x));
  const Surface& surface = own.surface;
  if (surface.cylinder > 0)
    least = std::min(m.dot(own.x[0]), m.dot(own.x[1])) - surface.cylinder * m.cross(own.axis()).norm();
  return least - surface.radius;
}

struct PartingPlane {
  Vec3 normal;   // from b to a
  double apart;  // m
};

/// Those of faces that part the surfaces, also where `way` leads a, but for `overlooked` (m).
std::vector<PartingPlane> planes_between(const PlacedSurface& a, const PlacedSurface& b, const Vec3& way,
                                         double overlooked) {
  std::vector<PartingPlane> planes;
  for (const auto& [own, sign] : {std::pair{&a, -1.0}, std::pair{&b, 1.0}})
    for (std::size_t i = 0; i < own->surface.face.size(); ++i) {
      const Vec3 normal = sign * own->face_normal(i);
      const double apart = least_along(a, normal) + least_along(b, -normal);
      if (apart + std::min(normal.dot(way), 0.0) >= -overlooked) planes.push_back({normal, apart});
    }
  return planes;
}

}  // namespace

void drop_parted(const PlacedSurface& a, const PlacedSurface& b, const Vec3& way, const Placement& at,
                 std::size_t first, std::vector<FeaturePair>& found) {
  if (found.size() == first || a.surface.plane || b.surface.plane) return;
  constexpr double part = 1e-6, times = 10;
  const double overlooked = part * std::min(a.size(), b.size()), farther = times * overlooked;
  const std::vector<PartingPlane> planes = planes_between(a, b, way, overlooked);
  const auto parted = [&](const FeaturePair& pair) {
    const Nearest own = nearest(pair, at);
    const Vec3 closed = (pair.surface[0] == a.surface.side ? 1 : -1) * (own.gap + farther) * own.normal;
    return std::any_of(planes.begin(), planes.end(), [&](const PartingPlane& plane) {
      return plane.apart - plane.normal.dot(closed) >= -overlooked;
    });
  };
  found.erase(std::remove_if(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), parted),
              found.end());
}

}  // namespace pbd::reference
