#include "outer/outer.h"

#include <array>

#include "names.h"

namespace pbd {

void Plain::iterate(StepSystem& system, Progress& progress) {
  system.at.v = system.at.rebuilt;
  relax(system, progress);
}

void Incremental::iterate(StepSystem& system, Progress& progress) {
  if (progress.outer_iterations == 0) system.at.v = system.at.rebuilt;
  relax(system, progress);
}

void Frozen::iterate(StepSystem& system, Progress& progress) {
  rest.setZero(3, system.at.v.cols());
  linearise_at(system, rest);
  const double stabilisation = system.problem.method.stabilisation;
  if (stabilisation != 1) scale_hard_biases(system.rows, stabilisation);
  system.at.v = system.at.rebuilt;
  relax(system, progress);
}

namespace {

template <class Kind>
OuterIteration make(StepSystem& system) {
  if constexpr (std::is_constructible_v<Kind, StepSystem&>)
    return Kind(system);
  else
    return Kind{};
}

struct Outer {
  std::string_view name;
  bool solves_step;
  OuterIteration (*make)(StepSystem& system);
};

template <class Kind>
constexpr Outer named(std::string_view name) {
  return {name, Kind::solves_step, make<Kind>};
}

constexpr auto outers = std::to_array<Outer>(
    {named<Automatic>("auto"), named<Plain>("plain"), named<Aitken>("aitken"), named<Proximal>("proximal"),
     named<QuasiNewton>("quasi_newton"), named<Incremental>("incremental"), named<Frozen>("frozen")});
static_assert(outers.size() == std::variant_size_v<OuterIteration>, "an outer iteration without its name");

}  // namespace

std::vector<OuterName> outer_names() {
  std::vector<OuterName> all;
  for (const Outer& outer : outers) all.push_back({outer.name, outer.solves_step});
  return all;
}

void require_outer(std::string_view name) {
  find_named(outers, "outer", name);
}

OuterIteration make_outer(std::string_view name, StepSystem& system) {
  return find_named(outers, "outer", name).make(system);
}

// What an iteration does not state it does not need.

void begin(OuterIteration& outer, StepSystem& system) {
  std::visit(
      [&](auto& kind) {
        if constexpr (requires { kind.begin(system); }) kind.begin(system);
      },
      outer);
}

RowResidual refresh(OuterIteration& outer, StepSystem& system) {
  return std::visit(
      [&](auto& kind) {
        if constexpr (requires { kind.refresh(system); }) return kind.refresh(system);
        return linearise_at(system, system.at.v);
      },
      outer);
}

void iterate(OuterIteration& outer, StepSystem& system, Progress& progress) {
  std::visit([&](auto& kind) { kind.iterate(system, progress); }, outer);
}

void forget(OuterIteration& outer) {
  std::visit(
      [](auto& kind) {
        if constexpr (requires { kind.forget(); }) kind.forget();
      },
      outer);
}

void forget_stiffness(OuterIteration& outer) {
  std::visit(
      [](auto& kind) {
        if constexpr (requires { kind.forget_stiffness(); }) kind.forget_stiffness();
      },
      outer);
}

void end(OuterIteration& outer, StepSystem& system) {
  std::visit(
      [&](auto& kind) {
        if constexpr (requires { kind.end(system); }) kind.end(system);
      },
      outer);
}

std::optional<RowResidual> settle(OuterIteration& outer, StepSystem& system, const Progress& progress,
                                  bool stalled) {
  return std::visit(
      [&](auto& kind) -> std::optional<RowResidual> {
        if constexpr (requires { kind.settle(system, progress, stalled); })
          return kind.settle(system, progress, stalled);
        return std::nullopt;
      },
      outer);
}

void unsettle(OuterIteration& outer, StepSystem& system) {
  std::visit(
      [&](auto& kind) {
        if constexpr (requires { kind.unsettle(system); }) kind.unsettle(system);
      },
      outer);
}

bool takes_over(const OuterIteration& outer) {
  const auto* automatic = std::get_if<Automatic>(&outer);
  return automatic != nullptr && automatic->takes_over();
}

bool on_potential(const OuterIteration& outer) {
  if (const auto* automatic = std::get_if<Automatic>(&outer)) return automatic->on_potential();
  return std::holds_alternative<QuasiNewton>(outer);
}

bool solves_step(const OuterIteration& outer) {
  return std::visit([]<class Kind>(const Kind&) { return Kind::solves_step; }, outer);
}

}  // namespace pbd
