// The rows that quasi_newton eliminates: their potential, its gradient and metric.
#include "linearise.h"

#include <Eigen/Dense>

#include "effect_rows.h"

namespace pbd {
namespace {

template <class Block>
typename Block::Positions positions(const Block& block, const Points& x, std::size_t i) {
  return positions_of(block.node[i], x);
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

}  // namespace

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

void add_metric(const Effect& effect, const StepMap& map, const Points& x, MetricShape shape, AnyBlock& any,
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
              if (shape == MetricShape::rest) local = Constraint<E>::rest(stated, i);
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

}  // namespace pbd
