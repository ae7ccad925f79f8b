// What each effect of a scene is: its constraint value, stated once for numbers and for jets.
//
// Every constraint depends on its K nodes through a matrix F with Q columns,
//   F = sum_a x_a w_a^T  (3 x Q),  w constant (K x Q):
//
//   anchor    F = x, c = F - target (3 rows, m)
//   distance  F = x1 - x0, c = |F| - rest length (1 row, m)
//   bending   F = [x1-x0, x2-x0, x3-x0], c = theta(F) - rest angle in (-pi, pi] (1 row, rad)
//   triangle  F = deformation gradient (3 x 2), c = (E11, E22, 2 E12), E = (F^T F - I)/2 (3 rows)
//   green     F = deformation gradient (3 x 3), c = (E11, E22, E33, 2 E12, 2 E23, 2 E31) (6 rows)
//   linear    likewise with (F + F^T)/2 - I
//
// Corotational strain, with S - I, is in polar.h, being no formula in F.
#pragma once

#include "jet.h"

namespace pbd::reference {

/// Angle between the normals of the triangles (0, e1, e2) and (e1, 0, e3) about e1, rad.
template <class T>
T hinge_angle(const Triple<T>& e1, const Triple<T>& e2, const Triple<T>& e3) {
  using std::atan2;
  using std::sqrt;
  const Triple<T> back{e1[0] * -1.0, e1[1] * -1.0, e1[2] * -1.0};
  const Triple<T> normal_a = cross(e1, e2), normal_b = cross(back, minus(e3, e1));
  const T sine = dot(cross(normal_a, normal_b), e1) * inverse(sqrt(dot(e1, e1)));
  return atan2(sine, dot(normal_a, normal_b));
}

template <class T>
T length(const Triple<T>& difference) {
  using std::sqrt;
  return sqrt(dot(difference, difference));
}

template <class T>
std::array<T, 3> green_strain(const std::array<Triple<T>, 2>& f) {
  return {(dot(f[0], f[0]) - T(1)) * 0.5, (dot(f[1], f[1]) - T(1)) * 0.5, dot(f[0], f[1])};
}

template <class T>
std::array<T, 6> green_strain(const std::array<Triple<T>, 3>& f) {
  return {(dot(f[0], f[0]) - T(1)) * 0.5,
          (dot(f[1], f[1]) - T(1)) * 0.5,
          (dot(f[2], f[2]) - T(1)) * 0.5,
          dot(f[0], f[1]),
          dot(f[1], f[2]),
          dot(f[2], f[0])};
}

/// f[j][i] = F_ij.
template <class T>
std::array<T, 6> linear_strain(const std::array<Triple<T>, 3>& f) {
  return {f[0][0] - T(1),    f[1][1] - T(1),    f[2][2] - T(1),
          f[1][0] + f[0][1], f[2][1] + f[1][2], f[0][2] + f[2][0]};
}

}  // namespace pbd::reference
