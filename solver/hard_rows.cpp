#include "hard_rows.h"

#include <cmath>

#include "linearise.h"

namespace pbd {
namespace {

/// f(block, i, entries of a flat array from the constraint's first row on) for every constraint in play.
template <class F>
void each_constraint(Rows& rows, const std::vector<bool>& eliminated, F&& f) {
  std::size_t first = 0;
  for (std::size_t b = 0; b < rows.blocks.size(); ++b)
    std::visit(
        [&]<class Block>(Block& block) {
          if (!eliminated[b])
            for (std::size_t i = 0; i < block.size(); ++i) f(block, i, first + i * Block::rows);
          first += block.size() * Block::rows;
        },
        rows.blocks[b]);
}

template <class Block>
auto part(std::vector<double>& flat, const Block&, std::size_t first) {
  return Eigen::Map<typename Block::Value>(flat.data() + first);
}

/// force += J^T p of one constraint
template <class Block>
void push(const Block& block, std::size_t i, const typename Block::Value& p, Points& force) {
  const typename Block::Velocities own = block.jacobian[i].transpose() * p;
  for (int a = 0; a < Block::nodes; ++a) force.col(block.node[i][a]) += own.template segment<3>(3 * a);
}

}  // namespace

std::int64_t HardRows::solve(Rows& rows, const std::vector<bool>& eliminated, Metric& metric, double accuracy,
                             int most, Points& v) {
  rows.inverse_mass = metric.inverse_diagonal();
  refresh_inverse_diagonal(rows);
  for (auto* flat : {&residual_, &direction_, &image_}) flat->assign(row_count(rows), 0.0);

  force_.setZero(3, v.cols());
  each_constraint(rows, eliminated,
                  [&](auto& block, std::size_t i, std::size_t) { push(block, i, block.impulse[i], force_); });
  metric.solve(force_, push_);
  v += push_;
  each_constraint(rows, eliminated, [&](auto& block, std::size_t i, std::size_t first) {
    part(residual_, block, first) = block.residual(v, i, block.impulse[i]);
  });

  double last = 0;
  for (int k = 0; k < most; ++k) {
    double product = 0;
    each_constraint(rows, eliminated, [&]<class Block>(Block& block, std::size_t i, std::size_t first) {
      const auto r = part(residual_, block, first);
      product += r.dot(block.inverse_diagonal[i] * r);
    });
    if (!(std::sqrt(product) > accuracy)) return k;
    force_.setZero();
    each_constraint(rows, eliminated, [&]<class Block>(Block& block, std::size_t i, std::size_t first) {
      auto s = part(direction_, block, first);
      s = (k > 0 ? product / last : 0.0) * s - block.inverse_diagonal[i] * part(residual_, block, first);
      push(block, i, s, force_);
    });
    metric.solve(force_, push_);
    double curvature = 0;
    each_constraint(rows, eliminated, [&]<class Block>(Block& block, std::size_t i, std::size_t first) {
      const auto s = part(direction_, block, first);
      auto image = part(image_, block, first);
      image = block.jacobian[i] * block.gather(push_, i) + block.compliance[i] * s;
      curvature += s.dot(image);
    });
    if (!(curvature > 0)) return k + 1;
    const double length = product / curvature;
    v += length * push_;
    each_constraint(rows, eliminated, [&]<class Block>(Block& block, std::size_t i, std::size_t first) {
      block.impulse[i] += length * part(direction_, block, first);
      part(residual_, block, first) += length * part(image_, block, first);
    });
    last = product;
  }
  return most;
}

}  // namespace pbd
