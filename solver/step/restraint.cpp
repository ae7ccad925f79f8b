#include "step/restraint.h"

#include <algorithm>
#include <cmath>

#include "rows/dense.h"
#include "rows/laws.h"

namespace pbd {
namespace {

/// Energy that constraint i, which misses r, stores (J). `share`: a displacement's d over the s of impulses.
template <class Block>
double stored(const Block& block, std::size_t i, const typename Block::Value& r, double share) {
  using Value = typename Block::Value;
  if (!(block.compliance[i](0, 0) > 0)) {
    const Value change = allowed(block, i, Value::Zero(), -block.by_inverse_diagonal(i, r));
    return squared_residual(block, i, r, change) / 2;
  }
  Value impulse = Value::Zero();
  if (block.bounded())
    impulse[0] = std::clamp(-r[0] / block.compliance[i](0, 0), block.bounds[i].lower, block.bounds[i].upper);
  else
    impulse = -solve_definite(block.compliance[i], r);
  return -share * impulse.dot(r + block.compliance[i] * impulse / 2);
}

/// What hard constraint i, as it is missed at v, takes to be met against its impulse (N s m/s).
template <class Block>
double left_open(const Block& block, std::size_t i, const Points& v) {
  if (block.compliance[i](0, 0) > 0) return 0;
  const typename Block::Value r = block.residual(v, i, Block::Value::Zero());
  return block.bounded() ? -block.impulse[i][0] * r[0]  // friction brakes, and gives nothing back
                         : -block.impulse[i].dot(r);
}

/// f(block, i, component, share as in `stored`) for each constraint that can move something.
template <class F>
void each_moving(const StepSystem& system, const Components& components, F&& f) {
  const StepMap& map = system.problem.map;
  for (const Slot& slot : system.slots) {
    const double share = map.d / (slot.source->kind().contacts ? map.h : map.s);
    for_each_block(slot.view(system.rows), [&](const auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i)
        if (const int component = components.of(block.node[i]); component >= 0) f(block, i, component, share);
    });
  }
}

}  // namespace

/// The largest t of at most 1.
double Restraint::Motion::share() const {
  constexpr double rounding = 1e-12;
  const double limit = std::max(most, 0.0);
  if (gained + linear <= limit + rounding * (gained + std::abs(linear))) return 1;
  const double root = std::sqrt(linear * linear + 4 * gained * limit);
  return linear > 0 ? 2 * limit / (linear + root) : (root - linear) / (2 * gained);  // neither is 0/0
}

void Restraint::find_motions(const StepSystem& system) {
  const Problem& problem = system.problem;
  components_.find(system.rows, problem.inverse_mass);
  motions_.assign(components_.count(), {Vec3::Zero(), Vec3::Zero()});
  for (int node = 0; node < problem.bodies.nodes(); ++node) {  // rotations have no linear momentum
    const int component = components_.of_column[node];
    if (component < 0 || components_.held[component]) continue;
    Motion& motion = motions_[component];
    const double mass = 1 / problem.inverse_mass[node];
    motion.mass += mass;
    motion.own += mass * problem.map.v_free.col(node);
    motion.own_start += mass * problem.start_v.col(node);
  }
  const auto hold = [&](int component, const Vec3& v) {
    Motion& motion = motions_[component];
    if (!(v.norm() < motion.slowest)) return;
    motion.slowest = v.norm();
    motion.own = motion.own_start = v;
  };
  for_each_block(system.rows.blocks, [&]<class Block>(const Block& block) {
    for (const auto& own : block.node) {
      const int component = components_.of(own);
      if (component < 0 || !components_.held[component]) continue;
      if (Block::nodes == 1) hold(component, Vec3::Zero());
      for (const int column : own)
        if (column < problem.bodies.nodes() && components_.of_column[column] < 0)
          hold(component, problem.start_v.col(column));
    }
  });
  for (Motion& motion : motions_) {
    if (!(motion.mass > 0)) continue;
    motion.own /= motion.mass;
    motion.own_start /= motion.mass;
  }
}

void Restraint::add_kinetic(const StepSystem& system, const Points& given) {
  const Problem& problem = system.problem;
  const StepMap& map = problem.map;
  for (int column = 0; column < problem.bodies.columns(); ++column) {
    const int component = components_.of_column[column];
    if (component < 0) continue;
    Motion& motion = motions_[component];
    const bool turns = column >= problem.bodies.nodes();
    const Vec3 own = turns ? Vec3::Zero() : motion.own, own_start = turns ? Vec3::Zero() : motion.own_start;
    const Vec3 u = system.at.v.col(column) - own, u_start = problem.start_v.col(column) - own_start;
    const Vec3 drift = map.x0.col(column) - problem.start_x.col(column) - (map.h - map.d) * own_start;
    const double mass = 1 / problem.inverse_mass[column];
    motion.gained += mass * u.squaredNorm() / 2;
    motion.linear -= mass * map.d * given.col(column).dot(u);
    motion.most += mass * (u_start.squaredNorm() / 2 + given.col(column).dot(drift));
  }
}

/// `sign` times what the rows, linearised at x(v), store.
void Restraint::add_stored(const StepSystem& system, const Points& v, double sign) {
  each_moving(system, components_,
              [&]<class Block>(const Block& block, std::size_t i, int component, double share) {
                const typename Block::Value r = block.residual(v, i, Block::Value::Zero());
                motions_[component].linear += sign * stored(block, i, r, share);
              });
}

/// What hard rows, linearised at x(v), leave open; of each it counts for the first column that moves.
void Restraint::find_open(const StepSystem& system, const Points& v) {
  open_.assign(components_.of_column.size(), 0);
  for (Motion& motion : motions_) motion.open = 0;
  each_moving(system, components_, [&](const auto& block, std::size_t i, int component, double share) {
    const double open = share * left_open(block, i, v);
    if (!(open > 0)) return;
    motions_[component].open += open;
    const auto moves = [&](int column) { return components_.of_column[column] >= 0; };
    open_[*std::find_if(block.node[i].begin(), block.node[i].end(), moves)] += open;
  });
}

bool Restraint::restrain(StepSystem& system, const Points& given) {
  find_motions(system);
  add_kinetic(system, given);
  rest_.setZero(3, system.at.v.cols());
  linearise_at(system, rest_);
  add_stored(system, rest_, -1);
  find_open(system, rest_);
  linearise_at(system, system.at.v);
  add_stored(system, system.at.v, 1);
  for (std::size_t column = 0; column < lost_.size(); ++column)
    if (const int component = components_.of_column[column]; component >= 0)
      motions_[component].lost += lost_[column];
  for (Motion& motion : motions_) motion.most += std::min(motion.lost, motion.open);
  bool slowed = false;
  for (int column = 0; column < system.problem.bodies.columns(); ++column) {
    const int component = components_.of_column[column];
    if (component < 0) continue;
    const Motion& motion = motions_[component];
    const double share = motion.share();
    if (share == 1) continue;
    slowed = true;
    const bool turns = column >= system.problem.bodies.nodes();
    const Vec3 own = turns ? Vec3::Zero() : motion.own;
    system.at.v.col(column) = own + share * (system.at.v.col(column) - own);
  }
  for (Motion& motion : motions_) {
    const double share = motion.share(), returned = std::min(motion.lost, motion.open);
    const double left = motion.most - share * (share * motion.gained + motion.linear);
    motion.lost = std::max(0.0, motion.lost - returned + left);
  }
  return slowed;
}

bool Restraint::shorten(StepSystem& system, const std::vector<double>& share) const {
  std::vector<double> least(components_.count(), 1.0);
  for (std::size_t column = 0; column < share.size(); ++column)
    if (const int component = components_.of_column[column]; component >= 0)
      least[component] = std::min(least[component], share[column]);
  const Problem& problem = system.problem;
  bool any = false;
  for (int column = 0; column < problem.bodies.columns(); ++column) {
    const int component = components_.of_column[column];
    if (component < 0 || least[component] == 1) continue;
    const Vec3 way = system.at.x.col(column) - problem.start_x.col(column);
    any |= !way.isZero(0);
    system.at.v.col(column) =
        (problem.start_x.col(column) + least[component] * way - problem.map.x0.col(column)) / problem.map.d;
  }
  return any;
}

void Restraint::keep_lost(const StepSystem& system) {
  find_open(system, system.at.v);
  lost_.assign(open_.size(), 0);
  for (std::size_t column = 0; column < open_.size(); ++column)
    if (open_[column] > 0) {
      const Motion& motion = motions_[components_.of_column[column]];
      lost_[column] = motion.lost * (open_[column] / motion.open);
    }
}

}  // namespace pbd
