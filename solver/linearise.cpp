#include "linearise.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "effect_rows.h"

namespace pbd {
namespace {

/// Inverse of a symmetric positive semidefinite N; its pseudo-inverse, and `singular` set, if it is not
/// definite.
template <class Square>
Square invert(const Square& n, bool& singular) {
  singular = false;
  if constexpr (Square::RowsAtCompileTime == 1) {
    singular = !(n(0, 0) > 0);
    return Square(singular ? 0.0 : 1 / n(0, 0));
  } else {
    const Eigen::LLT<Square> factor(n);
    constexpr double definite = 1e-14;  // smallest pivot against the largest entry
    if (factor.info() == Eigen::Success &&
        factor.matrixLLT().diagonal().array().square().minCoeff() > definite * n.diagonal().maxCoeff())
      return factor.solve(Square::Identity());
    singular = true;
    const Eigen::SelfAdjointEigenSolver<Square> eigen(n);
    const double cut = definite * eigen.eigenvalues().cwiseAbs().maxCoeff();
    const auto inverse = (eigen.eigenvalues().array() > cut).select(1 / eigen.eigenvalues().array(), 0.0);
    return eigen.eigenvectors() * inverse.matrix().asDiagonal() * eigen.eigenvectors().transpose();
  }
}

template <class Block>
typename Block::Square diagonal_block(const Block& block, const std::vector<double>& inverse_mass,
                                      std::size_t i) {
  typename Block::Square n = block.compliance[i];
  for (int a = 0; a < Block::nodes; ++a) {
    const auto part = block.jacobian[i].template middleCols<3>(3 * a);
    n.noalias() += inverse_mass[static_cast<std::size_t>(block.node[i][static_cast<std::size_t>(a)])] *
                   (part * part.transpose());
  }
  return n;
}

/// Of a constraint's value, as part of its largest coordinate.
constexpr double roundoff = 8 * std::numeric_limits<double>::epsilon();

/// Largest coordinate of a constraint, m.
template <class Positions>
double largest(const Positions& at) {
  if constexpr (requires { at.body; }) {
    double most = at.node.size() > 0 ? at.node.cwiseAbs().sum() : 0.0;
    for (const Pose* pose : at.body)
      most = std::max({most, pose->x.cwiseAbs().maxCoeff(), 1 / pose->turning.row(0).norm()});
    return most;
  } else {
    return at.cwiseAbs().maxCoeff();
  }
}

template <class Block>
typename Block::Positions positions(const Block& block, const Points& x, std::size_t i) {
  return positions_of(block.node[i], x);
}

/// J of constraint i at other positions than its value's.
template <class E, class Block>
void take_directions(const E& effect, const Configuration& at, std::size_t i, const Block& block,
                     typename Block::Jacobian& jacobian) {
  typename Block::Value value;
  const std::size_t entry = block.entry(i);
  Constraint<E>::evaluate(effect, entry, local(effect, entry, block.node[i], at), value, jacobian);
}

template <class E, class Block>
BlockResidual linearise_block(const E& effect, const StepMap& map, const Configuration& at, const Points& v,
                              const std::vector<double>& inverse_mass, double unreachable_mass,
                              const Configuration* directions, Block& block) {
  BlockResidual sums;
  typename Block::Value value;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::size_t entry = block.entry(i);
    const auto own = local(effect, entry, block.node[i], at);
    Constraint<E>::evaluate(effect, entry, own, value, block.jacobian[i]);
    if (directions != nullptr) take_directions(effect, *directions, i, block, block.jacobian[i]);
    const bool damped = !block.offset.empty();  // its compliance is set for the whole step
    if (damped) value -= block.offset[i];
    block.bias[i] = value / map.d - block.jacobian[i] * block.gather(v, i);
    if (!damped) block.compliance[i] = Constraint<E>::compliance(effect, entry) / (map.s * map.d);
    bool singular = false;
    block.inverse_diagonal[i] = invert(diagonal_block(block, inverse_mass, i), singular);

    const typename Block::Value r = value / map.d + block.compliance[i] * block.impulse[i];
    sums.squared += singular ? unreachable_mass * r.squaredNorm() : r.dot(block.inverse_diagonal[i] * r);
    const double size = roundoff * largest(own) / map.d;
    sums.rounding_squared +=
        size * size * block.jacobian[i].rowwise().squaredNorm().dot(block.inverse_diagonal[i].diagonal());
  }
  return sums;
}

/// c, and J^T p of the p that `respond` makes of c, for effects that need no J for it, and for the others.
template <class E, class Value, class Positions, class Respond>
Positions push_of(const E& effect, std::size_t i, const Positions& x, const Respond& respond) {
  if constexpr (requires { typename Constraint<E>::Deformation; }) {
    const auto at = Constraint<E>::deformation(effect, i, x);
    return Constraint<E>::push(at, respond(Constraint<E>::strain(effect, at)));
  } else {
    Value value;
    typename Constraint<E>::Jacobian jacobian;
    Constraint<E>::evaluate(effect, i, x, value, jacobian);
    return (jacobian.transpose() * respond(value)).reshaped(3, Positions::ColsAtCompileTime);
  }
}

/// The constraints of an effect that are rows: all of them, or the hard ones.
template <class E>
std::vector<std::size_t> entries_of(const E& effect, bool hard_alone) {
  std::vector<std::size_t> entries;
  for (std::size_t i = 0; i < constraint_count(effect); ++i)
    if (!hard_alone || !compliant(effect, i)) entries.push_back(i);
  return entries;
}

}  // namespace

Rows allocate_rows(const Scene& scene, std::vector<std::size_t>& effect_of_block, bool hard_alone) {
  Rows rows;
  rows.inverse_mass = Bodies(scene).inverse_masses(scene);
  for (std::size_t index = 0; index < scene.effects.size(); ++index)
    std::visit(
        [&]<class E>(const E& effect) {
          if constexpr (RowEffect<E>) {
            const auto entries = entries_of(effect, hard_alone);
            if (entries.empty()) return;
            BlockOf<E> block;
            block.resize(entries.size());
            for (std::size_t i = 0; i < block.size(); ++i)
              block.node[i] = columns_of(scene, effect, entries[i]);
            if (entries.size() < constraint_count(effect)) block.entries = entries;
            rows.blocks.emplace_back(std::move(block));
            effect_of_block.push_back(index);
          }
        },
        scene.effects[index]);
  return rows;
}

BlockResidual linearise(const Effect& effect, const StepMap& map, const Configuration& at, const Points& v,
                        const std::vector<double>& inverse_mass, double unreachable_mass, AnyBlock& block,
                        const Configuration* directions) {
  return std::visit(
      [&]<class E>(const E& stated) {
        if constexpr (RowEffect<E>)
          return linearise_block(stated, map, at, v, inverse_mass, unreachable_mass, directions,
                                 std::get<BlockOf<E>>(block));
        else
          return BlockResidual{};
      },
      effect);
}

double add_potential(const Effect& effect, const StepMap& map, const Points& x,
                     const std::vector<double>& inverse_mass, AnyBlock& any, Points& v) {
  return std::visit(
      [&]<class E>(const E& stated) {
        double potential = 0;
        if constexpr (RowEffect<E> && !BodyEffect<E>) {
          auto& block = std::get<BlockOf<E>>(any);
          using Value = typename BlockOf<E>::Value;
          for (std::size_t i = 0; i < block.size(); ++i) {
            const auto push =
                push_of<E, Value>(stated, i, positions(block, x, i), [&](Value value) -> const Value& {
                  if (!block.offset.empty()) value -= block.offset[i];
                  block.impulse[i].noalias() = block.stiffness[i] * (value / -map.d);
                  potential -= value.dot(block.impulse[i]) / (2 * map.d);
                  return block.impulse[i];
                });
            for (int a = 0; a < block.nodes; ++a) {
              const int node = block.node[i][static_cast<std::size_t>(a)];
              v.col(node) += inverse_mass[static_cast<std::size_t>(node)] * push.col(a);
            }
          }
        }
        return potential;
      },
      effect);
}

void add_metric(const Effect& effect, const StepMap& map, const Points& x, Shape shape, AnyBlock& any,
                std::vector<MetricEntry>& entries) {
  std::visit(
      [&]<class E>(const E& stated) {
        if constexpr (RowEffect<E> && !BodyEffect<E>) {
          auto& block = std::get<BlockOf<E>>(any);
          block.stiffness.resize(block.size());
          for (std::size_t i = 0; i < block.size(); ++i) {
            typename BlockOf<E>::Value value;
            typename BlockOf<E>::Jacobian jacobian;
            auto local = positions(block, x, i);
            if constexpr (requires { Constraint<E>::rest(stated, i); })
              if (shape == Shape::rest) local = Constraint<E>::rest(stated, i);
            Constraint<E>::evaluate(stated, i, local, value, jacobian);
            if (block.offset.empty())
              block.stiffness[i] = (Constraint<E>::compliance(stated, i) / (map.s * map.d)).inverse();
            else
              block.stiffness[i] = block.compliance[i].inverse();
            for (int a = 0; a < block.nodes; ++a)
              for (int b = 0; b <= a; ++b) {
                Eigen::Matrix3d pair = jacobian.template middleCols<3>(3 * a).transpose() *
                                       block.stiffness[i] * jacobian.template middleCols<3>(3 * b);
                if (!Constraint<E>::fills_space)
                  pair = Eigen::Matrix3d(Vec3::Constant(pair.trace() / 3).asDiagonal());
                entries.push_back({block.node[i][a], block.node[i][b], pair});
              }
          }
        }
      },
      effect);
}

void add_deformation(const Effect& effect, const Points& x, std::vector<Eigen::Matrix3d>& deformation) {
  std::visit(
      [&]<class E>(const E& stated) {
        if constexpr (requires { Constraint<E>::turning(stated, 0, {}); })
          for (std::size_t i = 0; i < stated.node.size(); ++i) {
            const auto nodes = Constraint<E>::node(stated, i);
            typename Constraint<E>::Positions local;
            for (int a = 0; a < Constraint<E>::nodes; ++a) local.col(a) = x.col(nodes[a]);
            const Eigen::Matrix3d own = Constraint<E>::turning(stated, i, local);
            for (const int node : nodes) deformation[node] += own;
          }
      },
      effect);
}

bool all_compliant(const Effect& effect) {
  return std::visit(
      []<class E>(const E& stated) {
        if constexpr (RowEffect<E>)
          for (std::size_t i = 0; i < constraint_count(stated); ++i)
            if (!compliant(stated, i)) return false;
        return true;
      },
      effect);
}

bool of_bodies(const Effect& effect) {
  return std::visit([]<class E>(const E&) { return BodyEffect<E>; }, effect);
}

bool fills_space(const Effect& effect) {
  return std::visit(
      []<class E>(const E& stated) {
        if constexpr (RowEffect<E>) return Constraint<E>::fills_space || constraint_count(stated) == 0;
        return true;
      },
      effect);
}

void add_geometric_inertia(const Effect& effect, const StepMap& map, const Configuration& at, double factor,
                           const AnyBlock& any, std::vector<double>& inertia) {
  std::visit(
      [&]<class E>(const E& stated) {
        if constexpr (RowEffect<E>) {
          const auto& block = std::get<BlockOf<E>>(any);
          for (std::size_t i = 0; i < block.size(); ++i) {
            const std::size_t entry = block.entry(i);
            const auto bound = Constraint<E>::geometric_bound(
                stated, entry, local(stated, entry, block.node[i], at), factor * block.impulse[i]);
            for (int a = 0; a < block.nodes; ++a)
              inertia[static_cast<std::size_t>(block.node[i][static_cast<std::size_t>(a)])] +=
                  map.d / 2 * bound[a];
          }
        }
      },
      effect);
}

void perturb(const Effect& effect, const StepMap& map, const Configuration& turned, const Points& v,
             double scale, const Points& error, const std::vector<double>& inverse_mass, AnyBlock& any,
             Points& push, const Configuration* directions) {
  std::visit(
      [&]<class E>(const E& stated) {
        if constexpr (RowEffect<E>) {
          auto& block = std::get<BlockOf<E>>(any);
          typename BlockOf<E>::Value value;
          typename BlockOf<E>::Jacobian jacobian;
          for (std::size_t i = 0; i < block.size(); ++i) {
            const std::size_t entry = block.entry(i);
            Constraint<E>::evaluate(stated, entry, local(stated, entry, block.node[i], turned), value,
                                    jacobian);
            if (directions != nullptr) take_directions(stated, *directions, i, block, jacobian);
            if (!block.offset.empty()) value -= block.offset[i];
            block.apply(inverse_mass, i, jacobian, block.impulse[i], push);
            const typename BlockOf<E>::Value before = block.bias[i] + block.jacobian[i] * block.gather(v, i);
            block.bias[i] = (value / map.d - before) / scale - block.jacobian[i] * block.gather(error, i);
            block.impulse[i].setZero();
          }
        }
      },
      effect);
}

void refresh_inverse_diagonal(Rows& rows) {
  for_each_block(rows.blocks, [&](auto& block) {
    bool singular = false;
    for (std::size_t i = 0; i < block.size(); ++i)
      block.inverse_diagonal[i] = invert(diagonal_block(block, rows.inverse_mass, i), singular);
  });
}

void accelerations(const Scene& scene, const StepBegin& begin, Points& acceleration) {
  acceleration.setZero(3, begin.bodies.columns());
  for (const auto& any : scene.effects)
    std::visit(
        [&]<class E>(const E& effect) {
          if constexpr (ForceEffect<E>) Force<E>::add(effect, scene, begin, acceleration);
        },
        any);
}

}  // namespace pbd
