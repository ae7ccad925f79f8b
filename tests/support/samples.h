// One sample of each effect with rows, in a scene of its own: derivative tests run over the list of effects,
// so an effect without a sample does not compile.
#pragma once

#include "effects/effects.h"
#include "mesh.h"

namespace pbd::test {

template <class E>
E sample();

/// The constraint of an effect's first entry, c(x).
template <class E>
typename Constraint<E>::Value value_at(const E& effect, const typename Constraint<E>::Positions& x) {
  typename Constraint<E>::Value value;
  typename Constraint<E>::Jacobian jacobian;
  Constraint<E>::evaluate(effect, 0, x, value, jacobian);
  return value;
}

template <>
inline Anchor sample<Anchor>() {
  return {.node = {0}, .target = {Vec3(0.1, -0.2, 0.3)}, .compliance = {1e-3}};
}

template <>
inline Distance sample<Distance>() {
  return {.node = {{0, 1}}, .rest_length = {0.9}, .compliance = {1e-3}};
}

template <>
inline Bending sample<Bending>() {
  return {.node = {{0, 1, 2, 3}}, .rest_angle = {0.4}, .compliance = {0.1}};
}

template <>
inline TriangleStrain sample<TriangleStrain>() {
  Eigen::Matrix3d rest;
  rest << 0, 1.1, 0.2, 0, 0.1, 0.9, 0, 0.2, -0.1;
  return {.node = {{0, 1, 2}}, .rest = {rest}, .material = {2e4, 0.3}, .thickness = 1e-2};
}

template <>
inline TetStrain sample<TetStrain>() {
  Eigen::Matrix<double, 3, 4> rest;
  rest << 0, 1.1, 0.2, 0.1, 0, 0.1, 0.9, -0.1, 0, 0.2, -0.1, 1.2;
  return {.node = {{0, 1, 2, 3}}, .rest = {rest}, .material = {2e4, 0.3}, .strain = Strain::green};
}

/// Positions of the K nodes away from any special configuration; `seed` picks one of many.
template <int K>
Eigen::Matrix<double, 3, K> bent_positions(int seed) {
  Eigen::Matrix<double, 3, 4> base;
  base << 0, 1, 0.1, 0.2, 0, 0.1, 1, -0.9, 0, 0.1, 0.2, 0.9;
  Eigen::Matrix<double, 3, K> x = base.leftCols<K>();
  for (int a = 0; a < K; ++a)
    for (int axis = 0; axis < 3; ++axis) x(axis, a) += 0.15 * std::sin(1.7 * seed + 2.3 * a + 3.1 * axis);
  return x;
}

}  // namespace pbd::test
