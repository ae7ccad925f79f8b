#include "studies/robustness/lump.h"

#include "scenes/body_shapes.h"

namespace pbdcheck {

pbd::TriangleMesh lump(Random& random, bool hollow) {
  pbd::Points x(3, 6 + random.below(7));
  for (int i = 0; i < 6; ++i) x.col(i) = (i % 2 == 0 ? 1.0 : -1.0) * pbd::Vec3::Unit(i / 2);
  for (Eigen::Index i = 6; i < x.cols(); ++i) x.col(i) = random.direction();
  pbd::TriangleMesh surface = convex_hull(x);
  const double size = random.uniform(0.15, 0.4);
  for (Eigen::Index i = 0; i < surface.x.cols(); ++i)
    surface.x.col(i) *= size * (hollow ? random.uniform(0.5, 1) : 1);
  return surface;
}

}  // namespace pbdcheck
