// c = theta - theta0 modulo 2 pi, theta the dihedral angle at the edge (x0, x1) with the wings x2 and x3
// (scene.h). With n_a = (x1-x0) x (x2-x0), n_b = (x0-x1) x (x3-x1), L = |x1-x0| and t the projection of a
// wing onto the edge,
//   dtheta/dx2 = -L n_a/|n_a|^2,  dtheta/dx3 = -L n_b/|n_b|^2,
//   dtheta/dx0 = -(1-t2) dtheta/dx2 - (1-t3) dtheta/dx3,  dtheta/dx1 = -t2 dtheta/dx2 - t3 dtheta/dx3
// (bridson2003simulation). A wing without area has no direction: its part of J is 0.
#pragma once

#include "rows/constraint.h"
#include "rows/source.h"

namespace pbd {

template <>
struct Constraint<Bending> : ConstraintShape<1, 4> {
  static Nodes node(const Bending& effect, std::size_t i);
  static double compliance_scale(const Bending& effect, std::size_t i);
  static Square retardation(const Bending& effect, std::size_t i);
  static void evaluate(const Bending& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian);

  /// |e^T (d2theta/dx2) e| <= sum_ab s_a s_b |e_a| |e_b| with s the inverse heights of the wings and, for the
  /// edge's ends, what the heights' foot points leave them plus 1/L.
  static NodeBounds geometric_bound(const Bending& effect, std::size_t i, const Positions& x,
                                    const Value& impulse);
};

std::unique_ptr<Source> make_source(const Scene& scene, const Bending& effect);

}  // namespace pbd
