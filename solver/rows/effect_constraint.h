// One constraint of an effect that states Constraint<E>: its columns, what it is evaluated at, what it holds.
#pragma once

#include <algorithm>

#include "rows/constraint.h"
#include "rows/dense.h"
#include "scene.h"

namespace pbd {

template <class E>
std::size_t constraint_count(const E& effect) {
  if constexpr (BodyEffect<E>)
    return effect.body.size();
  else
    return effect.node.size();
}

/// A of constraint i.
template <class E>
typename Constraint<E>::Square compliance_of(const E& effect, std::size_t i) {
  return Constraint<E>::compliance_scale(effect, i) * Constraint<E>::unit_compliance(effect);
}

/// True if constraint i's A is positive definite; else it is 0.
template <class E>
bool gives_way(const E& effect, std::size_t i) {
  return Constraint<E>::compliance_scale(effect, i) > 0;
}

/// True if some constraint has a retardation time.
template <class E>
bool any_damping(const E& effect) {
  if (!damped(effect)) return false;
  const std::size_t count = Constraint<E>::one_material ? std::min<std::size_t>(1, constraint_count(effect))
                                                        : constraint_count(effect);
  for (std::size_t i = 0; i < count; ++i)
    if (!Constraint<E>::retardation(effect, i).isZero(0)) return true;
  return false;
}

/// Columns of constraint i: its nodes, or two a body.
template <class E>
typename Constraint<E>::Nodes columns_of(const Scene& scene, const E& effect, std::size_t i) {
  using C = Constraint<E>;
  if constexpr (BodyEffect<E>) {
    typename C::Nodes columns{};
    std::size_t next = 0;
    for (const int body : C::body(effect, i)) {
      columns[next++] = scene.bodies[body].node;
      columns[next++] = scene.nodes() + body;
    }
    if constexpr (C::nodes > 2 * C::bodies) columns[next] = effect.node[i];
    return columns;
  } else {
    return C::node(effect, i);
  }
}

/// Positions (or velocities) of a constraint's nodes, one column a node.
template <std::size_t K>
Eigen::Matrix<double, 3, int(K)> positions_of(const std::array<int, K>& node, const Points& x) {
  Eigen::Matrix<double, 3, int(K)> local;
  for (std::size_t a = 0; a < K; ++a) local.col(a) = x.col(node[a]);
  return local;
}

/// What constraint i with these columns is evaluated at.
template <class E>
typename Constraint<E>::Positions local_at(const E& effect, std::size_t i,
                                           const typename Constraint<E>::Nodes& columns,
                                           const Configuration& at) {
  using C = Constraint<E>;
  if constexpr (BodyEffect<E>) {
    typename C::Positions own;
    std::size_t next = 0;
    for (const int body : C::body(effect, i)) own.body[next++] = &at.pose[body];
    if constexpr (C::nodes > 2 * C::bodies) own.node = at.x.col(columns.back());
    own.time = at.time;
    return own;
  } else {
    return positions_of(columns, at.x);
  }
}

/// Largest coordinate of constraint i, m; of bodies that turn also their radius of gyration, and the way that
/// this goes about the angle that it asks for, if it asks for one.
template <class E>
double largest_coordinate(const E& effect, std::size_t i, const typename Constraint<E>::Positions& at,
                          const typename Constraint<E>::Nodes& columns,
                          const std::vector<double>& inverse_mass) {
  if constexpr (BodyEffect<E>) {
    double most = at.node.size() > 0 ? at.node.cwiseAbs().sum() : 0.0, turn = 1;
    if constexpr (requires { Constraint<E>::angle_asked(effect, i, at.time); })
      turn = std::max(turn, std::abs(Constraint<E>::angle_asked(effect, i, at.time)));
    std::size_t next = 0;
    for (const Pose* pose : at.body) {
      most = std::max(most, pose->x.cwiseAbs().maxCoeff());
      const int rotation = columns[next + 1];
      if (inverse_mass[rotation] > 0) most = std::max(most, turn / pose->turn_per_arc.row(0).norm());
      next += 2;
    }
    return most;
  } else {
    return at.cwiseAbs().maxCoeff();
  }
}

/// The bounds of constraint i's force, infinite ones where it has none.
template <class E>
ForceBounds force_bounds(const E& effect, std::size_t i) {
  if constexpr (requires { effect.bounds; })
    if (!effect.bounds.empty()) return effect.bounds[i];
  return {-infinity, infinity};
}

/// c^T A^-1 c / 2, J; of a force with bounds what the spring holds until it yields, the largest of
/// -gamma c - A gamma^2 / 2 within them.
template <class E>
double held_energy(const E& effect, std::size_t i, const typename Constraint<E>::Value& value,
                   const typename Constraint<E>::Square& compliance) {
  const ForceBounds bounds = force_bounds(effect, i);
  if (bounds == ForceBounds{-infinity, infinity}) return value.dot(solve_definite(compliance, value)) / 2;
  const double gamma = std::clamp(-value[0] / compliance(0, 0), bounds[0], bounds[1]);
  return -gamma * value[0] - compliance(0, 0) * gamma * gamma / 2;
}

/// |c|, as far as an unlimited force must prevent it.
template <class E>
double unmet(const E& effect, std::size_t i, const typename Constraint<E>::Value& value) {
  const ForceBounds bounds = force_bounds(effect, i);
  if (bounds == ForceBounds{-infinity, infinity}) return value.norm();
  return value[0] > 0 ? (bounds[0] == -infinity ? value[0] : 0.0) : (bounds[1] == infinity ? -value[0] : 0.0);
}

/// J^T p of the p that `respond` makes of c, for effects that need no J for it, and for the others.
template <class E, class Positions, class Respond>
auto push_of(const E& effect, std::size_t i, const Positions& x, const Respond& respond) {
  using C = Constraint<E>;
  if constexpr (requires { typename C::Deformation; }) {
    const auto at = C::deformation(effect, i, x);
    return C::push(effect, at, respond(C::strain(effect, at)));
  } else {
    typename C::Value value;
    typename C::Jacobian jacobian;
    C::evaluate(effect, i, x, value, jacobian);
    return Eigen::Matrix<double, 3, C::nodes>((jacobian.transpose() * respond(value)).reshaped(3, C::nodes));
  }
}

}  // namespace pbd
