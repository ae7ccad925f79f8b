#include "studies/cost/effects_absent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "harness/measure.h"
#include "harness/probes.h"
#include "scenes/contacts.h"
#include "scenes/mechanisms.h"
#include "scenes/standard.h"
#include "studies/cost/fixed_work.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// How an effect is there: not at all; without an entry; with contacts that never come about; with entries
/// that have no consequence; with one.
enum class Presence { control, empty, apart, idle, used };
constexpr std::array<std::string_view, 5> presence_names{"control", "empty", "never touches", "idle", "used"};

/// A scene with an effect, which nothing uses unless it is `used`, and the same one without it.
struct Added {
  std::string effect, state;
  Presence presence;
  Scene with, without;
  bool same_bits = true;  // else the mathematics is the same, and rounding another
  FixedWork::AfterStep after{};
};

/// A sheet that falls far above a ground; nothing but its links and gravity, and the ground's body.
struct Falling {
  Scene scene;
  int first = 0;            // of the sheet's nodes
  std::size_t links = 0;    // of the effects
  Contact ground, surface;  // of the ground and the nodes, of the sheet and itself; not in the scene

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
    for (const auto& [i, j, k] : mesh.triangles)
      surface.triangle.push_back({first + i, first + j, first + k});
  }
};

template <std::size_t... Kind>
std::vector<Effect> empty_effects(std::index_sequence<Kind...>) {
  return {Effect(std::in_place_index<Kind>)...};
}

/// The sheet with each effect empty, with contact that never comes about, and with damping 0.
void add_falling(std::vector<Added>& all) {
  const Falling falling;
  const auto with = [&](std::string_view name, const char* state, Presence presence, Effect effect) {
    all.push_back({std::string(name), state, presence, falling.scene, falling.scene});
    all.back().with.effects.push_back(std::move(effect));
  };
  all.push_back({"none", "the same scene", Presence::control, falling.scene, falling.scene});
  for (Effect& effect : empty_effects(std::make_index_sequence<std::variant_size_v<Effect>>())) {
    // These have no list: no acceleration, and bodies that do not turn.
    if (auto* gravity = std::get_if<Gravity>(&effect)) gravity->acceleration.setZero();
    const std::string_view name = std::visit([](const auto& one) { return one.name; }, effect);
    with(name, "empty", Presence::empty, std::move(effect));
  }
  with(Contact::name, "never touches", Presence::apart, falling.ground);
  Contact continuous = falling.ground;
  continuous.continuous = true;
  with(Contact::name, "never touches, continuous", Presence::apart, continuous);
  with(Contact::name, "never touches itself", Presence::apart, falling.surface);
  all.push_back({std::string(Distance::name), "damping 0", Presence::idle, falling.scene, falling.scene});
  auto& links = std::get<Distance>(all.back().with.effects[falling.links]);
  links.damping.assign(links.node.size(), 0);
}

/// Balls that spin apart from each other on a ground. A sweep solves their steps.
Scene resting(const ContactLaw& on_ground, const ContactLaw& of_balls) {
  constexpr int side = 8;
  constexpr double radius = 0.1;
  BodyScene build(on_ground);
  build.materials(2, on_ground);
  build.law(1, 1, of_balls);
  build.ground();
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      build.ball(radius, 4, {.position = Vec3(i, j, radius), .spin = Vec3(1, 2, 3)}, 1);
  return build.finish();
}

FixedWork::AfterStep probing(SceneFile file) {
  return [file = std::move(file)](const Workspace& stepped, const State& state) {
    std::vector<Cell> row;
    append_probes(file, state, &stepped, row);
  };
}

/// The balls with laws of contact that nothing uses, with torques of equal moments, and with probes. What has
/// no friction in its law is a contact of friction 0: there is no other one to compare it with.
void add_resting(std::vector<Added>& all) {
  const ContactLaw smooth{.friction = 0};
  const Scene scene = resting(smooth, smooth);
  const auto with = [&](std::string_view name, const char* state, Presence presence, const Scene& changed) {
    all.push_back({std::string(name), state, presence, changed, scene});
  };
  with(Contact::name, "friction of pairs that never touch", Presence::idle,
       resting(smooth, {.friction = 0.5}));
  with(Contact::name, "restitution of pairs that never touch", Presence::idle,
       resting(smooth, {.friction = 0, .restitution = 0.5}));
  with(Contact::name, "restitution of what rests", Presence::idle,
       resting({.friction = 0, .restitution = 0.5}, smooth));
  all.back().same_bits = false;  // the speeds that rounding leaves collide
  with(Gyroscopic::name, "equal moments", Presence::idle, scene);
  std::erase_if(all.back().without.effects,
                [](const Effect& effect) { return std::holds_alternative<Gyroscopic>(effect); });
  SceneFile file;
  file.scene = scene;
  with("probes", "empty", Presence::empty, scene);
  all.back().after = probing(file);
  for (const std::string_view kind : probe_kinds)
    if (kind != "joint_force") file.probes.push_back({.kind = std::string(kind), .name = "", .body = 1});
  with("probes", "each kind but of joints", Presence::used, scene);
  all.back().after = probing(file);
}

/// A chain of rods, and between the centres of neighbours distances that ask for `more` m than there is.
Scene linked_rods(double more, double compliance, const std::optional<ForceBounds>& bounds) {
  Scene scene = rod_chain(50);
  BodyDistance links;
  for (int b = 1; b < static_cast<int>(scene.bodies.size()); ++b) {
    const auto centre = [&](int body) {
      return scene.initial.x.col(scene.bodies[static_cast<std::size_t>(body)].node);
    };
    links.body.push_back({b - 1, b});
    links.point.push_back({Vec3::Zero(), Vec3::Zero()});
    links.rest_length.push_back((centre(b) - centre(b - 1)).norm() + more);
    links.compliance.push_back(compliance);
    if (bounds) links.bounds.push_back(*bounds);
  }
  scene.effects.emplace_back(std::move(links));
  return scene;
}

/// The rods with limits: ropes that are never near being taut, and rows whose bounds are infinite.
void add_limits(std::vector<Added>& all) {
  constexpr double soft = 1e-3;  // m/N
  const std::string name(BodyDistance::name);
  all.push_back({name, "limit never reached", Presence::idle, linked_rods(1, 0, ForceBounds{-infinity, 0}),
                 rod_chain(50)});
  all.push_back({name, "infinite bounds", Presence::idle,
                 linked_rods(0, soft, ForceBounds{-infinity, infinity}), linked_rods(0, soft, {})});
  all.back().same_bits = false;  // an impulse is cut to its bounds, and changes by what that leaves
}

std::vector<Added> added_scenes() {
  std::vector<Added> all;
  add_falling(all);
  add_resting(all);
  add_limits(all);
  return all;
}

std::int64_t bytes_of_rows(const FixedRun& run) {
  std::int64_t bytes = 0;
  for (const EffectCost& cost : run.costs) bytes += cost.bytes;
  return bytes;
}

std::int64_t entries_that_differ(const State& a, const State& b) {
  std::int64_t count = (a.x.array() != b.x.array()).count() + (a.v.array() != b.v.array()).count() +
                       (a.spin.array() != b.spin.array()).count();
  for (std::size_t i = 0; i < a.orientation.size(); ++i)
    count += (a.orientation[i].coeffs().array() != b.orientation[i].coeffs().array()).count();
  return count;
}

/// |ratio - 1|, with the range of that.
Measured time_change(const Measured& ratio) {
  Measured change = std::abs(ratio.value - 1);
  const auto [near, far] = std::minmax({std::abs(ratio.low - 1), std::abs(ratio.high - 1)});
  change.low = ratio.low < 1 && ratio.high > 1 ? 0 : near;
  change.high = far;
  return change;
}

}  // namespace

void effects_absent(Context& context) {
  constexpr FixedWork timed_runs{"plain", 12};
  Table table = context.table("absent", {"effect", "case", "presence", "time_ratio", "time_low", "time_high",
                                         "first_longer_steps", "bytes_ratio", "entries_that_differ"});
  double differ = 0;
  Worst bytes;
  std::array<WorstSpread, presence_names.size()> changes;
  for (const Added& added : added_scenes()) {
    const FixedRun with = timed_runs.run(added.with, added.after), alone = timed_runs.run(added.without);
    const TimesBeside times = timed_runs.beside(added.with, added.without, added.after);
    const Measured ratio(times.ratios);
    const std::int64_t apart = entries_that_differ(with.end, alone.end);
    const double bytes_ratio =
        static_cast<double>(bytes_of_rows(with)) / static_cast<double>(bytes_of_rows(alone));
    const auto presence = static_cast<std::size_t>(added.presence);
    const std::string name = added.effect + ", " + added.state;
    table.row({added.effect, added.state, std::string(presence_names[presence]), ratio.value, ratio.low,
               ratio.high, times.first, bytes_ratio, apart});
    if (added.same_bits) differ += static_cast<double>(apart);
    if (added.presence == Presence::empty || added.presence == Presence::apart)
      bytes.add(std::abs(bytes_ratio - 1), name);
    changes[presence].add(time_change(ratio), name);
    context.advance(name);
  }
  table.close();
  context.verdict(Basis::theory, "effects.empty.bitwise",
                  "effects that are empty or that nothing comes to use change no bit of the result",
                  "entries that differ", differ, 0);
  context.verdict(Basis::theory, "effects.empty.bytes",
                  "effects that are empty and contact that never touches have no rows",
                  "largest |bytes with / bytes without - 1|, of " + bytes.owner(), bytes.value(), 0);
  const auto costs_nothing = [&](std::string_view id, std::string_view statement, Presence presence,
                                 double bound) {
    const WorstSpread& worst = changes[static_cast<std::size_t>(presence)];
    context.verdict(Basis::goal, id, statement,
                    "largest |time with / time without - 1| after the first step, of " + worst.owner(),
                    worst.value(), bound);
  };
  costs_nothing("effects.empty.free", "no effect that is present and empty costs anything measurable",
                Presence::empty, 0.02);
  costs_nothing("effects.idle.free", "contact that never touches costs nothing measurable", Presence::apart,
                0.03);
  costs_nothing("effects.unused.free",
                "nothing that is listed without a consequence costs anything measurable", Presence::idle,
                0.03);
}

}  // namespace pbdcheck
