// Two features that touch or are about to: of each a point, the line through two, or the plane through three,
// rounded by a radius; or the rim of a cylinder, of which the point that is deepest in a plane, or nearest to
// a point, a line or another rim, touches (rim_points.h).
//
//   a, b  the points of both that are nearest to each other (of lines and planes that go on for ever)
//   n     the unit vector from b to a; across a plane, two lines, or a rim and what it crosses, it is known
//         where a = b, too, and keeps the side it had: out of a plane, and into the cylinder
//   gap = n . (a - b) - r_a - r_b, whose derivative by what carries a and b is n^T at these points
#pragma once

#include "rigid_rows.h"
#include "step_claim.h"
#include "touching_surface.h"

namespace pbd::reference {

struct ContactFeature {
  std::array<Corner, 3> corner;
  int count = 1;
  double radius = 0;  // m
  double rim = 0;     // m; if not 0 a circle about the one corner, and that to `axis` of its body, out of it
  Vec3 axis = Vec3::UnitZ();
  bool deformable = false;  // of a surface's triangle

  bool of_body() const { return corner[0].body >= 0; }
};

struct FeaturePair {
  ContactFeature a, b;           // a has at most as many corners as b
  double side = 1;               // of the normal of a plane, or of the product of both lines
  double half = 1;               // of a rim that a line or rim may cross twice, the place: 1 or -1
  std::array<int, 6> name{};     // side, kind and number of a's feature and b's
  std::array<int, 2> surface{};  // their sides
};

struct Nearest {
  double gap = 0;  // m
  Vec3 normal = Vec3::UnitZ();
  Vec3 place = Vec3::Zero();                      // m, where a force acts on both
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();  // m, of what is rounded
  std::array<std::array<double, 3>, 2> weight{};  // of the corners of a and b
  /// Sine of the angle at which two lines, or a rim and a line or rim, without radii cross.
  double crossing = 1;
};

using Places = std::array<Vec3, 3>;  // m, of as many corners as a feature has

/// Of a plane's three corners below or above `x`.
void weigh_plane(const Places& plane, const Vec3& x, std::array<double, 3>& weight);

/// Of the ends of two lines that are not parallel, where they are nearest to each other.
void weigh_lines(const Places& a, const Places& b, std::array<std::array<double, 3>, 2>& weight);

Vec3 placed(const Corner& corner, const Placement& at);

/// A force acts on bodies half way between what touches; on a face at the corner over it; beside a deformable
/// triangle in its middle plane, where its nodes take it up.
Nearest nearest(const FeaturePair& pair, const Placement& at);

/// Velocity of a against b where a force acts, by those of `state`, m/s.
Vec3 against(const FeaturePair& pair, const Nearest& found, const Placement& at, const State& state);

/// In rows: the normal, and two tangents seen from `reference`.
Eigen::Matrix3d directions_of(const Vec3& normal, const Vec3& reference);

}  // namespace pbd::reference
