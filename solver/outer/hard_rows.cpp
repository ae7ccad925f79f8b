#include "outer/hard_rows.h"

#include <cmath>

#include "outer/preconditioned_cg.h"
#include "rows/row_operations.h"

namespace pbd {
namespace {

/// f(block, i, first row of the constraint) for every constraint in play.
template <class F>
void each_row(Rows& rows, const std::vector<bool>& eliminated, F&& f) {
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

struct HardRows::System {
  HardRows& own;
  Rows& rows;
  const std::vector<bool>& eliminated;
  Metric& metric;
  double accuracy;
  Points& v;

  double precondition() {
    double product = 0;
    each_row(rows, eliminated, [&](auto& block, std::size_t i, std::size_t first) {
      const auto r = part(own.residual_, block, first);
      product += r.dot(block.by_inverse_diagonal(i, r));
    });
    return product;
  }
  bool solved(double product) const { return !(std::sqrt(product) > accuracy); }
  void turn(double beta) {
    own.force_.setZero();
    each_row(rows, eliminated, [&](auto& block, std::size_t i, std::size_t first) {
      auto s = part(own.direction_, block, first);
      s = beta * s - block.by_inverse_diagonal(i, part(own.residual_, block, first));
      push(block, i, s, own.force_);
    });
    metric.solve(own.force_, own.push_);
  }
  double apply() {
    double curvature = 0;
    each_row(rows, eliminated, [&](auto& block, std::size_t i, std::size_t first) {
      const auto s = part(own.direction_, block, first);
      auto image = part(own.image_, block, first);
      image = block.rate(own.push_, i) + block.compliance[i] * s;
      curvature += s.dot(image);
    });
    return curvature;
  }
  void advance(double length) {
    v += length * own.push_;
    each_row(rows, eliminated, [&](auto& block, std::size_t i, std::size_t first) {
      block.impulse[i] += length * part(own.direction_, block, first);
      part(own.residual_, block, first) += length * part(own.image_, block, first);
    });
  }
};

std::int64_t HardRows::solve(Rows& rows, const std::vector<bool>& eliminated, Metric& metric, double accuracy,
                             int most, Points& v) {
  rows.inverse_mass = metric.inverse_diagonal();
  refresh_inverse_diagonal(rows);
  for (auto* flat : {&residual_, &direction_, &image_}) flat->assign(row_count(rows), 0.0);

  force_.setZero(3, v.cols());
  each_row(rows, eliminated,
           [&](auto& block, std::size_t i, std::size_t) { push(block, i, block.impulse[i], force_); });
  metric.solve(force_, push_);
  v += push_;
  each_row(rows, eliminated, [&](auto& block, std::size_t i, std::size_t first) {
    part(residual_, block, first) = block.residual(v, i, block.impulse[i]);
  });
  return preconditioned_cg(System{*this, rows, eliminated, metric, accuracy, v}, most);
}

}  // namespace pbd
