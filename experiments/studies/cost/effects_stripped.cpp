// What does the list of effects cost a scene that uses one of them? A sweep of Gauss-Seidel over links by the
// solver, beside the least loop that does the same: it knows links alone, sums no residual, and cannot know
// bounds, friction, or rows of other sizes.
#include <fmt/format.h>

#include "harness/rows_of_step.h"
#include "linear/linear_solver.h"
#include "scenes/standard.h"
#include "studies/cost/effects_absent.h"
#include "studies/cost/repeated_seconds.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct Link {
  int a, b;
  Vec3 n;  // the gradient by b; by a its negative
  double bias, compliance, inverse_diagonal, impulse;
};

std::vector<Link> links_of(const Rows& rows) {
  std::vector<Link> links;
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    if constexpr (Block::rows == 1 && Block::nodes == 2)
      for (std::size_t i = 0; i < block.size(); ++i)
        links.push_back({block.node[i][0], block.node[i][1], block.jacobian[i].template tail<3>().transpose(),
                         block.bias[i][0], block.compliance[i](0, 0), block.inverse_diagonal[i](0, 0), 0});
  });
  return links;
}

void sweep_links(const std::vector<double>& inverse_mass, std::vector<Link>& links, Points& v) {
  for (Link& link : links) {
    const double residual =
        link.n.dot(v.col(link.b) - v.col(link.a)) + link.bias + link.compliance * link.impulse;
    const double change = -link.inverse_diagonal * residual;
    link.impulse += change;
    v.col(link.a) -= inverse_mass[link.a] * change * link.n;
    v.col(link.b) += inverse_mass[link.b] * change * link.n;
  }
}

}  // namespace

void effects_stripped(Context& context) {
  Table table = context.table("stripped", {"scene", "rows", "wall_s_per_sweep", "stripped_s_per_sweep",
                                           "ratio", "ratio_low", "ratio_high", "difference"});
  for (const int size : {100, 100000}) {
    const Scene scene = chain(size);
    LinearStep own = linear_step(scene, scene.initial, 1.0 / 240, Friction::coulomb);
    std::vector<Link> links = links_of(own.rows);
    Points v = own.v_free;
    GaussSeidel solver;
    constexpr int sweeps = 3;  // until both are compared
    for (int k = 0; k < sweeps; ++k) {
      solver.sweep(own.rows, own.v_free, nullptr);
      sweep_links(own.rows.inverse_mass, links, v);
    }
    const double difference = (v - own.v_free).norm() / v.norm();
    // As many sweeps as take a clock's ticks to nothing.
    const int times = 1000000 / size;
    const auto all = repeated_seconds([&] {
      for (int k = 0; k < times; ++k) solver.sweep(own.rows, own.v_free, nullptr);
    });
    const auto least = repeated_seconds([&] {
      for (int k = 0; k < times; ++k) sweep_links(own.rows.inverse_mass, links, v);
    });
    std::vector<double> ratios;
    for (std::size_t k = 0; k < all.size(); ++k) ratios.push_back(all[k] / least[k]);
    const Measured ratio(ratios);
    const std::string name = fmt::format("chain of {} links", size);
    table.row({name, std::int64_t{size}, Measured(all).value / times, Measured(least).value / times,
               ratio.value, ratio.low, ratio.high, difference});
    context.verdict(Basis::code, fmt::format("effects.stripped.same.{}", size),
                    name + ": the least loop ends where the solver's does", "relative distance", difference,
                    1e-12);
    // A tenth more may be the machine's.
    context.verdict(Basis::goal, fmt::format("effects.stripped.time.{}", size),
                    name + ": a sweep takes no longer than the least loop", "time of a sweep / of the loop",
                    ratio, 1.1);
    context.advance(name);
  }
  table.close();
}

}  // namespace pbdcheck
