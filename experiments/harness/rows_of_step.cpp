#include "harness/rows_of_step.h"

#include <algorithm>
#include <cmath>

#include "dense.h"
#include "effects/sources.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// All rows as dense J (m x 3N), Sigma (m x m) and b (m).
struct DenseRows {
  Eigen::MatrixXd jacobian, sigma;
  Eigen::VectorXd bias;
};

DenseRows dense(const Rows& rows, int nodes) {
  const auto count = row_count(rows);
  DenseRows all{Eigen::MatrixXd::Zero(count, 3 * nodes), Eigen::MatrixXd::Zero(count, count),
                Eigen::VectorXd::Zero(count)};
  std::int64_t row = 0;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i, row += Block::rows) {
      for (int a = 0; a < Block::nodes; ++a)
        all.jacobian.block(row, 3 * block.node[i][static_cast<std::size_t>(a)], Block::rows, 3) =
            block.jacobian[i].template middleCols<3>(3 * a);
      all.sigma.block(row, row, Block::rows, Block::rows) = typename Block::Square(block.compliance[i]);
      all.bias.segment(row, Block::rows) = block.bias[i];
    }
  });
  return all;
}

/// N = J W J^T + Sigma.
Eigen::MatrixXd dual_matrix(const Rows& rows, const DenseRows& all) {
  Eigen::VectorXd weights(all.jacobian.cols());
  for (Eigen::Index k = 0; k < weights.size(); ++k)
    weights[k] = rows.inverse_mass[static_cast<std::size_t>(k / 3)];
  return reference::product_transposed(all.jacobian * weights.asDiagonal(), all.jacobian) + all.sigma;
}

/// Symmetric; of a semidefinite matrix.
Eigen::MatrixXd square_root(const Eigen::MatrixXd& a) {
  const auto [values, vectors] = reference::symmetric_eigen(a);
  return reference::product_transposed(vectors * values.cwiseMax(0).cwiseSqrt().asDiagonal(), vectors);
}

}  // namespace

void stir(Scene& scene) {
  for (int node = 0; node < scene.nodes(); ++node)
    if (std::isfinite(scene.mass[static_cast<std::size_t>(node)]))
      scene.initial.v.col(node) += Vec3(std::sin(1.3 * node), std::cos(0.7 * node), std::sin(2.1 * node + 1));
}

std::int64_t constraints_of(const Rows& rows) {
  std::int64_t count = 0;
  for_each_block(rows.blocks, [&](const auto& block) { count += static_cast<std::int64_t>(block.size()); });
  return count;
}

std::int64_t least_bytes(const Rows& rows) {
  constexpr std::int64_t impulse = sizeof(double), in_and_out = 2 * sizeof(Vec3);
  return bytes(rows.blocks) + impulse * row_count(rows) +
         in_and_out * static_cast<std::int64_t>(rows.inverse_mass.size());
}

StepRows::StepRows(const Scene& scene, const State& state, double h, Friction law, int threads)
    : scene_(scene),
      slots_(make_slots(scene, law, false, rows_)),
      bodies_(scene),
      map_{.x0 = {}, .v_free = {}, .d = h, .s = h, .h = h},
      coefficients_{h, h},
      time_(state.time) {
  divide(rows_, threads);
  Points acceleration;
  bodies_.begin(state, map_.x0, start_v_);
  bodies_.place(map_.x0, start_poses_);
  set_given_accelerations(scene, {bodies_, start_poses_, start_v_, false}, acceleration);
  map_.v_free = start_v_ + h * acceleration;
  const Configuration at = start();
  const StepBegin begin = step_begin(at);
  for (Slot& slot : slots_) slot.source->begin_step(begin, slot.blocks(rows_));
}

std::string_view StepRows::effect_of(std::size_t block) const {
  const auto own = std::find_if(slots_.begin(), slots_.end(), [&](const Slot& slot) {
    return slot.first <= block && block < slot.first + slot.count;
  });
  return own->cost.effect;
}

StepBegin StepRows::step_begin(const Configuration& start) const {
  return {.bodies = bodies_,
          .map = map_,
          .coefficients = coefficients_,
          .at = start,
          .ahead = start,
          .behind = start,
          .v = start_v_,
          .a = no_acceleration_,
          .inverse_mass = rows_.inverse_mass,
          .limits = Limits::silent,
          .tolerance = 0,
          .solved = false,
          .warm_start = false};
}

Configuration StepRows::reached(const Points& v) {
  x_ = map_.x0 + map_.d * v;
  bodies_.place(x_, poses_);
  return {x_, poses_, time_ + map_.h};
}

void StepRows::linearise(const Points& v) {
  const Configuration at = reached(v);
  clear_impulses(rows_);
  RowResidual unused;
  for (Slot& slot : slots_)
    slot.source->linearise({map_, at, nullptr, v, rows_.inverse_mass, 1}, slot.blocks(rows_), unused);
}

bool StepRows::widen(const Points& v, const Eigen::VectorXd& impulse, double tolerance) {
  const Configuration at = reached(v), begun = start();
  StepBegin begin = step_begin(begun);
  begin.tolerance = tolerance;
  Eigen::Index row = 0;
  for_each_block(rows_.blocks, [&]<class Block>(Block& block) {
    if constexpr (Block::rows == 3)
      for (std::size_t i = 0; i < block.size(); ++i, row += 3) block.impulse[i] = impulse.segment<3>(row);
  });
  bool any = false;
  for (Slot& slot : slots_) any |= slot.source->widen(begin, at, slot.blocks(rows_)) != Widened::no;
  return any;
}

State StepRows::end(const Points& v) const {
  State state = scene_.initial;
  state.time = time_ + map_.h;
  bodies_.end(map_.x0 + map_.d * v, v, state);
  return state;
}

LinearStep linear_step(const Scene& scene, const State& state, double h, Friction law) {
  StepRows step(scene, state, h, law);
  step.linearise(Points::Zero(3, step.v_free().cols()));
  return {step.rows(), step.v_free()};
}

Points dense_solution(const LinearStep& step) {
  const auto nodes = static_cast<int>(step.rows.inverse_mass.size());
  const DenseRows all = dense(step.rows, nodes);
  const Eigen::MatrixXd n = dual_matrix(step.rows, all);
  const Eigen::VectorXd missed = all.bias + all.jacobian * step.v_free.reshaped();
  const Eigen::VectorXd impulses = reference::solve_semidefinite(n, -missed);
  Points change = reference::transposed_product(all.jacobian, impulses).reshaped(3, nodes);
  for (int k = 0; k < nodes; ++k) change.col(k) *= step.rows.inverse_mass[static_cast<std::size_t>(k)];
  return step.v_free + change;
}

double error_per_residual(const Scene& scene, const State& begin, const State& end, double h, Friction law) {
  StepRows step(scene, begin, h, law);
  Points v, unused;
  Bodies(scene).begin(end, unused, v);
  step.linearise(v);
  const auto nodes = static_cast<int>(step.rows().inverse_mass.size());
  const DenseRows all = dense(step.rows(), nodes);
  if (all.bias.size() == 0) return 1;
  // N_ii^-1 = L L, and L N L has the eigenvalues asked for.
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(all.bias.size(), all.bias.size());
  std::int64_t row = 0;
  for_each_block(step.rows().blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i, row += Block::rows)
      scaled.block(row, row, Block::rows, Block::rows) = square_root(block.inverse_diagonal[i]);
  });
  const Eigen::MatrixXd n = dual_matrix(step.rows(), all);
  const Eigen::VectorXd values = reference::symmetric_eigen(reference::congruence(n, scaled)).values;
  const double rounding = 1e-12 * values.maxCoeff();
  const auto least =
      std::find_if(values.begin(), values.end(), [&](double value) { return value > rounding; });
  return 1 + 1 / std::sqrt(*least);
}

double residual(const Rows& rows, const Points& v) {
  double squared = 0;
  for_each_block(rows.blocks, [&](const auto& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto missed = block.residual(v, i, block.impulse[i]);
      squared += missed.dot(block.inverse_diagonal[i] * missed);
    }
  });
  return std::sqrt(squared);
}

}  // namespace pbdcheck
