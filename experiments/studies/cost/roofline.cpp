#include "studies/cost/roofline.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "harness/measure.h"
#include "harness/rows_of_step.h"
#include "studies/cost/swept.h"
#include "studies/robustness/generated_world.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// Floating point operations a second of products of dense matrices, one on each thread.
double product_flops_per_s(int threads) {
  constexpr Eigen::Index size = 512;
  const Eigen::MatrixXd a = Eigen::MatrixXd::Constant(size, size, 1.5);
  std::vector<Eigen::MatrixXd> products(static_cast<std::size_t>(threads), a);
  const auto seconds = repeated_seconds(
      [&] { each_task(threads, products.size(), [&](std::size_t k) { products[k].noalias() = a * a; }); });
  return threads * 2.0 * size * size * size / *std::min_element(seconds.begin(), seconds.end());
}

/// Operations of J v and J^T p of one constraint, as rows keep J.
template <class Block>
constexpr std::int64_t product_flops() {
  constexpr std::int64_t squares = 45;  // of a product of two matrices of 3 rows and columns
  if (std::is_same_v<typename Block::Jacobians, LinkJacobians>) return 8 + 3;
  if (std::is_same_v<typename Block::Jacobians, StrainJacobians>)
    return (9 + 2 * squares + 3) + (2 * squares + 6);
  return 12 * Block::rows * Block::nodes;
}

/// Operations that a sweep needs at least: J v + b + Sigma p, D^-1 r, the impulse, and W J^T dp. What laws of
/// friction need comes on top.
template <class Block>
std::int64_t least_flops(const Block& block) {
  constexpr std::int64_t R = Block::rows, K = Block::nodes;
  return static_cast<std::int64_t>(block.size()) * (product_flops<Block>() + 4 * R * R + 6 * K + 3 * R);
}

/// So many copies of rows, each with columns of its own.
EffectRows copies_of(const EffectRows& one, std::size_t copies) {
  EffectRows all = one;
  const auto repeat = [&](auto& list) {
    const auto begin = list;
    for (std::size_t k = 1; k < copies; ++k) list.insert(list.end(), begin.begin(), begin.end());
  };
  repeat(all.inverse_mass);
  all.v = one.v.replicate(1, static_cast<Eigen::Index>(copies));
  std::visit(
      [&](auto& block) {
        const std::size_t count = block.size();
        block.entries.clear();
        repeat(block.node);
        repeat(block.bias);
        block.compliance.resize(copies * count);
        repeat(block.inverse_diagonal);
        repeat(block.impulse);
        repeat(block.bounds);
        repeat(block.friction);
        repeat(block.delassus);
        using Block = std::decay_t<decltype(block)>;
        if constexpr (Block::keeps_matrices)
          repeat(block.jacobian);
        else
          block.jacobian.resize(copies * count);
        for (std::size_t i = count; i < block.size(); ++i) {
          if constexpr (!Block::keeps_matrices) block.jacobian.copy(i % count, i);
          block.compliance.set(i, block.compliance.factor(i % count));
          for (int& node : block.node[i]) node += static_cast<int>(i / count * one.inverse_mass.size());
        }
      },
      all.block);
  return all;
}

/// A block and the columns that it touches, numbered anew.
template <class Block>
EffectRows rows_alone(const Block& block, const std::vector<double>& inverse_mass, const Points& v) {
  std::map<int, int> number;  // of each column
  for (const auto& nodes : block.node)
    for (const int node : nodes) number.try_emplace(node, static_cast<int>(number.size()));
  Block alone = block;
  for (auto& nodes : alone.node)
    for (int& node : nodes) node = number.at(node);
  EffectRows rows{std::move(alone), std::vector<double>(number.size()), Points(3, number.size())};
  for (const auto& [column, own] : number) {
    rows.inverse_mass[static_cast<std::size_t>(own)] = inverse_mass[static_cast<std::size_t>(column)];
    rows.v.col(own) = v.col(column);
  }
  return rows;
}

struct Machine {
  int threads;
  double bytes_per_s, flops_per_s;
};

/// Of each repeat, the time of a sweep over the least that the machine allows.
std::vector<double> over_roof(const Swept& found, double bytes, double flops, const Machine& machine) {
  const double least = std::max(bytes / machine.bytes_per_s, flops / machine.flops_per_s);
  std::vector<double> all;
  for (const double seconds : found.seconds) all.push_back(seconds / least);
  return all;
}

}  // namespace

std::map<std::string, EffectRows> rows_of_effects() {
  constexpr std::int64_t worlds = 200;  // which have all effects
  std::map<std::string, EffectRows> found;
  for (std::int64_t index = 0; index < worlds; ++index) {
    const World world = generated_world(index);
    StepRows step(world.scene, world.scene.initial, world.h, Friction::coulomb);
    step.linearise(Points::Zero(3, step.v_free().cols()));
    for (std::size_t b = 0; b < step.rows().blocks.size(); ++b)
      std::visit(
          [&]<class Block>(const Block& block) {
            if (block.size() == 0) return;
            const auto name = fmt::format("{}, {} x {}", step.effect_of(b), Block::rows, 3 * Block::nodes);
            if (!found.contains(name))
              found.emplace(name, rows_alone(block, step.rows().inverse_mass, step.v_free()));
          },
          step.rows().blocks[b]);
  }
  return found;
}

void roofline(Context& context, const std::map<std::string, EffectRows>& effects,
              const std::vector<double>& copied) {
  constexpr double wanted = 128e6;  // bytes of rows: beyond the caches
  std::vector<Machine> machines;
  for (const double bytes_per_s : copied) {
    const int threads = static_cast<int>(machines.size()) + 1;
    machines.push_back({threads, bytes_per_s, product_flops_per_s(threads)});
  }
  Table table =
      context.table("roofline", {"effect", "relaxation", "threads", "constraints", "bytes", "flops",
                                 "wall_s_per_sweep", "wall_s_low", "wall_s_high", "copied_bytes_per_s",
                                 "product_flops_per_s", "share_of_roof", "status", "reason"});
  WorstSpread worst;
  for (const auto& [name, few] : effects) {
    const auto copies = static_cast<std::size_t>(wanted / static_cast<double>(bytes({&few.block, 1}))) + 1;
    EffectRows many = copies_of(few, copies);
    const auto flops = std::visit([](const auto& block) { return least_flops(block); }, many.block);
    Rows rows;
    rows.inverse_mass = std::move(many.inverse_mass);
    rows.blocks.push_back(std::move(many.block));
    const std::int64_t moved = least_bytes(rows);
    for (const std::string relaxation : {"gauss_seidel", "coloured_gauss_seidel", "nesterov_jacobi"})
      for (const Machine& machine : machines) {
        if ((relaxation == "gauss_seidel") != (machine.threads == 1) && relaxation != "nesterov_jacobi")
          continue;
        const Swept found = swept(rows, many.v, relaxation, machine.threads);
        const Measured seconds(found.seconds);
        const auto over = over_roof(found, static_cast<double>(moved), static_cast<double>(flops), machine);
        table.row({name, relaxation, std::int64_t{machine.threads}, constraints_of(rows), moved, flops,
                   seconds.value, seconds.low, seconds.high, machine.bytes_per_s, machine.flops_per_s,
                   1 / Measured(over).value, "ok", ""});
        if (machine.threads == 1) worst.add(Measured(over), fmt::format("{}, {}", relaxation, name));
      }
    context.advance(name);
  }
  table.close();
  context.verdict(
      Basis::goal, "threads.roofline",
      "of every effect one thread sweeps rows at six tenths of what the machine allows, or faster",
      fmt::format("time of a sweep over the least by memory and arithmetic ({})", worst.owner()),
      worst.value(), 1 / 0.6);
}

}  // namespace pbdcheck
