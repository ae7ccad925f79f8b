// Linear rows with a planted solution, and what their linear solvers make of them.
#pragma once

#include "dense.h"
#include "effects/sources.h"
#include "linear/linear_solver.h"
#include "scenes.h"

namespace pbd::test {

/// Linear rows of a scene at rest with a planted solution: random impulses, and the biases that make them
/// exact.
struct Planted {
  Rows rows;
  Points v_free, v_exact;

  explicit Planted(const Scene& scene, double h = 1.0 / 60) {
    const std::vector<Slot> slots = make_slots(scene, Friction::coulomb, false, rows);
    const StepMap map{scene.initial.x, scene.initial.v, h, h, h};
    v_free = Points::Zero(3, scene.nodes());
    const std::vector<Pose> no_bodies;
    const Configuration at{scene.initial.x, no_bodies, 0};
    RowResidual unused;
    for (const Slot& slot : slots)
      slot.source->linearise({map, at, nullptr, scene.initial.v, rows.inverse_mass, 1}, slot.blocks(rows),
                             unused);
    for_each_block(rows.blocks, [](auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i)
        for (int r = 0; r < block.rows; ++r)
          block.impulse[i][r] = std::sin(7.0 * static_cast<double>(i) + 3 * r + 1);
    });
    v_exact = v_free;
    apply_impulses(rows, v_exact);
    for_each_block(rows.blocks, [&](auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        block.bias[i].setZero();
        block.bias[i] = -block.residual(v_exact, i, block.impulse[i]);
      }
      for (auto& impulse : block.impulse) impulse.setZero();
    });
  }
};

/// Error of v against the planted one after each of `sweeps` sweeps.
inline std::vector<double> errors(Planted problem, std::string_view name, int sweeps) {
  LinearSolver relaxation = make_linear_solver(name);
  Points v = problem.v_free;
  std::vector<double> found;
  std::visit(
      [&](auto& kind) {
        kind.begin(problem.rows, v, true);
        for (int k = 0; k < sweeps; ++k) {
          kind.sweep(problem.rows, v, nullptr);
          found.push_back((v - problem.v_exact).norm() / (problem.v_exact - problem.v_free).norm());
        }
      },
      relaxation);
  return found;
}

/// Eigenvalues of D^-1 N, D = blockdiag(N_ii), ascending.
inline Eigen::VectorXd spectrum(const Rows& rows, int nodes) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(row_count(rows), 3 * nodes);
  Eigen::MatrixXd n = Eigen::MatrixXd::Zero(row_count(rows), row_count(rows)), diagonal = n;
  const auto each = [&](auto&& use) {
    int row = 0;
    for_each_block(rows.blocks, [&](const auto& block) {
      for (std::size_t i = 0; i < block.size(); ++i, row += block.rows) use(block, i, row);
    });
  };
  each([&]<class Block>(const Block& block, std::size_t i, int row) {
    for (int a = 0; a < block.nodes; ++a)
      jacobian.block(row, 3 * block.node[i][static_cast<std::size_t>(a)], block.rows, 3) =
          block.jacobian[i].middleCols(3 * a, 3);
    n.block(row, row, block.rows, block.rows) = typename Block::Square(block.compliance[i]);
  });
  Eigen::VectorXd weights(3 * nodes);
  for (int k = 0; k < weights.size(); ++k) weights[k] = rows.inverse_mass[static_cast<std::size_t>(k / 3)];
  n += reference::product_transposed(jacobian * weights.asDiagonal(), jacobian);
  each([&](const auto& block, std::size_t, int row) {
    diagonal.block(row, row, block.rows, block.rows) = n.block(row, row, block.rows, block.rows);
  });
  return reference::generalised_eigenvalues(n, diagonal);
}

}  // namespace pbd::test
