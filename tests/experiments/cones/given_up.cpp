// Rows that have no solution, linearised again and again as in a step whose contacts cannot be met.
#include <catch2/catch.hpp>

#include "harness/rows_of_step.h"
#include "linear/linear_solver.h"
#include "scenes/contacts.h"

using namespace pbd;
using namespace pbdcheck;

namespace {

/// Each contact has a counterpart that asks its bodies to part by 1 m/s the other way.
Rows contradictory(Rows rows) {
  const auto blocks = rows.blocks;
  for (const AnyBlock& any : blocks)
    std::visit(
        [&](auto block) {
          if constexpr (std::decay_t<decltype(block)>::keeps_matrices)
            for (auto& jacobian : block.jacobian) jacobian *= -1;
          else
            REQUIRE(block.size() == 0);  // contacts alone
          for (auto& bias : block.bias) {
            bias *= -1;
            bias[0] -= 1;
          }
          rows.blocks.emplace_back(std::move(block));
        },
        any);
  return rows;
}

}  // namespace

TEST_CASE("direct gives rows up sooner, the more of a step's rows it has given up") {
  const LinearStep step = linear_step(pile(), pile().initial, 0.01, Friction::coulomb);
  const Rows hopeless = contradictory(step.rows);
  const InnerBudget budget{.max_sweeps = 1000, .absolute = 1e-8};
  LinearSolver solver = make_linear_solver("direct");
  const auto sweeps = [&](Rows rows, bool fresh) {
    Points v = step.v_free;
    return relax(solver, rows, v, fresh, budget, nullptr);
  };
  const auto first = sweeps(hopeless, true);
  REQUIRE(first > 10);  // its patience
  CHECK(sweeps(hopeless, false) < first);
  std::int64_t last = 0;
  for (int k = 0; k < 8; ++k) last = sweeps(hopeless, false);
  // Of ten iterations without a gain one is left, and what is done instead grows with their number.
  CHECK(10 * last < first);
  SECTION("the next step begins with all of its patience") {
    CHECK(sweeps(hopeless, true) == first);
  }
  SECTION("and so do the rows after some that are solved") {
    CHECK(sweeps(step.rows, false) < first);
    CHECK(sweeps(hopeless, false) == first);
  }
}
