// What every effect with rows states: Constraint<Effect> gives the value c(x) of constraint i, its Jacobian J
// = dc/dx and its compliance A, at the positions of the constraint's K nodes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>

#include "scene.h"

namespace pbd {

template <int R, int K>
struct ConstraintShape {
  static constexpr int rows = R;
  static constexpr int nodes = K;
  using Positions = Eigen::Matrix<double, 3, K>;     // one column a node, m
  using Value = Eigen::Matrix<double, R, 1>;         // c
  using Jacobian = Eigen::Matrix<double, R, 3 * K>;  // three columns a node
  using Square = Eigen::Matrix<double, R, R>;
  using Nodes = std::array<int, static_cast<std::size_t>(K)>;
};

/// Specialised by each effect with rows, derived from its ConstraintShape.
template <class Effect>
struct Constraint;

template <class Effect>
concept RowEffect = requires(const Effect& effect, std::size_t i,
                             const typename Constraint<Effect>::Positions& x,
                             typename Constraint<Effect>::Value& value,
                             typename Constraint<Effect>::Jacobian& jacobian) {
  { Constraint<Effect>::node(effect, i) } -> std::same_as<typename Constraint<Effect>::Nodes>;
  { Constraint<Effect>::compliance(effect, i) } -> std::same_as<typename Constraint<Effect>::Square>;
  Constraint<Effect>::evaluate(effect, i, x, value, jacobian);
};

/// Specialised by each effect that is a given force: adds the accelerations (m/s^2) of nodes with finite
/// mass.
template <class Effect>
struct Force;

template <class Effect>
concept ForceEffect = requires(const Effect& effect, const Scene& scene, Points& acceleration) {
  Force<Effect>::add(effect, scene, acceleration);
};

}  // namespace pbd
