#include "rows_of_step.h"

#include <Eigen/Dense>

#include "contact_rows.h"
#include "linearise.h"

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
      all.sigma.block(row, row, Block::rows, Block::rows) = block.compliance[i];
      all.bias.segment(row, Block::rows) = block.bias[i];
    }
  });
  return all;
}

}  // namespace

void stir(Scene& scene) {
  for (int node = 0; node < scene.nodes(); ++node)
    if (std::isfinite(scene.mass[static_cast<std::size_t>(node)]))
      scene.initial.v.col(node) += Vec3(std::sin(1.3 * node), std::cos(0.7 * node), std::sin(2.1 * node + 1));
}

LinearStep linear_step(const Scene& scene, const State& state, double h, Friction law) {
  LinearStep step;
  std::vector<std::size_t> effect_of_block;
  step.rows = allocate_rows(scene, effect_of_block);
  ContactRows contacts(scene, law, step.rows, effect_of_block);
  Bodies bodies(scene);
  Points x, v, acceleration;
  std::vector<Pose> poses;
  bodies.begin(state, x, v);
  bodies.place(x, poses);
  accelerations(scene, {bodies, poses, v, false}, acceleration);
  step.v_free = v + h * acceleration;
  const StepMap map{x, step.v_free, h, h};
  const Points at_rest = Points::Zero(3, bodies.columns());
  const Configuration start{x, poses, state.time};
  const auto& inverse_mass = step.rows.inverse_mass;
  if (contacts.listed()) contacts.find(scene, bodies, start, v, map, h, false, inverse_mass, step.rows);
  for (std::size_t b = 0; b < step.rows.blocks.size(); ++b)
    if (contacts.owns(b))
      contacts.linearise(start, nullptr, map, at_rest, inverse_mass, b, step.rows);
    else
      linearise(scene.effects[effect_of_block[b]], map, start, at_rest, inverse_mass, 1, step.rows.blocks[b]);
  return step;
}

Points dense_solution(const LinearStep& step) {
  const auto nodes = static_cast<int>(step.rows.inverse_mass.size());
  const DenseRows all = dense(step.rows, nodes);
  Eigen::VectorXd weights(3 * nodes);
  for (int k = 0; k < weights.size(); ++k)
    weights[k] = step.rows.inverse_mass[static_cast<std::size_t>(k / 3)];
  const Eigen::MatrixXd weighted = all.jacobian * weights.asDiagonal();
  const Eigen::MatrixXd n = weighted * all.jacobian.transpose() + all.sigma;
  const Eigen::VectorXd impulses = n.ldlt().solve(-(all.bias + all.jacobian * step.v_free.reshaped()));
  return step.v_free + (weighted.transpose() * impulses).reshaped(3, nodes);
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
