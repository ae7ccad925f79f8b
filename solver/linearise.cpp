#include "linearise.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "effect_rows.h"

namespace pbd {
namespace {

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
    const bool singular = invert_diagonal(block, inverse_mass, i);
    if constexpr (requires { effect.bounds; })
      if (block.bounded())
        block.bounds[i] = {effect.bounds[entry][0] * map.s, effect.bounds[entry][1] * map.s};

    const typename Block::Value r = value / map.d + block.compliance[i] * block.impulse[i];
    sums.squared += singular ? unreachable_mass * r.squaredNorm()
                             : block.squared_residual(
                                   i, r, block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r));
    const double size = roundoff * largest(own) / map.d;
    sums.rounding_squared +=
        size * size * block.jacobian[i].rowwise().squaredNorm().dot(block.inverse_diagonal[i].diagonal());
    sums.impulses_squared += block.squared_effect(inverse_mass, i);
  }
  return sums;
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
            if (has_bounds(effect)) block.bounds.resize(block.size());
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
        return !std::is_same_v<E, Contact>;
      },
      effect);
}

void refresh_inverse_diagonal(Rows& rows) {
  for_each_block(rows.blocks, [&](auto& block) {
    for (std::size_t i = 0; i < block.size(); ++i) invert_diagonal(block, rows.inverse_mass, i);
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
