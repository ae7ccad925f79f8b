#include "studies/cost/moving_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/files.h"
#include "scenes/arch.h"
#include "scenes/contacts.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

SceneFile described(Scene scene) {
  SceneFile file;
  file.scene = std::move(scene);
  return file;
}

Scene struck(Scene scene, int body, const Vec3& velocity) {
  scene.initial.v.col(body) = velocity;
  return scene;
}

/// Solved to a tolerance far below any error told.
Setting finest_setting(std::int64_t steps) {
  Setting finest{.method = {}, .steps = steps};
  finest.method.relaxation = "direct";
  finest.method.tolerance = 1e-10;
  return finest;
}

Truth exact_end(const MovingScene& scene) {
  const Truth truth = ode_truth(scene.file, scene.duration);
  if (!truth.reason.empty()) throw std::runtime_error("ode, " + scene.name + ": " + truth.reason);
  return truth;
}

constexpr double slope = 0.2, rubbing = 0.5, first_speed = 1;  // rad, coefficient, m/s

/// A box that slides down and comes to rest: friction exceeds the slope's pull by a constant force.
Truth stopped_box(const MovingScene& scene) {
  const double slowing = gravity * (rubbing * std::cos(slope) - std::sin(slope));
  const double way = first_speed * first_speed / (2 * slowing);
  State end = scene.file.scene.initial;
  end.x.col(1) += way * Vec3(std::cos(slope), 0, -std::sin(slope));
  end.v.setZero();
  constexpr double rounding = 1e-15;  // of a sum of a few terms
  return {end, rounding, "closed form"};
}

SceneFile cut(std::string_view name, const std::vector<std::string>& settings) {
  return read_scene_file(scenes_folder() / fmt::format("{}.toml", name), settings);
}

}  // namespace

std::vector<MovingScene> moving_scenes(bool full) {
  const int finer = full ? 2 : 0, stones = full ? 25 : 7, boxes = full ? 10 : 3, side = full ? 3 : 2;
  const auto smooth = [&](std::string name, Scene scene, double duration, std::int64_t coarsest, int levels,
                          bool resolved) {
    return MovingScene{.name = std::move(name),
                       .file = described(std::move(scene)),
                       .duration = duration,
                       .coarsest = coarsest,
                       .levels = levels + finer,
                       .finest = finest_setting(coarsest << (levels + finer + 1)),
                       .integrators = {"implicit_euler", "generalised_alpha"},
                       .resolved = resolved,
                       .exact = exact_end};
  };
  const auto touching = [&](std::string name, SceneFile file, double duration, std::int64_t coarsest,
                            int levels, int beyond) {
    return MovingScene{.name = std::move(name),
                       .file = std::move(file),
                       .duration = duration,
                       .coarsest = coarsest,
                       .levels = levels + finer,
                       .finest = finest_setting(coarsest << (levels + finer - 1 + beyond)),
                       .integrators = {"implicit_euler", "newmark"}};
  };
  const Arch arch{1.2 * limit_thickness(stones), stones};
  std::vector<MovingScene> all{
      smooth("pendulum", pendulum(1.5, 0), 1, 20, 8, true),
      smooth("chain", chain(full ? 10 : 4), 0.5, 20, 8, true),
      smooth("cloth", cloth(full ? 8 : 4), 0.25, 10, 5, false),
      smooth("cantilever", cantilever(4, {1e5, 0.3}, Strain::green), 0.25, 10, 5, true),
      touching("incline", described(sliding_box(slope, rubbing, first_speed)), 0.5, 20, 6, 2),
      touching("stack", described(struck(column(boxes), boxes, {0.5, 0.3, 0})), 0.2, 10, 4, 3),
      touching("pile", described(pile()), 0.1, 10, 4, 3),
      touching("arch", described(struck(arch.scene(), 1 + stones / 2, {0.02, 0.01, -0.2})), 0.05, 10, 3, 3),
      touching("boxes_on_ground",
               cut("boxes_on_ground", {fmt::format("rigid_body.1.copies=[{0},{0},{0}]", side)}), 0.2, 10, 5,
               4),
      touching("bunnies_on_cloth",
               cut("bunnies_on_cloth", {fmt::format("cloth.0.cells=[{0},{0}]", full ? 16 : 8),
                                        fmt::format("rigid_body.1.copies=[1,1,{}]", full ? 2 : 1)}),
               0.2, 10, 3, 3),
      touching("flexible_cow", cut("flexible_cow", {"solid.0.translation_m=[0,0,0.1]"}), 0.1, 5, 3, 1)};
  if (!full) {
    all[all.size() - 2].dear = 1;
    all.back().dear = 2;
  }
  std::find_if(all.begin(), all.end(), [](const auto& each) { return each.name == "incline"; })->exact =
      stopped_box;
  return all;
}

}  // namespace pbdcheck
