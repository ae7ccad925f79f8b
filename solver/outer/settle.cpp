#include "outer/settle.h"

#include "outer/preconditioned_cg.h"
#include "rows/mass_norm.h"

namespace pbd {
namespace {

/// f(block) of the compliant rows that a metric knows; contacts, which alone have bounds here, are not among
/// them.
template <class Blocks, class F>
void each_stiff_block(Blocks& blocks, F&& f) {
  for_each_block(blocks, [&](auto& block) {
    if (!block.bounded()) f(block);
  });
}

/// (M + J^T Sigma^-1 J) along
void apply_stiffness(const Rows& rows, const Points& along, Points& pushed) {
  pushed.setZero(3, along.cols());
  for (std::size_t node = 0; node < rows.inverse_mass.size(); ++node)
    if (rows.inverse_mass[node] > 0) pushed.col(node) = along.col(node) / rows.inverse_mass[node];
  each_stiff_block(rows.blocks, [&]<class Block>(const Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Velocities push =
          block.jacobian[i].transpose() * (block.stiffness[i] * block.rate(along, i));
      for (int a = 0; a < Block::nodes; ++a)
        if (rows.inverse_mass[block.node[i][a]] > 0)
          pushed.col(block.node[i][a]) += push.template segment<3>(3 * a);
    }
  });
}

/// p -= Sigma^-1 J change
void respond(const Points& change, Rows& rows) {
  each_stiff_block(rows.blocks, [&]<class Block>(Block& block) {
    for (std::size_t i = 0; i < block.size(); ++i)
      block.impulse[i] -= block.stiffness[i] * block.rate(change, i);
  });
}

}  // namespace

void Settling::solve(double accuracy, const Points& gradient, Metric& metric, Rows& rows, Points& v) {
  constexpr int most_iterations = 50;
  rest_ = -gradient;
  along_.setZero(3, v.cols());
  struct System {
    double accuracy;
    Metric& metric;
    Rows& rows;
    Points &v, &preconditioned, &rest, &along, &pushed;

    double precondition() {
      metric.solve(rest, preconditioned);
      return dot(rest, preconditioned);
    }
    bool solved(double) const { return !(momentum_norm(rows.inverse_mass, rest) > accuracy); }
    void turn(double beta) { along = preconditioned + beta * along; }
    double apply() {
      apply_stiffness(rows, along, pushed);
      return dot(along, pushed);
    }
    void advance(double length) {
      v += length * along;
      rest -= length * pushed;
      respond(length * along, rows);
    }
  };
  preconditioned_cg(System{accuracy, metric, rows, v, preconditioned_, rest_, along_, pushed_},
                    most_iterations);
}

}  // namespace pbd
