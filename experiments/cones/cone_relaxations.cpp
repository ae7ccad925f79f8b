#include "cones/cone_relaxations.h"

#include <chrono>
#include <cmath>
#include <set>

#include "harness/interrupt.h"
#include "linear/linear_solver.h"
#include "rows/laws.h"

namespace pbdcheck {

using namespace pbd;
using reference::ConeProblem;
using reference::ConeSolution;
using reference::FrictionLaw;

namespace {

/// W by its 3 x 3 blocks, each contact a node; blocks that follow each other are one run.
void fill_response(const Eigen::SparseMatrix<double>& delassus, LocalContacts& block) {
  block.clear_response();
  std::set<int> contacts;  // that one couples with
  for (int j = 0; j < static_cast<int>(block.size()); ++j) {
    contacts.clear();
    for (int axis = 0; axis < 3; ++axis)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(delassus, 3 * j + axis); entry; ++entry)
        contacts.insert(static_cast<int>(entry.row() / 3));
    for (auto first = contacts.begin(), end = first; first != contacts.end(); first = end) {
      int count = 0;
      while (end != contacts.end() && *end == *first + count) ++end, ++count;
      block.add_run(*first, count) = delassus.block(3 * *first, 3 * j, 3 * count, 3).toDense();
    }
    block.end_node();
  }
}

/// f(block, i, its first row in the problem) for each constraint, those of contacts with friction first.
template <class F>
void each_in_order(const Rows& rows, F&& f) {
  Eigen::Index row = 0;
  for (const bool contacts : {true, false})
    for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
      if (block.frictional() != contacts) return;
      for (std::size_t i = 0; i < block.size(); ++i, row += Block::rows) f(block, i, row);
    });
}

}  // namespace

Eigen::VectorXd impulses_in_order(const Rows& rows) {
  Eigen::VectorXd all(row_count(rows));
  each_in_order(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index row) {
    all.segment<Block::rows>(row) = block.impulse[i];
  });
  return all;
}

Rows local_rows(const ConeProblem& problem, FrictionLaw law) {
  const auto count = static_cast<std::size_t>(problem.contacts());
  LocalContacts block;
  block.resize_contacts(count);
  block.law = friction_by_name(reference::friction_law_names[static_cast<std::size_t>(law)]);
  block.friction.assign(problem.friction.begin(), problem.friction.end());
  fill_response(problem.delassus, block);
  for (std::size_t i = 0; i < count; ++i) {
    block.node[i] = {static_cast<int>(i)};
    block.jacobian[i].setIdentity();  // of its own node alone
    block.delassus[i] = block.own_coupling(i);
    block.bias[i].setZero();
    block.compliance.set(i, 0);
    const double trace = block.delassus[i].trace();
    block.inverse_diagonal[i] = (trace > 0 ? 3 / trace : 1) * Eigen::Matrix3d::Identity();
    if (!(trace > 0)) block.bounds[i].freedom = Freedom::held;  // nothing that it touches can move
  }
  Rows rows;
  rows.inverse_mass.assign(count, 0);
  rows.contacts = true;
  rows.blocks.add(std::move(block));
  return rows;
}

ConeProblem cone_problem(const Rows& rows, const Points& v_free) {
  ConeProblem problem;
  const auto count = row_count(rows);
  problem.free_velocity.resize(count);
  std::vector<double> friction;
  std::vector<Eigen::Triplet<double>> directions, compliances;
  each_in_order(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index row) {
    if (block.frictional()) friction.push_back(block.friction[i]);
    problem.free_velocity.segment<Block::rows>(row) = block.residual(v_free, i, Block::Value::Zero());
    const typename Block::Jacobian jacobian = block.jacobian[i];
    const typename Block::Square compliance(block.compliance[i]);
    for (int k = 0; k < Block::rows; ++k) {
      for (int entry = 0; entry < 3 * Block::nodes; ++entry)
        directions.emplace_back(row + k, 3 * block.node[i][static_cast<std::size_t>(entry / 3)] + entry % 3,
                                jacobian(k, entry));
      for (int other = 0; other < Block::rows; ++other)
        if (compliance(k, other) != 0) compliances.emplace_back(row + k, row + other, compliance(k, other));
    }
  });
  problem.friction = Eigen::VectorXd::Map(friction.data(), std::ssize(friction));
  const Eigen::Index others = count - 3 * problem.friction.size();
  problem.lower.setConstant(others, -infinity);
  problem.upper.setConstant(others, infinity);
  Eigen::SparseMatrix<double> jacobian(count, v_free.size()), compliance(count, count);
  jacobian.setFromTriplets(directions.begin(), directions.end());
  compliance.setFromTriplets(compliances.begin(), compliances.end());
  const Eigen::VectorXd inverse_mass = Eigen::VectorXd::NullaryExpr(
      v_free.size(), [&](Eigen::Index k) { return rows.inverse_mass[static_cast<std::size_t>(k / 3)]; });
  problem.delassus = jacobian * inverse_mass.asDiagonal() * jacobian.transpose();
  problem.delassus += compliance;
  return problem;
}

Points moved_by(const Rows& rows, Points v_free, const Eigen::VectorXd& impulse) {
  each_in_order(rows, [&]<class Block>(const Block& block, std::size_t i, Eigen::Index row) {
    block.apply(rows.inverse_mass, i, impulse.segment<Block::rows>(row), v_free);
  });
  return v_free;
}

ConeSolution relax_cone(std::string_view relaxation, Rows rows, Points v_free, const ConeTask& task) {
  const auto start = std::chrono::steady_clock::now();
  LinearSolver any = make_linear_solver(relaxation);
  ConeSolution found;
  std::visit(
      [&](auto& method) {
        method.begin(rows, v_free, true);
        // The relaxation's own residual is of another norm: it says when the natural one is worth a look.
        double worth = infinity;
        while (found.iterations < task.most_sweeps) {
          throw_if_interrupted();
          const auto [own, exhausted] = method.sweep(rows, v_free, nullptr);
          ++found.iterations;
          if (own > worth && !exhausted) continue;
          const double natural = measure_cone(task.problem, task.law, impulses_in_order(rows)).residual();
          if (exhausted || !(own > 0 && natural > task.tolerance))
            break;  // reached, nothing left to gain, or NaN
          constexpr double least = 0.1, most = 0.7;
          worth = own * std::clamp(task.tolerance / natural, least, most);
        }
        if constexpr (requires { method.further_sweeps(); })
          found.iterations += static_cast<int>(method.further_sweeps());
      },
      any);
  found.impulse = impulses_in_order(rows);
  certify(task.problem, task.law, task.tolerance, found);
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return found;
}

ConeSolution relax_cone(std::string_view relaxation, const ConeTask& task) {
  return relax_cone(relaxation, local_rows(task.problem, task.law),
                    task.problem.free_velocity.reshaped(3, task.problem.contacts()), task);
}

}  // namespace pbdcheck
