#include "feature_search.h"

#include <algorithm>
#include <cmath>

#include "between_surfaces.h"
#include "parting_planes.h"
#include "touching_sides.h"

namespace pbd::reference {

FeatureSearch::FeatureSearch(const Scene& scene, const Contact& contact)
    : surfaces_(surfaces_of(scene, contact)) {
  const auto side_of = [](const Surface& surface) {
    return Side{surface.corner.front().body, surface.corner.front().node};
  };
  const auto fixed = [&](const Surface& surface) {
    if (surface.deformable) return false;
    const Corner& corner = surface.corner.front();
    const bool turns =
        corner.body >= 0 && scene.bodies[static_cast<std::size_t>(corner.body)].inertia.allFinite();
    return std::isinf(scene.mass[static_cast<std::size_t>(corner.node)]) && !turns;
  };
  const std::size_t count = surfaces_.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i; k < count; ++k) {
      const Surface &a = surfaces_[i], &b = surfaces_[k];
      if (a.corner.empty() || b.corner.empty() || (fixed(a) && fixed(b))) continue;
      if (a.deformable && b.deformable) {
        if (contact.surfaces_touch) pairs_.push_back({i, k});
        continue;
      }
      const bool nodes = a.corner.front().body < 0 && b.corner.front().body < 0;
      const bool apart = nodes && !b.deformable && !contact.nodes_touch;
      if (i == k || apart || (a.plane && b.plane)) continue;
      if (!b.deformable) {
        if (may_touch(scene, contact, side_of(a), side_of(b))) pairs_.push_back({i, k});
        continue;
      }
      const int material = contact.material(static_cast<std::size_t>(b.side));
      std::vector<std::array<int, 3>> free;
      for (const std::size_t triangle : free_triangles(scene, contact, side_of(a)))
        if (contact.material(contact.collider.size() + contact.node.size() + triangle) == material)
          free.push_back(contact.triangle[triangle]);
      if (free.size() == b.face.size()) {
        pairs_.push_back({i, k});
      } else if (!free.empty()) {
        pairs_.push_back({i, surfaces_.size()});
        surfaces_.push_back(surface_of(free, b.radius, b.side));
      }
    }
  for (const auto& [i, k] : pairs_) {
    const auto one = static_cast<std::size_t>(surfaces_[i].side),
               other = static_cast<std::size_t>(surfaces_[k].side);
    yields_.push_back(contact.between(one, other).compliance > 0);
  }
}

void FeatureSearch::find(const Placement& start, const Placement& at, const Points& course,
                         const WaysOut& deep, std::vector<FeaturePair>& found) const {
  std::vector<PlacedSurface> placed;
  placed.reserve(surfaces_.size());
  Bounds all;
  for (const Surface& surface : surfaces_) {
    placed.emplace_back(surface, start, at);
    for (const Vec3& x : placed.back().x) all.add(x);
  }
  const double extent = (all.most - all.least).norm() / 20;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    const auto& [i, k] = pairs_[pair];
    const PlacedSurface &a = placed[i], &b = placed[k];
    const double depth = std::min({a.size(), b.size(), extent}) / (yields_[pair] ? of_yielding : of_hard);
    const auto ways_out =
        deep.find({std::min(a.surface.side, b.surface.side), std::max(a.surface.side, b.surface.side)});
    const bool in_each_other = ways_out != deep.end();
    const std::size_t first = found.size();
    find_between(a, b,
                 {start, at, found, a.moved + b.moved, depth, in_each_other ? &ways_out->second : nullptr});
    if (in_each_other || yields_[pair] || a.surface.deformable || b.surface.deformable) continue;
    const Vec3 way = course.col(a.surface.corner[0].node) - course.col(b.surface.corner[0].node);
    drop_parted(a, b, way, at, first, found);
  }
}

int FeatureSearch::side_at(int node) const {
  const auto has_node = [&](const Surface& own) {
    return own.deformable &&
           std::any_of(own.corner.begin(), own.corner.end(), [&](const Corner& c) { return c.node == node; });
  };
  const auto found = std::find_if(surfaces_.begin(), surfaces_.end(), has_node);
  return found == surfaces_.end() ? -1 : found->side;
}

bool FeatureSearch::on_both(const FeaturePair& pair, const Placement& at) const {
  const Nearest found = nearest(pair, at);
  const auto between_corners = [&](const std::array<double, 3>& weight) {
    return *std::min_element(weight.begin(), weight.end()) >= -beyond;
  };
  if (!between_corners(found.weight[0])) return false;
  if (pair.b.count < 3 || pair.b.deformable) return between_corners(found.weight[1]);
  const auto surface = std::find_if(surfaces_.begin(), surfaces_.end(),
                                    [&](const Surface& own) { return own.side == pair.name[3]; });
  if (surface->plane) return true;
  const PlacedSurface below(*surface, at, at);
  const auto number = static_cast<std::size_t>(pair.name[5]);
  return below.within_face(number, found.on_a, below.face_normal(number));
}

}  // namespace pbd::reference
