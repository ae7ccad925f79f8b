// Rows of one effect: constraints of R rows and K nodes each (rows.h).
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "friction.h"
#include "rows/chunks.h"
#include "rows/constraint.h"
#include "rows/kept_jacobians.h"
#include "rows/scaled_squares.h"

namespace pbd {

/// What an impulse may be: as its bounds and its law of friction let it, anything, or nothing.
enum class Freedom : std::uint8_t { lawful, free, held };

/// Of an impulse (R = 1), or of a contact's normal one, while it is `lawful`.
struct Bounds {
  double lower = 0, upper = infinity;  // N s
  Freedom freedom = Freedom::lawful;
};

/// Links and tetrahedra alone have their shapes.
template <int R, int K>
struct JacobiansOf {
  using Type = std::vector<typename ConstraintShape<R, K>::Jacobian>;
  static constexpr std::size_t bytes_of_each = sizeof(typename ConstraintShape<R, K>::Jacobian);
};
template <>
struct JacobiansOf<1, 2> {
  using Type = LinkJacobians;
  static constexpr std::size_t bytes_of_each = LinkJacobians::bytes_of_each;
};
template <>
struct JacobiansOf<6, 4> {
  using Type = StrainJacobians;
  static constexpr std::size_t bytes_of_each = StrainJacobians::bytes_of_each;
};

template <int R, int K>
struct RowBlock : ConstraintShape<R, K> {
  using Shape = ConstraintShape<R, K>;
  using Velocities = Eigen::Matrix<double, 3 * K, 1>;
  using Jacobians = typename JacobiansOf<R, K>::Type;

  static constexpr bool keeps_matrices = std::is_same_v<Jacobians, std::vector<typename Shape::Jacobian>>;
  static constexpr std::size_t row_bytes = JacobiansOf<R, K>::bytes_of_each + sizeof(typename Shape::Square) +
                                           sizeof(double) +
                                           2 * sizeof(typename Shape::Value);  // of a constraint, about

  std::vector<std::size_t> entries;  // of the effect that are rows; empty if all are
  std::vector<typename Shape::Nodes> node;
  Jacobians jacobian;
  std::vector<typename Shape::Value> bias;
  ScaledSquares<typename Shape::Square> compliance;  // Sigma
  std::vector<typename Shape::Square> inverse_diagonal;
  std::vector<typename Shape::Value> impulse;
  ScaledSquares<typename Shape::Square> stiffness;  // Sigma^-1, kept for quasi_newton alone
  std::vector<typename Shape::Value> offset;       // of c by damping, and c where the step begins: both empty
  std::vector<typename Shape::Value> begin_value;  // where there is none
  std::vector<Bounds> bounds;                      // empty where every impulse is free
  std::vector<double> friction;                    // mu, for R = 3; empty where there is none
  std::vector<typename Shape::Square> delassus;    // N_ii, kept where there is friction
  Friction law = Friction::coulomb;
  Chunks chunks;  // of its constraints; one where it was not divided since they were others

  std::size_t size() const { return node.size(); }
  std::size_t chunk_length() const { return pbd::chunk_length(size(), row_bytes, frictional()); }

  /// Index in the effect of constraint i.
  std::size_t entry(std::size_t i) const { return entries.empty() ? i : entries[i]; }

  /// Contacts: impulses with bounds, and with friction for R = 3. Their compliance is along the normal.
  void resize_contacts(std::size_t count) {
    resize(count);
    typename Shape::Square along_normal = Shape::Square::Zero();
    along_normal(0, 0) = 1;
    compliance.set_unit(along_normal);
    bounds.assign(count, {});
    if constexpr (R == 3) {
      friction.resize(count);
      delassus.resize(count);
    }
  }

  void resize(std::size_t count) {
    node.resize(count);
    jacobian.resize(count);
    bias.resize(count);
    compliance.resize(count);
    inverse_diagonal.resize(count);
    impulse.assign(count, Shape::Value::Zero());
  }

  std::int64_t bytes() const {
    std::size_t of_jacobians = 0;
    if constexpr (keeps_matrices)
      of_jacobians = jacobian.size() * sizeof(jacobian[0]);
    else
      of_jacobians = jacobian.bytes();
    return static_cast<std::int64_t>(
        entries.size() * sizeof(std::size_t) + 2 * offset.size() * sizeof(bias[0]) +
        bounds.size() * sizeof(Bounds) + friction.size() * sizeof(double) +
        delassus.size() * sizeof(delassus[0]) + compliance.bytes() + stiffness.bytes() + of_jacobians +
        size() * (sizeof(node[0]) + 2 * sizeof(bias[0]) + sizeof(inverse_diagonal[0])));
  }

  /// Velocities of constraint i's nodes, three entries a node.
  Velocities gather(const Points& v, std::size_t i) const {
    Velocities local;
    for (int a = 0; a < K; ++a) local.template segment<3>(3 * a) = v.col(node[i][a]);
    return local;
  }

  /// v += W J_i^T p
  void apply(const std::vector<double>& inverse_mass, std::size_t i, const typename Shape::Value& p,
             Points& v) const {
    if constexpr (keeps_matrices)
      apply(inverse_mass, i, jacobian[i], p, v);
    else
      jacobian.apply(i, node[i], inverse_mass, p, v);
  }

  /// v += W J^T p with other directions for constraint i
  void apply(const std::vector<double>& inverse_mass, std::size_t i,
             const typename Shape::Jacobian& directions, const typename Shape::Value& p, Points& v) const {
    for (int a = 0; a < K; ++a) {
      const int index = node[i][a];
      if (bounded() && inverse_mass[index] == 0) continue;  // other chunks of its colour may have it, too
      v.col(index) += inverse_mass[index] * (directions.template middleCols<3>(3 * a).transpose() * p);
    }
  }

  /// Divides its constraints in chunks, for so many threads. Many contacts share nothing but what cannot
  /// move: with `fixed_are_shared` these columns keep no chunks apart, and nothing may write to them
  /// (`apply`).
  void divide(const std::vector<double>& inverse_mass, int threads, bool fixed_are_shared = false) {
    chunks.threads = threads;
    pbd::divide({node.empty() ? nullptr : node[0].data(), K * node.size()}, K, chunk_length(), inverse_mass,
                fixed_are_shared, chunks);
  }

  bool bounded() const { return !bounds.empty(); }
  bool frictional() const { return !friction.empty(); }

  /// N_ii^-1 r, or what stands for it. Of six rows by two shorter chains of sums: sweeps wait for them.
  typename Shape::Value by_inverse_diagonal(std::size_t i, const typename Shape::Value& r) const {
    if constexpr (R == 6) {
      const typename Shape::Value first = inverse_diagonal[i].template leftCols<3>() * r.template head<3>(),
                                  second = inverse_diagonal[i].template rightCols<3>() * r.template tail<3>();
      return first + second;
    } else {
      return inverse_diagonal[i] * r;
    }
  }

  /// |W J^T p|_M^2 of constraint i's impulse p, with its J.
  double squared_effect(const std::vector<double>& inverse_mass, std::size_t i,
                        const typename Shape::Jacobian& whole) const {
    const Velocities push = whole.transpose() * impulse[i];
    double sum = 0;
    for (int a = 0; a < K; ++a)
      sum += inverse_mass[node[i][a]] * push.template segment<3>(3 * a).squaredNorm();
    return sum;
  }

  /// J_i v
  typename Shape::Value rate(const Points& v, std::size_t i) const {
    if constexpr (keeps_matrices) {
      // Node by node: what is gathered in parts would be read as a whole before it is written. A single row
      // has its shortest chain of sums by nodes, several rows by columns.
      typename Shape::Value rate = Shape::Value::Zero();
      for (int a = 0; a < K; ++a) {
        if constexpr (R == 1)
          rate += jacobian[i].template middleCols<3>(3 * a) * v.col(node[i][a]);
        else
          for (int axis = 0; axis < 3; ++axis) rate += jacobian[i].col(3 * a + axis) * v(axis, node[i][a]);
      }
      return rate;
    } else {
      return jacobian.rate(i, node[i], v);
    }
  }

  /// J_i v + b_i + Sigma_i p; the rate apart from the bias, since what fast nodes do to a row may cancel.
  typename Shape::Value residual(const Points& v, std::size_t i, const typename Shape::Value& p) const {
    return bias[i] + compliance[i] * p + rate(v, i);
  }
};

}  // namespace pbd
