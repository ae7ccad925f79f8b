// What does each effect cost in rows, bytes and seconds? Is an effect that is absent, or present and empty,
// free? Does the cost grow linearly with the scene?
#include <algorithm>
#include <chrono>
#include <cmath>

#include "harness/rows_of_step.h"
#include "linear/linear_solver.h"
#include "scenes/contacts.h"
#include "scenes/standard.h"
#include "step/step.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using SteadyClock = std::chrono::steady_clock;

/// Everything at once: a solid, a sheet with links, strain and bending held by anchors, and a loaded chain.
Scene mixed() {
  Scene scene = cantilever(8, {1e5, 0.3}, Strain::corotational);
  const TriangleMesh mesh = grid_sheet({12, 12}, {1, 1}, Vec3(0, 1, 0));
  const int first = add_sheet_nodes(scene, mesh, 0.2);
  scene.effects.emplace_back(sheet_links(mesh, first, 1e-4));
  scene.effects.emplace_back(sheet_strain(mesh, first, {1e5, 0.3}, 1e-3));
  scene.effects.emplace_back(sheet_bending(mesh, first, 1e2));
  Anchor anchors;
  for (int node = first; node <= first + 12; ++node) {
    anchors.node.push_back(node);
    anchors.target.emplace_back(scene.initial.x.col(node));
    anchors.compliance.push_back(0);
  }
  scene.effects.emplace_back(std::move(anchors));
  scene.effects.emplace_back(ExternalForce{.node = {first + 80}, .force = {Vec3(0, 0, 0.1)}});
  return scene;
}

constexpr int frames = 20;

Method fixed_work(std::string_view relaxation = "gauss_seidel") {
  Method method;
  method.relaxation = relaxation;
  method.tolerance = 0;  // never met: every run does the same work
  method.max_outer = 2;
  method.max_sweeps = 10;
  return method;
}

struct RunScene {
  State state;
  double seconds;
  std::vector<EffectCost> costs;
};

RunScene run_scene(const Scene& scene) {
  const Method method = fixed_work();
  Workspace workspace(scene, method);
  State state = scene.initial;
  const auto start = SteadyClock::now();
  for (int k = 0; k < frames; ++k) step(workspace, 1.0 / 240, state);
  const double seconds = std::chrono::duration<double>(SteadyClock::now() - start).count();
  return {state, seconds, workspace.costs()};
}

/// Smallest times of two scenes run in turns, after a discarded pair.
std::pair<double, double> in_turns(const Scene& a, const Scene& b) {
  run_scene(a);
  run_scene(b);
  double first = infinity, second = infinity;
  for (int repeat = 0; repeat < 15; ++repeat) {
    first = std::min(first, run_scene(a).seconds);
    second = std::min(second, run_scene(b).seconds);
  }
  return {first, second};
}

void costs_per_effect(Context& context, Table& table) {
  const Scene scene = mixed();
  const RunScene run = run_scene(scene);
  double attributed = 0;
  for (const auto& cost : run.costs) {
    attributed += cost.seconds;
    table.row(
        {"mixed", std::string(cost.effect), cost.rows, cost.bytes, cost.seconds, cost.seconds / frames});
  }
  table.row({"mixed", "outside effects", std::int64_t{0}, std::int64_t{0}, run.seconds - attributed,
             (run.seconds - attributed) / frames});
  context.advance("costs");
}

void absent_is_free(Context& context) {
  const Scene scene = chain(200);
  Scene padded = scene;
  padded.effects.insert(padded.effects.begin(), {Bending{}, TetStrain{}});
  padded.effects.emplace_back(TriangleStrain{});
  padded.effects.emplace_back(ExternalForce{});
  padded.effects.emplace_back(Contact{});
  const State a = run_scene(scene).state, b = run_scene(padded).state;
  context.verdict(
      "effects.empty.bitwise", "effects that are present and empty change no bit of the result",
      "entries that differ",
      static_cast<double>((a.x.array() != b.x.array()).count() + (a.v.array() != b.v.array()).count()), 0);
  const auto [without, with] = in_turns(scene, padded);
  context.verdict("effects.empty.free", "effects that are present and empty cost nothing measurable",
                  "|time with / time without - 1|", std::abs(with / without - 1), 0.05);

  Scene removed = mixed();
  std::erase_if(removed.effects,
                [](const Effect& effect) { return std::holds_alternative<TetStrain>(effect); });
  const auto [light, heavy] = in_turns(removed, mixed());
  // Its nodes stay, and caches and clocks blur what a share of a run is: at least half of it must go.
  const auto costs = run_scene(mixed()).costs;
  const auto strain = std::find_if(costs.begin(), costs.end(),
                                   [](const EffectCost& cost) { return cost.effect == TetStrain::name; });
  context.verdict("effects.removed.cheaper", "removing the solid's strain takes its cost away",
                  "share of its attributed seconds that stays", 1 - (heavy - light) / strain->seconds, 0.5);
  context.advance("absent effects");
}

/// Layers of balls that touch each other and the ground.
Scene touching_balls(double friction) {
  BodyScene build({.friction = friction});
  build.ground();
  constexpr double radius = 0.1;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 5; ++k) build.ball(radius, 4, {radius * Vec3(2 * i, 2 * j, 2 * k + 1)});
  return build.finish();
}

void frictionless_is_cheap(Context& context, Table& table) {
  const std::vector<Scene> scenes{touching_balls(0), touching_balls(0.5)};
  std::vector<double> rows;
  for (const Scene& scene : scenes) {
    const std::string name = rows.empty() ? "balls, no friction" : "balls, friction 0.5";
    const auto costs = run_scene(scene).costs;
    const auto contact = std::find_if(costs.begin(), costs.end(),
                                      [](const EffectCost& cost) { return cost.effect == Contact::name; });
    table.row({name, std::string(contact->effect), contact->rows, contact->bytes, contact->seconds,
               contact->seconds / frames});
    rows.push_back(static_cast<double>(contact->rows));
  }
  context.verdict("effects.frictionless.rows", "contacts without friction have one row, not three",
                  "|rows without / rows with friction - 1/3|", std::abs(rows[0] / rows[1] - 1.0 / 3), 1e-15);
  const auto [without, with] = in_turns(scenes[0], scenes[1]);
  context.verdict("effects.frictionless.cheaper", "and cost less", "time without / time with friction",
                  without / with, 1);
  context.advance("friction");
}

/// Seconds a sweep of `relaxation` over the rows of a step, the smallest of several.
double sweep_seconds(LinearStep step, std::string_view relaxation) {
  constexpr int sweeps = 8;
  double best = infinity;
  LinearSolver any = make_linear_solver(relaxation);
  std::visit(
      [&](auto& kind) {
        kind.begin(step.rows, step.v_free, true);
        for (int k = 0; k < sweeps; ++k) {
          const auto start = SteadyClock::now();
          kind.sweep(step.rows, step.v_free, nullptr);
          best = std::min(best, std::chrono::duration<double>(SteadyClock::now() - start).count());
        }
      },
      any);
  return best;
}

/// Least-squares slope of log(time) over log(size).
double exponent(const std::vector<double>& size, const std::vector<double>& time) {
  double mean_x = 0, mean_y = 0, above = 0, below = 0;
  for (std::size_t i = 0; i < size.size(); ++i) {
    mean_x += std::log(size[i]) / static_cast<double>(size.size());
    mean_y += std::log(time[i]) / static_cast<double>(size.size());
  }
  for (std::size_t i = 0; i < size.size(); ++i) {
    above += (std::log(size[i]) - mean_x) * (std::log(time[i]) - mean_y);
    below += std::pow(std::log(size[i]) - mean_x, 2);
  }
  return above / below;
}

struct Family {
  std::string name;
  std::vector<int> sizes;  // elements, about
  std::int64_t rows_an_element;
  Scene (*make)(int);
};

Scene chain_of(int links) {
  return chain(links);
}

/// Cube of about `tets` tetrahedra.
Scene cube_of(int tets) {
  const int cells = std::max(1, static_cast<int>(std::lround(std::cbrt(tets / 6.0))));
  return clamped_solid(kuhn_grid({cells, cells, cells}, Vec3::Ones()), {1e6, 0.3}, Strain::corotational);
}

void scaling(Context& context, Table& table) {
  const std::vector<Family> families{{"chain", {1'000, 10'000, 100'000, 1'000'000}, 1, chain_of},
                                     {"solid", {1'000, 10'000, 100'000, 300'000}, 6, cube_of}};
  const std::vector<std::string> relaxations{"gauss_seidel", "nesterov_jacobi"};
  for (const auto& family : families) {
    std::vector<double> rows;
    std::vector<std::vector<double>> time(relaxations.size());
    for (const int size : family.sizes) {
      const Scene scene = family.make(size);
      const LinearStep step = linear_step(scene, scene.initial, 1.0 / 240);
      rows.push_back(static_cast<double>(row_count(step.rows)));
      for (std::size_t r = 0; r < relaxations.size(); ++r)
        time[r].push_back(sweep_seconds(step, relaxations[r]));
      context.advance(family.name);
    }
    for (std::size_t r = 0; r < relaxations.size(); ++r) {
      const double slope = exponent(rows, time[r]);
      for (std::size_t i = 0; i < rows.size(); ++i)
        table.row({family.name, relaxations[r], static_cast<std::int64_t>(rows[i]),
                   static_cast<std::int64_t>(rows[i]) / family.rows_an_element, time[r][i], slope, "ok", ""});
      context.verdict("effects.linear." + family.name + "." + relaxations[r],
                      "the time of a sweep grows linearly", "exponent", slope, 1.1);
    }
  }
}

}  // namespace

void effects_cost(Context& context) {
  context.begin(3 + 8);
  Table costs = context.table("costs", {"scene", "effect", "rows", "bytes", "wall_s", "wall_s_per_step"});
  Table growth = context.table("scaling", {"scene", "relaxation", "rows", "elements", "wall_s_per_sweep",
                                           "exponent", "status", "reason"});
  costs_per_effect(context, costs);
  absent_is_free(context);
  frictionless_is_cheap(context, costs);
  scaling(context, growth);
  costs.close();
  growth.close();
}

}  // namespace pbdcheck
