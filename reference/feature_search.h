// Which features of a scene's surfaces touch or may come to, by all pairs of them: nothing but boxes about
// them spares any.
//
//   corner over face     within it, or `beyond` its sides by a ten-thousandth of them: edges that lie on each
//                        other would come and go by rounding
//   edge across edge     at points of both
//   corner beside edge, corner beside corner   where one is rounded; at points of both
//
// A pair of features counts where each rigid surface lies on its side of the plane between them, as far as
// the corners next to its feature tell: those of rounded features exactly, of others but for `leaning` (rad),
// since what will lie flat comes down askew. Over a half space every corner counts, and it has none.
// Deformable surfaces touch each other by corners over faces, edges across edges and corners beside edges,
// these a thousandth longer than they are, and beside corners, without a corner in common. Edges that are
// `parallel` (rad) are left to their ends. Edges in a plane of their two faces are none. What cylinders touch
// is in cylinder_features.h.
#pragma once

#include "touching_features.h"

namespace pbd::reference {

class FeatureSearch {
 public:
  /// Parts of a size: as deep hard shapes are after a step that is missed, and yielding ones at rest.
  /// Opposite faces are a whole size apart, and no pair of theirs may count.
  static constexpr double of_hard = 50, of_yielding = 5;

  FeatureSearch(const Scene& scene, const Contact& contact);

  /// Appends the pairs that are valid at `at`, nearer than both surfaces have moved since `start` and a
  /// fiftieth of the smaller one (at most a thousandth of all together), and not deeper in each other than
  /// that fiftieth, of what yields a fifth, or than they have moved where they were not so deep at `start`.
  /// Sides of what is deformable are those of `start`. Features of rigid surfaces are not that another plane
  /// makes needless (parting_planes.h), by where velocities lead each node in the step, `course` (m). Those
  /// of `deep` are, surfaces in each other: with normals near their ways out however they were at `start`.
  void find(const Placement& start, const Placement& at, const Points& course, const WaysOut& deep,
            std::vector<FeaturePair>& found) const;

  /// The side of the deformable surface that has a node, -1 of none.
  int side_at(int node) const;

  /// True if what touches of a pair at `at` is on both of its features.
  bool on_both(const FeaturePair& pair, const Placement& at) const;

 private:
  std::vector<Surface> surfaces_;
  std::vector<std::array<std::size_t, 2>> pairs_;
  std::vector<bool> yields_;  // of each pair
};

}  // namespace pbd::reference
