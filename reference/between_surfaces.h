// The features of two surfaces that touch or may come to (feature_search.h).
#pragma once

#include "placed_surface.h"

namespace pbd::reference {

/// Where they are looked for, and which count.
struct Between {
  const Placement& start;
  const Placement& at;
  std::vector<FeaturePair>& found;
  double moved = 0;                             // m, by both since the start
  double depth = 0;                             // m, overlaps that count anyway
  const std::vector<Vec3>* ways_out = nullptr;  // of surfaces in each other, from the one of higher number

  double reach() const { return moved + depth; }

  /// Of these kinds and numbers.
  static FeaturePair pair_of(const PlacedSurface& a, int kind_a, std::size_t i, const PlacedSurface& b,
                             int kind_b, std::size_t k);

  /// f(i, k) for the features of both that are near.
  template <class F>
  void each_near(const PlacedSurface& a, int kind_a, const PlacedSurface& b, int kind_b, F&& f) const;

  /// What is deeper than `deepest` counts if it has come so deep since the start.
  void add_if(const FeaturePair& pair, double deepest) const;

  /// Corners or rims over faces.
  void points_over_faces(const PlacedSurface& a, int kind, const PlacedSurface& b) const;

  void edges_across_edges(const PlacedSurface& a, const PlacedSurface& b) const;

  /// Corners beside edges or corners, n being the way between them.
  void corners_beside(const PlacedSurface& a, const PlacedSurface& b, int kind) const;

 private:
  void take_side(FeaturePair& pair) const;
  bool leads_out(const FeaturePair& pair, const Vec3& normal) const;
  bool below_beside(const PlacedSurface& a, const PlacedSurface& b, std::size_t k,
                    const Nearest& found_at) const;
  bool came_from_beside(const FeaturePair& pair, const Surface& of_face, std::size_t k) const;
};

void find_between(const PlacedSurface& a, const PlacedSurface& b, const Between& both);

template <class F>
void Between::each_near(const PlacedSurface& a, int kind_a, const PlacedSurface& b, int kind_b, F&& f) const {
  const double apart = reach() + a.surface.radius + b.surface.radius;
  const auto& boxes_a = a.bounds[static_cast<std::size_t>(kind_a)];
  const auto& boxes_b = b.bounds[static_cast<std::size_t>(kind_b)];
  const auto near_all = [&](const std::vector<Bounds>& boxes, const PlacedSurface& other) {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (a.surface.plane || b.surface.plane || boxes[i].near(other.all, apart)) list.push_back(i);
    return list;
  };
  const auto list_b = near_all(boxes_b, a);
  for (const std::size_t i : near_all(boxes_a, b))
    for (const std::size_t k : list_b)
      if (b.surface.plane || boxes_a[i].near(boxes_b[k], apart)) f(i, k);
}

}  // namespace pbd::reference
