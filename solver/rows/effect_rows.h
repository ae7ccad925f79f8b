// The source of an effect that states Constraint<E>: loops over its constraints, instantiated in the file of
// that effect alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "rows/begin_values.h"
#include "rows/limit_stops.h"
#include "rows/turned_joints.h"
#include "rows/waiting_limits.h"

namespace pbd {

struct NoBounds {};

template <class E>
class EffectRows final : public Source {
  using C = Constraint<E>;
  using Block = RowBlock<C::rows, C::nodes>;
  using Operations = RowOperations<C::rows, C::nodes>;
  using Value = typename C::Value;
  using Jacobian = typename C::Jacobian;
  using Square = typename C::Square;
  static_assert(C::rows > 1 || !C::one_material, "ScaledSquares keeps no unit of single rows");

 public:
  EffectRows(const Scene& scene, const E& effect) : Source(kind_of(effect)), scene_(scene), effect_(effect) {}

  void allocate(bool hard_alone, BlockList& blocks) override {
    std::vector<std::size_t> entries;
    for (std::size_t i = 0; i < constraint_count(effect_); ++i)
      if (!hard_alone || !gives_way(effect_, i)) entries.push_back(i);
    if (entries.empty()) return;
    if constexpr (has_bounds)
      if (kind().limited && !kind().damped) waiting_.allocate(effect_, entries);
    Block block;
    block.resize(entries.size());
    for (std::size_t i = 0; i < block.size(); ++i) block.node[i] = columns_of(scene_, effect_, entries[i]);
    if (entries.size() < constraint_count(effect_)) block.entries = entries;
    if (kind().limited) block.bounds.resize(block.size());
    if constexpr (requires { C::turns(effect_); })
      if (C::turns(effect_)) block.jacobian.begin_turning();
    blocks.add(std::move(block));
  }

  bool begin_step(const StepBegin& begin, BlockSpan blocks) override {
    bool others = false;
    for (AnyBlock& any : blocks) {
      auto& block = std::get<Block>(any);
      if constexpr (has_bounds) others |= waiting_.look(scene_, effect_, begin, block);
      if (kind().damped)
        begin_damping(effect_, begin, block);
      else if (is_angle)
        keep_values(effect_, begin, block);
      if constexpr (has_bounds)
        if (begin.limits != Limits::silent && kind().limited) find_stops(begin, block);
    }
    return others;
  }

  Widened widen(const StepBegin& begin, const Configuration& reached, BlockSpan blocks) override {
    bool others = false;
    if constexpr (has_bounds)
      for (AnyBlock& any : blocks) {
        auto& block = std::get<Block>(any);
        if (!waiting_.call(scene_, effect_, begin, reached, block)) continue;
        others = true;
        if (is_angle) keep_values(effect_, begin, block);
      }
    if (!others) return Widened::no;
    return is_angle ? Widened::others_from_start : Widened::others;
  }

  bool waits(std::size_t constraint) const override {
    if constexpr (has_bounds) return waiting_.waits(constraint);
    return false;
  }

  void add_bodies_that_wait(std::vector<bool>& body) const override {
    if constexpr (has_bounds)
      for (std::size_t i = 0; i < constraint_count(effect_); ++i)
        if (waiting_.waits(i))
          for (const int own : C::body(effect_, i)) body[static_cast<std::size_t>(own)] = true;
  }

  void take_effect() override {
    if constexpr (has_bounds) waiting_.take(effect_);
  }

  bool call_all(const std::vector<double>& inverse_mass, BlockSpan blocks) override {
    bool others = false;
    if constexpr (has_bounds)
      for (AnyBlock& any : blocks)
        others |= waiting_.call_all(scene_, effect_, inverse_mass, std::get<Block>(any));
    return others;
  }

  Impact impact(ConstBlockSpan blocks, const Points& v) const override {
    bool stops = false;
    if constexpr (has_bounds)
      for (const AnyBlock& any : blocks) stops = stops || stops_.any(std::get<Block>(any), v);
    return stops ? Impact::stop : Impact::none;
  }

  void linearise(const RowPlace& place, BlockSpan blocks, RowResidual& sums) override {
    for (AnyBlock& any : blocks) sums += linearise_block(place, std::get<Block>(any));
  }

  bool twists_far(double h, const Configuration& start, const Configuration& reached,
                  double extension) const override {
    if constexpr (is_angle) return pbd::twists_far(scene_, effect_, h, start, reached, extension);
    return false;
  }

  bool turns_over(double h, TurnedWay& way) const override {
    if constexpr (is_angle) return pbd::twists_over(scene_, effect_, h, way);
    if constexpr (requires { C::turned_out; }) return pbd::opens_over(scene_, effect_, way);
    return false;
  }

  bool drives_round(double h) const override {
    if constexpr (is_angle) return pbd::drives_round(effect_, h);
    return false;
  }

  void add_geometric_mass(const StepMap& map, const Configuration& at, double factor, ConstBlockSpan blocks,
                          std::vector<double>& added_mass) const override {
    for (const AnyBlock& any : blocks) {
      const auto& block = std::get<Block>(any);
      each_scattered(block, [&](std::size_t i) {
        const std::size_t entry = block.entry(i);
        const auto bound = C::geometric_bound(effect_, entry, local_at(effect_, entry, block.node[i], at),
                                              factor * block.impulse[i]);
        for (int a = 0; a < C::nodes; ++a) added_mass[block.node[i][a]] += map.d / 2 * bound[a];
      });
    }
  }

  void perturb(const RowError& error, BlockSpan blocks, Points& push) const override {
    for (AnyBlock& any : blocks) {
      auto& block = std::get<Block>(any);
      each_scattered(block, [&](std::size_t i) {
        Value value;
        Jacobian jacobian;
        evaluate_on(effect_, block, i, error.turned, value, jacobian);
        if (error.directions != nullptr) take_directions(block, i, *error.directions, jacobian);
        if (!block.offset.empty()) value -= block.offset[i];
        Operations::perturb(error, value, jacobian, block, i, push);
      });
    }
  }

  void add_potential(const StepMap& map, const Points& x, const std::vector<double>& inverse_mass,
                     BlockSpan blocks, Points& v, double& sum) const override {
    if constexpr (!BodyEffect<E>)
      for (AnyBlock& any : blocks) {
        double potential = 0;
        auto& block = std::get<Block>(any);
        add_scattered(block, potential, [&](std::size_t i, double& own) {
          const auto respond = [&](Value value) -> const Value& {
            if (!block.offset.empty()) value -= block.offset[i];
            block.impulse[i] = block.stiffness[i] * (value / -map.d);
            own -= value.dot(block.impulse[i]) / (2 * map.d);
            return block.impulse[i];
          };
          const auto push = push_of(effect_, i, positions_of(block.node[i], x), respond);
          for (int a = 0; a < C::nodes; ++a) {
            const int node = block.node[i][a];
            v.col(node) += inverse_mass[node] * push.col(a);
          }
        });
        sum += potential;
      }
  }

  void add_metric(const StepMap& map, const Points& x, MetricShape shape, BlockSpan blocks,
                  std::vector<MetricEntry>& entries) const override {
    if constexpr (!BodyEffect<E>)
      for (AnyBlock& any : blocks) {
        auto& block = std::get<Block>(any);
        Value value;
        Jacobian jacobian;
        set_stiffness(map, block);
        for (std::size_t i = 0; i < block.size(); ++i) {
          auto at = positions_of(block.node[i], x);
          if constexpr (requires { C::rest(effect_, i); })
            if (shape == MetricShape::rest) at = C::rest(effect_, i);
          C::evaluate(effect_, i, at, value, jacobian);
          typename Operations::Stiffness geometric = Operations::Stiffness::Zero();
          if constexpr (requires { C::geometric_stiffness(effect_, i, at, value, true); })
            if (shape != MetricShape::rest)
              geometric = map.d * C::geometric_stiffness(effect_, i, at, block.impulse[i],
                                                         shape == MetricShape::convex);
          const bool one_number = !C::fills_space && shape == MetricShape::rest;
          Operations::append_metric(block, i, jacobian, geometric, one_number, entries);
        }
      }
  }

  void add_deformation(const Points& x, ConstBlockSpan blocks,
                       std::vector<Eigen::Matrix3d>& deformation) const override {
    if constexpr (requires { C::weighted_deformation(effect_, 0, {}); })
      for (const AnyBlock& any : blocks) {
        const auto& block = std::get<Block>(any);
        each_scattered(block, [&](std::size_t i) {
          const Eigen::Matrix3d own =
              C::weighted_deformation(effect_, block.entry(i), positions_of(block.node[i], x));
          for (const int node : block.node[i]) deformation[node] += own;
        });
      }
  }

  void add_compliant_forces(const Configuration& at, const Points& v, const std::vector<double>& inverse_mass,
                            Points& acceleration) const override {
    Value value;
    Jacobian jacobian;
    for (std::size_t i = 0; i < constraint_count(effect_); ++i) {
      if (!gives_way(effect_, i)) continue;
      const auto node = columns_of(scene_, effect_, i);
      C::evaluate(effect_, i, local_at(effect_, i, node, at), value, jacobian);
      if (kind().damped) value += C::retardation(effect_, i) * (jacobian * positions_of(node, v).reshaped());
      Value force = -solve_definite(compliance_of(effect_, i), value);
      const ForceBounds bounds = force_bounds(effect_, i);
      force[0] = std::clamp(force[0], bounds[0], bounds[1]);  // only constraints of one row have any
      const Eigen::Matrix<double, 3, C::nodes> push = (jacobian.transpose() * force).reshaped(3, C::nodes);
      for (int a = 0; a < C::nodes; ++a) acceleration.col(node[a]) += inverse_mass[node[a]] * push.col(a);
    }
  }

  void measure(const Configuration& at, ConstraintMeasure& sum) const override {
    Value value;
    Jacobian jacobian;
    for (std::size_t i = 0; i < constraint_count(effect_); ++i) {
      C::evaluate(effect_, i, local_at(effect_, i, columns_of(scene_, effect_, i), at), value, jacobian);
      if (!gives_way(effect_, i))
        sum.missed = larger(sum.missed, unmet(effect_, i, value));
      else
        sum.energy += held_energy(effect_, i, value, compliance_of(effect_, i));
    }
  }

  Eigen::VectorXd push(std::size_t i, const std::vector<double>& gamma,
                       const Configuration& at) const override {
    Value value;
    Jacobian jacobian;
    C::evaluate(effect_, i, local_at(effect_, i, columns_of(scene_, effect_, i), at), value, jacobian);
    return jacobian.transpose() * Value::Map(gamma.data() + i * C::rows);
  }

 private:
  static constexpr bool is_angle = pbd::is_angle<E>;
  static constexpr bool has_bounds = requires(const E& effect) { effect.bounds; };

  static Kind kind_of(const E& effect) {
    Kind kind{constraint_count(effect), C::rows};
    kind.of_bodies = BodyEffect<E>;
    kind.fills_space = C::fills_space || kind.constraints == 0;
    for (std::size_t i = 0; i < kind.constraints; ++i) kind.compliant &= gives_way(effect, i);
    if constexpr (has_bounds) kind.limited = !effect.bounds.empty();
    kind.damped = any_damping(effect);
    return kind;
  }

  /// c at a constraint's own places, and J as the block keeps it.
  void linearise_at(Block& block, std::size_t i, const typename C::Positions& own, Value& value) const {
    if constexpr (Block::keeps_matrices)
      C::evaluate(effect_, block.entry(i), own, value, block.jacobian[i]);
    else
      C::linearise(effect_, block.entry(i), own, value, block.jacobian, i);
    if (!block.begin_value.empty()) unwrap<E>(block.begin_value[i], value);
  }

  void find_stops(const StepBegin& begin, Block& block) {
    const auto at = [&](std::size_t i) {
      Value value;
      const auto own = local_at(effect_, block.entry(i), block.node[i], begin.at);
      linearise_at(block, i, own, value);
      return std::pair{value[0],
                       largest_coordinate(effect_, block.entry(i), own, block.node[i], begin.inverse_mass)};
    };
    stops_.find(begin, effect_.bounds, block, at,
                [&](std::size_t i) { return !gives_way(effect_, block.entry(i)); });
  }

  /// Sigma^-1 of all constraints, each of which gives way.
  void set_stiffness(const StepMap& map, Block& block) const {
    block.stiffness.resize(block.size());
    const bool damped = !block.offset.empty();
    block.stiffness.set_unit(inverse_of(damped ? block.compliance.unit() : C::unit_compliance(effect_)));
    for (std::size_t i = 0; i < block.size(); ++i)
      block.stiffness.set(
          i, 1 / (damped ? block.compliance.factor(i) : C::compliance_scale(effect_, i) / (map.s * map.d)));
  }

  /// J of constraint i at other positions than its value's.
  void take_directions(const Block& block, std::size_t i, const Configuration& at, Jacobian& jacobian) const {
    Value unused;
    evaluate_on(effect_, block, i, at, unused, jacobian);
  }

  RowResidual linearise_block(const RowPlace& place, Block& block) const {
    RowResidual sums;
    const bool damped = !block.offset.empty();  // its compliance is set for the whole step
    if (!damped) block.compliance.set_unit(C::unit_compliance(effect_));
    add_each(block, sums, [&](std::size_t i, RowResidual& own_sums) {
      Value value, unused;
      const std::size_t entry = block.entry(i);
      const auto own = local_at(effect_, entry, block.node[i], place.at);
      linearise_at(block, i, own, value);
      if (place.directions != nullptr)
        linearise_at(block, i, local_at(effect_, entry, block.node[i], *place.directions), unused);
      if (damped) value -= block.offset[i];
      if (!damped) block.compliance.set(i, C::compliance_scale(effect_, entry) / (place.map.s * place.map.d));
      if constexpr (has_bounds)
        if (block.bounded())
          block.bounds[i] = {effect_.bounds[entry][0] * place.map.s, effect_.bounds[entry][1] * place.map.s};
      const double largest = largest_coordinate(effect_, entry, own, block.node[i], place.inverse_mass);
      Operations::linearise(place, value, largest, block, i, own_sums);
    });
    return sums;
  }

  const Scene& scene_;
  const E& effect_;
  LimitStops stops_{};
  std::conditional_t<has_bounds, WaitingLimits<E>, NoBounds> waiting_{};
};

}  // namespace pbd
