// What does each effect cost in rows, bytes and seconds? Is an effect that is absent, or present and empty,
// free? Does the cost grow linearly with the scene?
#include <algorithm>
#include <chrono>
#include <cmath>

#include "harness/measure.h"
#include "harness/rows_of_step.h"
#include "scenes/contacts.h"
#include "scenes/standard.h"
#include "step/step.h"
#include "studies/cost/effects_absent.h"
#include "studies/cost/effects_scaling.h"
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

/// time of a / time of b: of each repeat, from the smallest times of three runs in turns, after a discarded
/// pair.
std::vector<double> ratios(const Scene& a, const Scene& b) {
  run_scene(a);
  run_scene(b);
  std::vector<double> all;
  for (int repeat = 0; repeat < 5; ++repeat) {
    double first = infinity, second = infinity;
    for (int turn = 0; turn < 3; ++turn) {
      first = std::min(first, run_scene(a).seconds);
      second = std::min(second, run_scene(b).seconds);
    }
    all.push_back(first / second);
  }
  return all;
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

void removed_is_cheaper(Context& context) {
  Scene removed = mixed();
  std::erase_if(removed.effects,
                [](const Effect& effect) { return std::holds_alternative<TetStrain>(effect); });
  // Its rows are no longer swept, its nodes stay.
  context.verdict(Basis::theory, "effects.removed.cheaper", "without the solid's strain a scene costs less",
                  "time without / time with", Measured(ratios(removed, mixed())), 1);
  context.advance("an effect removed");
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
  context.verdict(Basis::theory, "effects.frictionless.rows",
                  "contacts without friction have one row, not three",
                  "|rows without / rows with friction - 1/3|", std::abs(rows[0] / rows[1] - 1.0 / 3), 1e-15);
  context.verdict(Basis::theory, "effects.frictionless.cheaper", "and cost less",
                  "time without / time with friction", Measured(ratios(scenes[0], scenes[1])), 1);
  context.advance("friction");
}

}  // namespace

void effects_cost(Context& context) {
  context.begin(3 + 9 + 23 + 2);
  Table costs = context.table("costs", {"scene", "effect", "rows", "bytes", "wall_s", "wall_s_per_step"});
  costs_per_effect(context, costs);
  effects_absent(context);
  effects_stripped(context);
  removed_is_cheaper(context);
  frictionless_is_cheap(context, costs);
  effects_scaling(context);
  costs.close();
}

}  // namespace pbdcheck
