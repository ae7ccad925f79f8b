// What every effect with rows states. At the positions of constraint i's K nodes Constraint<Effect> gives
//   its value c(x), its Jacobian J = dc/dx and its compliance A = compliance_scale(effect, i)
//   unit_compliance(effect), the retardation time T of its damping, asked for where the effect lists any, and
//   a bound B (N s/m, one a node) of the geometric stiffness of its impulses p:
//     -sum_r p_r e^T (d2c_r/dx2) e <= sum_a B_a |e_a|^2  for every displacement e of its nodes.
// Only the stiffening part counts (tension, not compression): B = 0 where p = 0. An effect whose stiffness
// depends on a rest shape states its positions, rest(effect, i). One whose rows leave directions free may
// state that stiffness itself, geometric_stiffness(effect, i, x, p, convex): -sum_r p_r d2c_r/dx2 (N s/m),
// all of it, or what of it is positive semidefinite. One whose forces may have bounds states
// approach(effect, i, x, gap): how much of `gap`, the way of c to its stop (above 0), its bodies close by a
// metre, a unit of turn and a second.
#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstddef>

#include "rows/bodies.h"
#include "scene.h"

namespace pbd {

template <int R, int K>
struct ConstraintShape {
  static constexpr int rows = R;
  static constexpr int nodes = K;
  static constexpr bool fills_space = false;         // stiff in every direction, as a solid's rows are
  static constexpr bool one_material = false;        // T is the same for all its constraints
  using Positions = Eigen::Matrix<double, 3, K>;     // one column a node, m
  using Value = Eigen::Matrix<double, R, 1>;         // c
  using Jacobian = Eigen::Matrix<double, R, 3 * K>;  // three columns a node
  using Square = Eigen::Matrix<double, R, R>;
  using Stiffness = Eigen::Matrix<double, 3 * K, 3 * K>;
  using Nodes = std::array<int, K>;
  using NodeBounds = Eigen::Matrix<double, 1, K>;  // of the geometric stiffness, one a node

  /// What the compliances of all of an effect's constraints are a number each times. Only an effect of
  /// several rows and `one_material` has another one than 1.
  template <class Effect>
  static Square unit_compliance(const Effect&) {
    return Square::Identity();
  }
};

/// A constraint of B rigid bodies and P nodes: two nodes a body, its centre of mass and its rotation, then
/// the other nodes. Its Jacobian has for a body the columns dc/dx and dc/dphi R/r (bodies.h).
template <int R, int B, int P = 0>
struct BodyConstraintShape : ConstraintShape<R, 2 * B + P> {
  static constexpr int bodies = B;
  struct Positions {
    std::array<const Pose*, B> body;
    Eigen::Matrix<double, 3, P> node;
    double time;  // s
  };
};

/// Specialised by each effect with rows, derived from its ConstraintShape.
template <class Effect>
struct Constraint;

template <class Effect>
concept BodyEffect = requires {
  Constraint<Effect>::bodies;
};

template <class Effect>
concept RowEffect = requires(const Effect& effect, std::size_t i,
                             const typename Constraint<Effect>::Positions& x,
                             typename Constraint<Effect>::Value& value,
                             typename Constraint<Effect>::Jacobian& jacobian) {
  {
    Constraint<Effect>::geometric_bound(effect, i, x, value)
    } -> std::same_as<typename Constraint<Effect>::NodeBounds>;
  requires BodyEffect<Effect> || requires {
    { Constraint<Effect>::node(effect, i) } -> std::same_as<typename Constraint<Effect>::Nodes>;
  };
  { Constraint<Effect>::compliance_scale(effect, i) } -> std::same_as<double>;
  { Constraint<Effect>::unit_compliance(effect) } -> std::same_as<typename Constraint<Effect>::Square>;
  { Constraint<Effect>::retardation(effect, i) } -> std::same_as<typename Constraint<Effect>::Square>;
  Constraint<Effect>::evaluate(effect, i, x, value, jacobian);
};

/// Where a step begins, as given forces see it.
struct ForceBegin {
  const Bodies& bodies;
  const std::vector<Pose>& pose;
  const Points& v;       // of all columns
  bool explicit_forces;  // of the integrator
};

/// Specialised by each effect that is a given force: adds the accelerations (m/s^2) of columns with finite
/// mass.
template <class Effect>
struct Force;

template <class Effect>
concept ForceEffect = requires(const Effect& effect, const Scene& scene, const ForceBegin& begin,
                               Points& acceleration) {
  Force<Effect>::add(effect, scene, begin, acceleration);
};

}  // namespace pbd
