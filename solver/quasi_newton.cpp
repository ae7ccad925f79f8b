#include "quasi_newton.h"

#include <algorithm>

namespace pbd {
namespace {

double dot(const Points& a, const Points& b) {
  return (a.array() * b.array()).sum();
}

/// |force|_W over the nodes that can move.
double weighted_norm(const Points& force, const std::vector<double>& inverse_mass) {
  double sum = 0;
  for (std::size_t node = 0; node < inverse_mass.size(); ++node)
    sum += inverse_mass[node] * force.col(node).squaredNorm();
  return std::sqrt(sum);
}

}  // namespace

void QuasiNewton::solve_rows(double accuracy, const Points& gradient, Rows& rows, Points& v) {
  constexpr int most_iterations = 50;
  rest_ = -gradient;
  metric_.solve(rest_, q_);
  along_ = q_;
  double product = dot(rest_, q_);
  for (int k = 0; k < most_iterations && weighted_norm(rest_, rows.inverse_mass) > accuracy; ++k) {
    pushed_.setZero(3, v.cols());
    for (std::size_t node = 0; node < rows.inverse_mass.size(); ++node)
      if (rows.inverse_mass[node] > 0) pushed_.col(node) = along_.col(node) / rows.inverse_mass[node];
    for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        const typename Block::Velocities push =
            block.jacobian[i].transpose() *
            (block.stiffness[i] * (block.jacobian[i] * block.gather(along_, i)));
        for (int a = 0; a < Block::nodes; ++a)
          if (rows.inverse_mass[block.node[i][a]] > 0)
            pushed_.col(block.node[i][a]) += push.template segment<3>(3 * a);
      }
    });
    const double length = product / dot(along_, pushed_);
    v += length * along_;
    rest_ -= length * pushed_;
    for_each_block(rows.blocks, [&]<class Block>(Block& block) {
      for (std::size_t i = 0; i < block.size(); ++i)
        block.impulse[i] -= block.stiffness[i] * (block.jacobian[i] * block.gather(length * along_, i));
    });
    metric_.solve(rest_, q_);
    const double next = dot(rest_, q_);
    along_ = q_ + next / product * along_;
    product = next;
  }
}

void QuasiNewton::learn(const Points& step, const Points& change) {
  const double curvature = dot(step, change);
  constexpr double least = 1e-12;  // of the product of lengths: no curvature is known below
  if (memory_ == 0 || !(curvature > least * step.norm() * change.norm())) return;
  const auto slot = static_cast<std::size_t>(count_ % memory_);
  if (steps_.size() <= slot) {
    steps_.resize(slot + 1);
    changes_.resize(slot + 1);
    curvature_.resize(slot + 1);
  }
  steps_[slot] = step;
  changes_[slot] = change;
  curvature_[slot] = curvature;
  ++count_;
}

void QuasiNewton::direction(const Points& gradient, Points& result) {
  const int used = std::min(count_, memory_);
  alpha_.resize(static_cast<std::size_t>(used));
  q_ = -gradient;
  for (int k = 0; k < used; ++k) {  // newest first
    const auto slot = static_cast<std::size_t>((count_ - 1 - k) % memory_);
    alpha_[static_cast<std::size_t>(k)] = dot(steps_[slot], q_) / curvature_[slot];
    q_ -= alpha_[static_cast<std::size_t>(k)] * changes_[slot];
  }
  metric_.solve(q_, result);
  for (int k = used - 1; k >= 0; --k) {
    const auto slot = static_cast<std::size_t>((count_ - 1 - k) % memory_);
    const double beta = dot(changes_[slot], result) / curvature_[slot];
    result += (alpha_[static_cast<std::size_t>(k)] - beta) * steps_[slot];
  }
}

}  // namespace pbd
