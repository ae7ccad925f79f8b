// c = |x1 - x0| - l0, J = [-u^T, u^T] with u = (x1 - x0)/|x1 - x0|.
// Coinciding ends have no direction; they are parted along x.
#pragma once

#include "rows/constraint.h"
#include "rows/kept_jacobians.h"
#include "rows/source.h"

namespace pbd {

template <>
struct Constraint<Distance> : ConstraintShape<1, 2> {
  static Nodes node(const Distance& effect, std::size_t i);
  static double compliance_scale(const Distance& effect, std::size_t i);
  static Square retardation(const Distance& effect, std::size_t i);
  static void evaluate(const Distance& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian);
  /// c, and J as rows keep it.
  static void linearise(const Distance& effect, std::size_t i, const Positions& x, Value& value,
                        LinkJacobians& jacobians, std::size_t row);
  /// c, and u.
  static Vec3 gradient(const Distance& effect, std::size_t i, const Positions& x, Value& value);

  /// d2c/dx2 = (I - u u^T)/length [1 -1; -1 1], of norm 2/length.
  static NodeBounds geometric_bound(const Distance& effect, std::size_t i, const Positions& x,
                                    const Value& impulse);

  static Stiffness geometric_stiffness(const Distance& effect, std::size_t i, const Positions& x,
                                       const Value& impulse, bool convex);
};

std::unique_ptr<Source> make_source(const Scene& scene, const Distance& effect);

}  // namespace pbd
