// Points and segments beside the triangles of a closed mesh, in its frame: how far, in it or not, and through
// which. Lengths in m.
#pragma once

#include "shapes.h"

namespace pbd::reference {

struct Segment {
  Vec3 from, to;
};

std::array<Vec3, 3> corners(const ClosedMesh& mesh, const std::array<int, 3>& triangle);

/// Of the nearest point (ericson2005collision, 5.1.5).
double distance_of_segment(const Vec3& x, const Segment& segment);
bool is_over(const Vec3& x, const std::array<Vec3, 3>& corner);
double distance_of_triangle(const Vec3& x, const std::array<Vec3, 3>& corner);
double distance_of_mesh(const ClosedMesh& mesh, const Vec3& x);

/// By the winding number, the sum of the triangles' solid angles over 4 pi (vanoosterom1983solid).
bool holds(const ClosedMesh& mesh, const Vec3& x);

/// Where the segment goes through the triangle's inside, in shares of it; infinite where it does not.
double crossing(const Segment& segment, const std::array<Vec3, 3>& corner);

/// Where the segment goes through the mesh's triangles, in shares of it, both ends among them.
std::vector<double> crossings(const ClosedMesh& mesh, const Segment& segment);

}  // namespace pbd::reference
