// c = (e_uu, e_vv, 2 e_uv), the Green strain of a flat triangle. With the rest edges in their plane, Dm =
// [X1-X0, X2-X0] (2 x 2, u along X1-X0), F = [x1-x0, x2-x0] Dm^-1 (3 x 2) and y_1, y_2 the rows of Dm^-1, y_0
// = -(y_1 + y_2):
//   e_uu = (F_u.F_u - 1)/2, 2 e_uv = F_u.F_v;  de_uu/dx_i = y_i[u] F_u^T,  d(2 e_uv)/dx_i = y_i[v] F_u^T +
//   y_i[u] F_v^T.
// A = C^-1 / area, C^-1 = 1/(thickness Y) [1 -nu 0; -nu 1 0; 0 0 2(1+nu)] (plane stress).
#pragma once

#include "rows/constraint.h"
#include "rows/source.h"

namespace pbd {

template <>
struct Constraint<TriangleStrain> : ConstraintShape<3, 3> {
  static constexpr bool one_material = true;

  static Nodes node(const TriangleStrain& effect, std::size_t i);
  static const Positions& rest(const TriangleStrain& effect, std::size_t i);
  static double compliance_scale(const TriangleStrain& effect, std::size_t i);
  static Square unit_compliance(const TriangleStrain& effect);  // C^-1 over the thickness, m/N

  /// C^-1 C_d
  static Square retardation(const TriangleStrain& effect, std::size_t i);
  static void evaluate(const TriangleStrain& effect, std::size_t i, const Positions& x, Value& value,
                       Jacobian& jacobian);
  static NodeBounds geometric_bound(const TriangleStrain& effect, std::size_t i, const Positions& x,
                                    const Value& impulse);
  static Stiffness geometric_stiffness(const TriangleStrain& effect, std::size_t i, const Positions& x,
                                       const Value& impulse, bool convex);
};

std::unique_ptr<Source> make_source(const Scene& scene, const TriangleStrain& effect);

}  // namespace pbd
