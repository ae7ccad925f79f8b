#include "relaxation.h"

#include <algorithm>
#include <cmath>

#include "names.h"
#include "sweeps.h"

namespace pbd {

PBD_FLATTEN double GaussSeidel::sweep(Rows& rows, Points& v, BlockSeconds seconds) {
  double squared = 0;
  visit_blocks(rows.blocks, seconds, [&]<class Block>(Block& block, std::size_t) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      const typename Block::Value r = block.residual(v, i, block.impulse[i]);
      typename Block::Value change = block.allowed(i, block.impulse[i], -block.inverse_diagonal[i] * r);
      squared += block.squared_residual(i, r, change);
      if constexpr (Block::rows == 3)
        if (block.frictional()) change = block.solved(i, r) - block.impulse[i];
      block.impulse[i] += change;
      block.apply(rows.inverse_mass, i, change, v);
    }
  });
  return std::sqrt(squared);
}

std::int64_t relax(Relaxation& any, Rows& rows, Points& v, bool fresh, const InnerBudget& budget,
                   BlockSeconds first_sweep) {
  return std::visit(
      [&](auto& relaxation) -> std::int64_t {
        relaxation.begin(rows, v, fresh);
        std::int64_t sweeps = 0;
        double target = budget.absolute;
        for (; sweeps < budget.max_sweeps; ++sweeps) {
          const double residual = relaxation.sweep(rows, v, sweeps == 0 ? first_sweep : nullptr);
          if (sweeps == 0) target = std::max(target, budget.relative * residual);
          if (!(residual > target)) {
            ++sweeps;
            break;
          }
        }
        if constexpr (requires { relaxation.further_sweeps(); }) sweeps += relaxation.further_sweeps();
        return sweeps;
      },
      any);
}

namespace {

template <class>
struct NameList;
template <class... Kinds>
struct NameList<std::variant<Kinds...>> {
  static std::vector<std::string_view> all() { return {Kinds::name...}; }

  static Relaxation make(std::string_view name) {
    Relaxation made;
    const bool found = ((Kinds::name == name && (made.emplace<Kinds>(), true)) || ...);
    if (!found) throw unknown_name("relaxation", name, all());
    return made;
  }
};

}  // namespace

std::vector<std::string_view> relaxation_names() {
  return NameList<Relaxation>::all();
}
Relaxation make_relaxation(std::string_view name) {
  return NameList<Relaxation>::make(name);
}

}  // namespace pbd
