#include "studies/cost/effects_absent.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "harness/measure.h"
#include "scenes/contacts.h"
#include "scenes/standard.h"
#include "studies/cost/fixed_work.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// A sheet that falls far above a ground; nothing but its links and gravity, and the ground's body.
struct Falling {
  Scene scene;
  int first = 0;          // of the sheet's nodes
  std::size_t links = 0;  // of the effects
  Contact ground;         // of the ground and the nodes, not in the scene

  Falling() {
    BodyScene build({.friction = 0.5, .restitution = 0.5});
    build.ground();
    scene = build.finish();
    ground = build.contact();
    std::erase_if(scene.effects, [](const Effect& effect) {
      return std::holds_alternative<Contact>(effect) || std::holds_alternative<Gyroscopic>(effect);
    });
    const TriangleMesh mesh = grid_sheet({14, 14}, {1, 1}, Vec3(0, 0, 100));
    first = add_sheet_nodes(scene, mesh, 0.2);
    links = scene.effects.size();
    scene.effects.emplace_back(sheet_links(mesh, first, 1e-4));
    for (int node = first; node < static_cast<int>(scene.mass.size()); ++node) {
      ground.node.push_back(node);
      ground.radius.push_back(0.01);
      ground.node_material.push_back(0);
    }
  }
};

struct Added {
  std::string effect, state;
  Scene scene;
};

template <std::size_t... Kind>
std::vector<Effect> empty_effects(std::index_sequence<Kind...>) {
  return {Effect(std::in_place_index<Kind>)...};
}

/// The scene with each effect empty, and with what it lists but does not use.
std::vector<Added> added_scenes(const Falling& falling) {
  std::vector<Added> all{{"none", "the same scene", falling.scene}};
  const auto with = [&](std::string_view name, const char* state, Effect effect) {
    all.push_back({std::string(name), state, falling.scene});
    all.back().scene.effects.push_back(std::move(effect));
  };
  for (Effect& effect : empty_effects(std::make_index_sequence<std::variant_size_v<Effect>>())) {
    // These have no list: no acceleration, and bodies that do not turn.
    if (auto* gravity = std::get_if<Gravity>(&effect)) gravity->acceleration.setZero();
    const std::string_view name = std::visit([](const auto& one) { return one.name; }, effect);
    with(name, "empty", std::move(effect));
  }
  with(Contact::name, "never touches", falling.ground);
  Contact continuous = falling.ground;
  continuous.continuous = true;
  with(Contact::name, "never touches, continuous", continuous);
  all.push_back({std::string(Distance::name), "damping 0", falling.scene});
  auto& links = std::get<Distance>(all.back().scene.effects[falling.links]);
  links.damping.assign(links.node.size(), 0);
  return all;
}

std::int64_t bytes_of_rows(const FixedRun& run) {
  std::int64_t bytes = 0;
  for (const EffectCost& cost : run.costs) bytes += cost.bytes;
  return bytes;
}

std::int64_t entries_that_differ(const State& a, const State& b) {
  return (a.x.array() != b.x.array()).count() + (a.v.array() != b.v.array()).count();
}

}  // namespace

void effects_absent(Context& context) {
  constexpr FixedWork timed_runs{"plain", 12};
  const Falling falling;
  const FixedRun alone = timed_runs.run(falling.scene);
  Table table = context.table("absent", {"effect", "case", "time_ratio", "time_low", "time_high",
                                         "bytes_ratio", "entries_that_differ"});
  double differ = 0;
  WorstSpread empty, idle;
  for (const Added& added : added_scenes(falling)) {
    const FixedRun with = timed_runs.run(added.scene);
    const Measured ratio(timed_runs.time_ratios(added.scene, falling.scene));
    const std::int64_t apart = entries_that_differ(with.end, alone.end);
    const double bytes = static_cast<double>(bytes_of_rows(with)) / static_cast<double>(bytes_of_rows(alone));
    table.row({added.effect, added.state, ratio.value, ratio.low, ratio.high, bytes, apart});
    differ += static_cast<double>(apart);
    Measured change = std::abs(ratio.value - 1);
    const auto [near, far] = std::minmax({std::abs(ratio.low - 1), std::abs(ratio.high - 1)});
    change.low = ratio.low < 1 && ratio.high > 1 ? 0 : near;
    change.high = far;
    if (added.state == "empty") empty.add(change, added.effect);
    if (added.state.starts_with("never touches")) idle.add(change, added.state);
    context.advance(added.effect + ", " + added.state);
  }
  table.close();
  context.verdict(Basis::theory, "effects.empty.bitwise",
                  "effects that are empty or that nothing comes to use change no bit of the result",
                  "entries that differ", differ, 0);
  context.verdict(Basis::goal, "effects.empty.free",
                  "no effect that is present and empty costs anything measurable",
                  "largest |time with / time without - 1|, of " + empty.owner(), empty.value(), 0.02);
  context.verdict(Basis::goal, "effects.idle.free", "contact that never touches costs nothing measurable",
                  "largest |time with / time without - 1|, of " + idle.owner(), idle.value(), 0.03);
}

}  // namespace pbdcheck
