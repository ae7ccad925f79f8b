#include "linear/linear_solver.h"

#include <algorithm>

#include "names.h"

namespace pbd {

std::int64_t relax(LinearSolver& any, Rows& rows, Points& v, bool fresh, const InnerBudget& budget,
                   BlockSeconds first_sweep) {
  return std::visit(
      [&](auto& solver) -> std::int64_t {
        solver.begin(rows, v, fresh);
        std::int64_t sweeps = 0;
        double target = budget.absolute;
        for (; sweeps < budget.max_sweeps; ++sweeps) {
          const Sweep met = solver.sweep(rows, v, sweeps == 0 ? first_sweep : nullptr);
          if (sweeps == 0) target = std::max(target, budget.relative * met.residual);
          if (met.exhausted || !(met.residual > target)) {
            ++sweeps;
            break;
          }
        }
        if constexpr (requires { solver.further_sweeps(); }) sweeps += solver.further_sweeps();
        return sweeps;
      },
      any);
}

void forget(LinearSolver& any) {
  std::visit(
      [](auto& solver) {
        if constexpr (requires { solver.forget(); }) solver.forget();
      },
      any);
}

std::string_view part(const LinearSolver& any) {
  return std::visit(
      [](const auto& solver) {
        if constexpr (requires { solver.part(); }) return solver.part();
        return solver.name;
      },
      any);
}

void require_solvable(const LinearSolver& any, const Rows& rows, Friction law) {
  std::visit(
      [&](const auto& solver) {
        bool solves = true;
        if constexpr (requires { solver.applies(rows); }) solves = solver.applies(rows);
        if constexpr (requires { solver.solves(law); }) solves &= !rows.contacts || solver.solves(law);
        if (!solves)
          throw SetupError("relaxation", std::string(solver.name) + " with contact of this law",
                           "direct, or another one of the list");
      },
      any);
}

namespace {

template <class Kind>
constexpr bool is_reordered = requires {
  typename Kind::Reordered;
};

template <class>
struct NameList;
template <class... Kinds>
struct NameList<std::variant<Kinds...>> {
  static std::vector<std::string_view> all() { return {Kinds::name...}; }

  static std::vector<std::string_view> general() {
    std::vector<std::string_view> names;
    ((Kinds::solves_any_rows && !is_reordered<Kinds> ? names.push_back(Kinds::name) : void()), ...);
    return names;
  }

  static LinearSolver make(std::string_view name) {
    LinearSolver made;
    const bool found = ((Kinds::name == name && (made.emplace<Kinds>(), true)) || ...);
    if (!found) throw unknown_name("relaxation", name, all());
    return made;
  }
};

}  // namespace

std::vector<std::string_view> linear_solver_names() {
  return NameList<LinearSolver>::all();
}
std::vector<std::string_view> general_solver_names() {
  return NameList<LinearSolver>::general();
}
LinearSolver make_linear_solver(std::string_view name) {
  return NameList<LinearSolver>::make(name);
}

}  // namespace pbd
