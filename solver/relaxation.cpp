#include "relaxation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "names.h"

namespace pbd {
namespace {

using Clock = std::chrono::steady_clock;

/// f(block, index of its first row) for every block, its time added to `seconds`.
template <class F>
void visit_blocks(std::vector<AnyBlock>& blocks, BlockSeconds seconds, F&& f) {
  std::size_t first_row = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto start = seconds ? Clock::now() : Clock::time_point{};
    std::visit([&](auto& block) { f(block, first_row); }, blocks[b]);
    if (seconds) (*seconds)[b] += std::chrono::duration<double>(Clock::now() - start).count();
    first_row += static_cast<std::size_t>(row_count(blocks[b]));
  }
}

/// The R entries of constraint i in an array with one entry a row.
template <class Block>
auto entries(std::vector<double>& flat, const Block&, std::size_t first_row, std::size_t i) {
  return Eigen::Map<typename Block::Value>(flat.data() + first_row + i * Block::rows);
}

}  // namespace

// Sweeps are flattened, all they call inlined, which GCC does not do of itself with so many kinds of rows;
// not so with sanitizers, whose checks would make that too long to compile.
#ifdef NDEBUG
#define PBD_FLATTEN [[gnu::flatten]]
#else
#define PBD_FLATTEN
#endif

PBD_FLATTEN double GaussSeidel::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      typename Block::Value change = block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r);
      squared += block.squared_residual(i, r, change);
      if constexpr (Block::rows == 3)
        if (block.frictional()) change = block.solved(i, r) - block.impulse[i];
      block.impulse[i] += change;
      block.apply(rows.inverse_mass, i, change, v);
    }
  });
  return std::sqrt(squared);
}

double SpectralBound::power_step(const Rows& rows) {
  velocity_.setZero();
  std::size_t first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i)
      block.apply(rows.inverse_mass, i, entries(vector_, block, first_row, i), velocity_);
    first_row += block.size() * Block::rows;
  });
  // Rayleigh quotient of D^-1 N in the metric of N: (g^T D^-1 g)/(p^T g) with g = N p.
  double upper = 0, lower = 0;
  first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto p = entries(vector_, block, first_row, i);
      const typename Block::Value g =
          block.compliance[i] * p + block.jacobian[i] * block.gather(velocity_, i);
      const typename Block::Value next = block.inverse_diagonal[i] * g;
      upper += g.dot(next);
      lower += p.dot(g);
      p = next;
    }
    first_row += block.size() * Block::rows;
  });
  const double estimate = lower > 0 ? upper / lower : 0.0;
  if (estimate > 0)
    for (double& entry : vector_) entry /= estimate;
  ++sweeps_;
  return estimate;
}

double SpectralBound::update(const Rows& rows, const Points& like) {
  sweeps_ = 0;
  int most_steps = 1;
  if (vector_.empty() || generation_ != rows.generation) {
    generation_ = rows.generation;
    most_steps = 60;
    velocity_ = like;
    std::vector<int> constraints(rows.inverse_mass.size(), 0);
    std::size_t row = 0;
    vector_.resize(static_cast<std::size_t>(row_count(rows)));
    for (double& entry : vector_) entry = 1 + 0.5 * irregular(row++);
    for_each_block(rows.blocks, [&](const auto& block) {
      for (const auto& nodes : block.node)
        for (const int node : nodes)
          if (rows.inverse_mass[static_cast<std::size_t>(node)] > 0)
            ++constraints[static_cast<std::size_t>(node)];
    });
    constraints_at_a_node_ =
        constraints.empty() ? 1 : *std::max_element(constraints.begin(), constraints.end());
    for_each_block(rows.blocks, [&]<class Block>(const Block&) {
      if (is_local<Block>) constraints_at_a_node_ = infinity;
    });
  }
  double estimate = 0;
  for (int k = 0; k < most_steps; ++k) {
    const double next = power_step(rows);
    const bool settled = std::abs(next - estimate) < 1e-3 * next;
    estimate = next;
    if (settled) break;
  }
  constexpr double safety = 1.05;
  return std::max(least_, std::min(constraints_at_a_node_, safety * estimate));
}

void Jacobi::begin(Rows& rows, const Points& v, bool) {
  omega_ = std::min(1.0, 2 / bound_.update(rows, v));
  least_omega_ = omega_ / 2;
  last_residual_ = std::numeric_limits<double>::infinity();
}

PBD_FLATTEN double Jacobi::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  next_ = v;
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      const typename Block::Value change = block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r);
      squared += block.squared_residual(i, r, change);
      block.impulse[i] += omega_ * change;
      block.apply(rows.inverse_mass, i, omega_ * change, next_);
    }
  });
  v.swap(next_);
  const double residual = std::sqrt(squared);
  constexpr double rounding = 1e-9;
  if (residual > (1 + rounding) * last_residual_) omega_ = std::max(least_omega_, 0.9 * omega_);
  last_residual_ = residual;
  return residual;
}

void NesterovJacobi::begin(Rows& rows, const Points& v, bool fresh) {
  omega_ = 1 / bound_.update(rows, v);
  previous_v_ = v;
  const auto count = static_cast<std::size_t>(row_count(rows));
  if (fresh || previous_.size() != count) {  // contacts may have joined within the step
    fresh = true;
    restart();
    previous_.resize(count);
  }
  // The velocities of the previous impulses along the new directions; a fresh start has no previous impulses.
  std::size_t first_row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto previous = entries(previous_, block, first_row, i);
      if (fresh)
        previous = block.impulse[i];
      else
        block.apply(rows.inverse_mass, i, previous - block.impulse[i], previous_v_);
    }
    first_row += block.size() * Block::rows;
  });
}

/// Compares q^T N q / q^T D q of the change q of the impulses, that gave `v` from the extrapolated
/// velocities, with the bound 1/omega. `compliant` is q^T Sigma q.
bool NesterovJacobi::bound_holds(const Rows& rows, const Points& v, double residual_squared,
                                 double compliant) {
  double stiff = compliant;
  for (std::size_t node = 0; node < rows.inverse_mass.size(); ++node)
    if (rows.inverse_mass[node] > 0) {
      const auto column = static_cast<Eigen::Index>(node);
      stiff += (v.col(column) - extrapolated_.col(column)).squaredNorm() / rows.inverse_mass[node];
    }
  constexpr double safety = 1.05;
  const double lengths = omega_ * omega_ * residual_squared;  // q^T D q
  if (!(stiff > safety * lengths / omega_) || !std::isfinite(stiff)) return true;
  bound_.met(safety * stiff / lengths);
  omega_ = lengths / (safety * stiff);
  return false;
}

PBD_FLATTEN double NesterovJacobi::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  // v belongs to the impulses p; everything is linear, so v + beta (v - v_previous) belongs to the
  // extrapolated ones.
  extrapolated_ = v + beta_ * (v - previous_v_);
  previous_v_ = v;
  v = extrapolated_;
  double squared = 0, compliant = 0;
  double gradient_along_step = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto previous = entries(previous_, block, first_row, i);
      const typename Block::Value start = block.impulse[i] + beta_ * (block.impulse[i] - previous);
      const typename Block::Value r = block.residual(extrapolated_, i, start);
      const typename Block::Value change = block.allowed(i, start, -omega_ * (block.inverse_diagonal[i] * r));
      squared += block.squared_residual(i, r, change) / (block.bounded() ? omega_ * omega_ : omega_);
      compliant += change.dot(block.compliance[i] * change);
      if constexpr (is_local<Block>)  // its share of q^T W q, W symmetric
        compliant += change.dot(2 * (v.col(block.node[i][0]) - extrapolated_.col(block.node[i][0])) +
                                block.delassus[i] * change);
      previous = block.impulse[i];
      block.impulse[i] = start + change;
      gradient_along_step += r.dot(block.impulse[i] - previous);
      block.apply(rows.inverse_mass, i, change, v);
    }
  });
  if (!bound_holds(rows, v, squared, compliant) || gradient_along_step > 0) {
    restart();
  } else {
    const double square = theta_ * theta_;
    const double next = (std::sqrt(square * square + 4 * square) - square) / 2;
    beta_ = theta_ * (1 - theta_) / (square + next);
    theta_ = next;
  }
  return std::sqrt(squared);
}

void ConjugateGradients::begin(Rows& rows, const Points& v, bool) {
  direction_.assign(static_cast<std::size_t>(row_count(rows)), 0.0);
  last_.assign(direction_.size(), 0.0);
  free_.assign(direction_.size(), Free::all);
  velocity_.setZero(3, v.cols());
  last_product_ = 0;
}

/// Takes impulses that their law would move along the surface of what it allows there, or to nothing, and
/// tells which parts of the impulses remain free. True if another set of them is.
bool ConjugateGradients::find_free(Rows& rows, Points& v, double& squared) {
  bool changed = false;
  visit_blocks(rows.blocks, nullptr, [&]<class Block>(Block& block, std::size_t first_row) {
    if (!block.bounded()) return;
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      const typename Block::Value full = -block.inverse_diagonal[i] * r;
      typename Block::Value change = block.allowed(i, block.impulse[i], full);
      Free free = Free::all;
      if (!block.frictional()) {
        if (change.isZero(0) && !full.isZero(0)) free = Free::none;
        change.setZero();
      } else if (const typename Block::Value to = block.impulse[i] + full; block.cut(i, to) == to) {
        change.setZero();  // it sticks
      } else {
        if constexpr (Block::rows == 3) change = (block.solved(i, r) - block.impulse[i]) / 2 + change / 2;
        const bool slides = block.impulse[i][0] + change[0] > 0 && block.law != Friction::cone;
        free = slides ? Free::first : Free::none;
      }
      changed |= free != free_[first_row + i];
      free_[first_row + i] = free;
      if (change.isZero(0)) continue;
      squared += block.squared_residual(i, r, change);
      block.impulse[i] += change;
      block.apply(rows.inverse_mass, i, change, v);
    }
  });
  return changed;
}

PBD_FLATTEN double ConjugateGradients::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double moved = 0;  // squared residual of what the laws have moved
  const bool set_changed = find_free(rows, v, moved);
  push_.setZero(3, v.cols());
  double product = 0, kept_product = 0;  // of r with the new and the last D^-1 r
  double slope = 0;                      // of r along the old direction
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t first_row) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      typename Block::Value next = block.inverse_diagonal[i] * r;
      if (block.bounded() && free_[first_row + i] == Free::none) next.setZero();
      if (block.bounded() && free_[first_row + i] == Free::first) next.tail(Block::rows - 1).setZero();
      auto last = entries(last_, block, first_row, i);
      product += r.dot(next);
      kept_product += r.dot(last);
      slope += r.dot(entries(direction_, block, first_row, i));
      last = next;
      block.apply(rows.inverse_mass, i, -next, push_);
    }
  });
  const double beta =
      last_product_ > 0 && !set_changed ? std::max(0.0, (product - kept_product) / last_product_) : 0.0;
  square_ = product + beta * (beta * square_ - 2 * slope);
  slope = beta * slope - product;
  velocity_ = push_ + beta * velocity_;
  double curvature = 0;
  for (std::size_t node = 0; node < rows.inverse_mass.size(); ++node)
    if (rows.inverse_mass[node] > 0)
      curvature += velocity_.col(static_cast<Eigen::Index>(node)).squaredNorm() / rows.inverse_mass[node];
  visit_blocks(rows.blocks, nullptr, [&]<class Block>(Block& block, std::size_t first_row) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      auto direction = entries(direction_, block, first_row, i);
      direction = beta * direction - entries(last_, block, first_row, i);
      curvature += direction.dot(block.compliance[i] * direction);
      if constexpr (is_local<Block>) curvature += direction.dot(velocity_.col(block.node[i][0]));
    }
  });
  last_product_ = product;
  constexpr double redundant = 1e-10;  // s changes next to no velocity: what rows contradict each other by
  if (!(curvature > redundant * square_)) {
    last_product_ = 0;
    return std::sqrt(moved + (beta > 0 ? product : 0.0));  // begin anew; nothing left to gain
  }
  const double length = -slope / curvature;
  visit_blocks(rows.blocks, nullptr, [&]<class Block>(Block& block, std::size_t first_row) {
    for (std::size_t i = 0; i < block.size(); ++i)
      block.impulse[i] += length * entries(direction_, block, first_row, i);
  });
  v += length * velocity_;
  visit_blocks(rows.blocks, nullptr, [&]<class Block>(Block& block, std::size_t) {
    for (std::size_t i = 0; block.bounded() && i < block.size(); ++i) {
      const typename Block::Value back = block.cut(i, block.impulse[i]) - block.impulse[i];
      if (back.isZero(0)) continue;
      block.impulse[i] += back;
      block.apply(rows.inverse_mass, i, back, v);
      last_product_ = 0;
    }
  });
  return std::sqrt(moved + product);
}

std::int64_t relax(Relaxation& any, Rows& rows, Points& v, bool fresh, const InnerBudget& budget,
                   BlockSeconds first_sweep) {
  return std::visit(
      [&](auto& relaxation) -> std::int64_t {
        relaxation.begin(rows, v, fresh);
        std::int64_t sweeps = 0;
        double target = budget.absolute;
        for (; sweeps < budget.max_sweeps; ++sweeps) {
          const double residual = relaxation.sweep(rows, v, sweeps == 0 ? first_sweep : nullptr);
          if (sweeps == 0) target = std::max(target, budget.relative * residual);
          if (!(residual > target)) {
            ++sweeps;
            break;
          }
        }
        if constexpr (requires { relaxation.further_sweeps(); }) sweeps += relaxation.further_sweeps();
        return sweeps;
      },
      any);
}

namespace {

template <class>
struct NameList;
template <class... Kinds>
struct NameList<std::variant<Kinds...>> {
  static std::vector<std::string_view> all() { return {Kinds::name...}; }

  static Relaxation make(std::string_view name) {
    Relaxation made;
    const bool found = ((Kinds::name == name && (made.emplace<Kinds>(), true)) || ...);
    if (!found) throw unknown_name("relaxation", name, all());
    return made;
  }
};

}  // namespace

std::vector<std::string_view> relaxation_names() {
  return NameList<Relaxation>::all();
}
Relaxation make_relaxation(std::string_view name) {
  return NameList<Relaxation>::make(name);
}

}  // namespace pbd
