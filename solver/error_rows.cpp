// What errors of an iterate do to rows: the geometric inertia, and the map of plain's error.
#include "linearise.h"

#include <Eigen/Dense>

#include "effect_rows.h"

namespace pbd {
namespace {

/// What the impulse of a row with bounds and the value `missed` (per second) can err by near the solution:
/// nothing where it is at a bound.
template <class Block>
std::array<double, 2> bounds_of_errors(const Block& block, const typename Block::Value& missed,
                                       std::size_t i) {
  const auto& p = block.impulse[i];
  const typename Block::Value full = -block.inverse_diagonal[i] * (missed + block.compliance[i] * p);
  return block.allowed(i, p, full) == full ? std::array{-infinity, infinity} : std::array{0.0, 0.0};
}

}  // namespace

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
            if constexpr (Constraint<E>::rows == 1)
              if (block.bounded()) block.bounds[i] = bounds_of_errors(block, before, i);
            block.impulse[i].setZero();
          }
        }
      },
      effect);
}

}  // namespace pbd
