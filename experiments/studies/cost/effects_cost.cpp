// What does each effect cost in rows, bytes and seconds? Is an effect that is absent, or present and empty,
// free? Does the cost grow linearly with the scene?
#include <algorithm>
#include <cmath>

#include "harness/measure.h"
#include "scenes/contacts.h"
#include "scenes/standard.h"
#include "studies/cost/effects_absent.h"
#include "studies/cost/effects_scaling.h"
#include "studies/cost/fixed_work.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

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

constexpr FixedWork timed_runs{"auto", 3};

void costs_per_effect(Context& context, Table& table) {
  const Scene scene = mixed();
  const FixedRun run = timed_runs.run(scene);
  const double seconds = run.first + run.later;
  double attributed = 0;
  for (const auto& cost : run.costs) {
    attributed += cost.seconds;
    table.row({"mixed", std::string(cost.effect), cost.rows, cost.bytes, cost.seconds,
               cost.seconds / FixedWork::steps});
  }
  table.row({"mixed", "outside effects", std::int64_t{0}, std::int64_t{0}, seconds - attributed,
             (seconds - attributed) / FixedWork::steps});
  context.advance("costs");
}

void removed_is_cheaper(Context& context) {
  Scene removed = mixed();
  std::erase_if(removed.effects,
                [](const Effect& effect) { return std::holds_alternative<TetStrain>(effect); });
  // Its rows are no longer swept, its nodes stay.
  context.verdict(Basis::theory, "effects.removed.cheaper", "without the solid's strain a scene costs less",
                  "time without / time with", Measured(timed_runs.beside(removed, mixed()).ratios), 1);
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
    const auto costs = timed_runs.run(scene).costs;
    const auto contact = std::find_if(costs.begin(), costs.end(),
                                      [](const EffectCost& cost) { return cost.effect == Contact::name; });
    table.row({name, std::string(contact->effect), contact->rows, contact->bytes, contact->seconds,
               contact->seconds / FixedWork::steps});
    rows.push_back(static_cast<double>(contact->rows));
  }
  context.verdict(Basis::theory, "effects.frictionless.rows",
                  "contacts without friction have one row, not three",
                  "|rows without / rows with friction - 1/3|", std::abs(rows[0] / rows[1] - 1.0 / 3), 1e-15);
  context.verdict(Basis::theory, "effects.frictionless.cheaper", "and cost less",
                  "time without / time with friction",
                  Measured(timed_runs.beside(scenes[0], scenes[1]).ratios), 1);
  context.advance("friction");
}

}  // namespace

void effects_cost(Context& context) {
  context.begin(3 + 9 + 32 + 6);
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
