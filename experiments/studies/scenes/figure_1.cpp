// The three scenes of the paper's first figure by one solver and one default method: what they cost, and what
// stays true of them while they fall, strike and come to rest.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "harness/contact_sums.h"
#include "harness/files.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "harness/step_checks.h"
#include "harness/vtk.h"
#include "scenes/contacts.h"
#include "scenes/scene_file.h"
#include "studies/experiments.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct PaperScene {
  std::string_view name;
  double quick_duration;  // s, as far as half a minute of computing takes it
};
constexpr std::array<PaperScene, 3> paper_scenes{
    {{"boxes_on_ground", 2}, {"bunnies_on_cloth", 0.4}, {"flexible_cow", 2}}};

/// Shares of the whole run at which a scene is drawn.
constexpr std::array<double, 4> pictured{0, 0.4, 0.7, 1};

constexpr std::int64_t shown = 6;  // steps a line of progress

/// m: the least edge of the box about a body's surface, along its axes as stated; else about all nodes.
double body_size(const SceneFile& file) {
  const auto least_edge = [](const Points& x) -> double {
    return x.cols() > 0 ? (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).minCoeff() : infinity;
  };
  double least = infinity;
  for (const NamedBody& body : file.bodies) least = std::min(least, least_edge(surface_of(body.shape).x));
  return std::isfinite(least) ? least : least_edge(file.scene.initial.x);
}

/// Of a scene's run.
struct SceneRun {
  std::int64_t steps = 0, ok = 0, outer = 0, sweeps = 0, most_contacts = 0, most_rows = 0;
  double seconds = 0, overlap_at_end = 0, kinetic_at_end = 0;
  Worst overlap, excess, bilateral;  // m, J, m
  Status worst = Status::ok;
  std::string reason;
  StepChecks checks;
};

/// Draws the nodes and the bodies at the instants that are asked for.
class Pictures {
 public:
  Pictures(const std::filesystem::path& directory, const SceneFile& file)
      : nodes_(directory, "simulation", "frame", node_cells(file.scene)), surfaces_(file.scene, file.bodies) {
    if (!surfaces_.empty()) bodies_.emplace(directory, "bodies", "bodies", surfaces_.cells());
  }
  void add(const State& state) {
    nodes_.add_frame(state.time, state.x, state.v);
    if (!bodies_) return;
    Points x, v;
    surfaces_.place(state, x, v);
    bodies_->add_frame(state.time, x, v);
  }
  void close() {
    nodes_.close();
    if (bodies_) bodies_->close();
  }

 private:
  VtkSeries nodes_;
  BodySurfaces surfaces_;
  std::optional<VtkSeries> bodies_;
};

double energy_of(const Scene& scene, const State& state) {
  return kinetic_energy(scene, state) + gravity_energy(scene, state) + elastic_energy(scene, state);
}

double bilateral_error(const Scene& scene, const State& state) {
  double most = 0;
  for (const Effect& effect : scene.effects)
    if (error_unit(effect)) most = larger(most, constraint_error(scene, effect, state));
  return most;
}

SceneRun run_scene(std::string_view name, const SceneFile& file, double h, double duration, Table& series,
                   const std::filesystem::path& pictures_in, Context& context) {
  SceneRun run;
  const Scene& scene = file.scene;
  Workspace workspace(scene, file.method);
  State state = scene.initial;
  require_writable(pictures_in);
  Pictures pictures(pictures_in, file);
  pictures.add(state);
  const double start = energy_of(scene, state);
  const auto steps = static_cast<std::int64_t>(std::lround(duration / h));
  std::size_t drawn = 1;
  for (std::int64_t k = 1; k <= steps; ++k) {
    throw_if_interrupted();
    const State before = state;
    const auto clock = std::chrono::steady_clock::now();
    const Report report = step(workspace, h, state);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    run.seconds += seconds;
    ++run.steps;
    run.ok += report.status == Status::ok;
    run.outer += report.outer_iterations;
    run.sweeps += report.sweeps;
    if (report.status > run.worst) run.worst = report.status, run.reason = report.reason;
    if (report.status == Status::diverged) break;
    run.checks.add(k, claim_of(scene, workspace, before, state, h, report), report.status, false);
    const auto contacts = workspace.contacts();
    run.most_contacts = std::max(run.most_contacts, std::ssize(contacts));
    std::int64_t rows = 0;
    for (const EffectCost& cost : workspace.costs()) rows += cost.rows;
    run.most_rows = std::max(run.most_rows, rows);
    const double gap = least_gap(contacts).value_or(0);
    run.overlap_at_end = larger(0, -gap);
    run.overlap.add(run.overlap_at_end);
    const double kinetic = kinetic_energy(scene, state), energy = energy_of(scene, state),
                 bilateral = bilateral_error(scene, state);
    run.kinetic_at_end = kinetic;
    run.excess.add(larger(0, energy - start));
    run.bilateral.add(bilateral);
    series.row(
        {std::string(name), h, state.time, kinetic, energy - start, pressing(contacts), larger(0, -gap),
         bilateral, std::int64_t{report.outer_iterations}, report.sweeps, report.residual(), seconds,
         std::string(status_names[static_cast<std::size_t>(report.status)]), std::string(report.reason)});
    if (drawn < pictured.size() && k == std::lround(pictured[drawn] * static_cast<double>(steps))) {
      pictures.add(state);
      ++drawn;
    }
    if (k % shown == 0) context.advance(fmt::format("{} {:.3g} s", name, state.time));
  }
  pictures.close();
  if (run.checks.refuted_steps() > 0) run.reason = run.checks.text();
  return run;
}

}  // namespace

void figure_1(Context& context) {
  const auto duration_of = [&](const PaperScene& scene) {
    return context.full() ? 10 : scene.quick_duration;
  };
  std::vector<double> steps{1.0 / 60};
  if (context.full()) steps.push_back(1.0 / 240);
  std::int64_t units = 0;
  for (const double h : steps)
    for (const PaperScene& scene : paper_scenes) units += std::lround(duration_of(scene) / h) / shown;
  context.begin(units);
  Table scenes =
      context.table("scenes", {"scene",        "step_s",        "duration_s",           "bodies",
                               "nodes",        "elements",      "most_contacts",        "most_rows",
                               "steps",        "steps_ok",      "outer_iterations",     "sweeps",
                               "frame_wall_s", "overlap_share", "overlap_share_at_end", "bilateral_error_m",
                               "excess_share", "rest_share",    "judged_steps",         "refuted_steps",
                               "status",       "reason"});
  Table series =
      context.table("series", {"scene", "step_s", "time_s", "kinetic_energy_j", "energy_change_j",
                               "pressing_contacts", "overlap_m", "bilateral_error_m", "outer_iterations",
                               "sweeps", "residual", "wall_s", "status", "reason"});
  Worst refuted, diverged, missed, overlap, overlap_at_end, excess, rest;
  for (const double h : steps)
    for (const PaperScene& scene : paper_scenes) {
      const std::string_view name = scene.name;
      const double duration = duration_of(scene);
      const SceneFile file = read_scene_file(scenes_folder() / fmt::format("{}.toml", name));
      const double size = body_size(file), mass = finite_mass(file.scene);
      const auto pictures = context.directory() / fmt::format("{}_{}", name, std::lround(1 / h));
      SceneRun run = run_scene(name, file, h, duration, series, pictures, context);
      std::int64_t elements = 0;
      for (const Effect& effect : file.scene.effects)
        if (const auto* solid = std::get_if<TetStrain>(&effect)) elements += std::ssize(solid->node);
      const double length =
          (file.scene.initial.x.rowwise().maxCoeff() - file.scene.initial.x.rowwise().minCoeff()).maxCoeff();
      const double scale = mass * gravity * length;
      std::int64_t moving = 0;
      for (const RigidBody& body : file.scene.bodies)
        moving += std::isfinite(file.scene.mass[static_cast<std::size_t>(body.node)]);
      const double rest_share = run.kinetic_at_end / (mass * gravity * size);
      const auto frames = static_cast<double>(run.steps);
      scenes.row({std::string(name),
                  h,
                  duration,
                  moving,
                  std::int64_t{file.scene.nodes()},
                  elements,
                  run.most_contacts,
                  run.most_rows,
                  run.steps,
                  run.ok,
                  run.outer,
                  run.sweeps,
                  run.seconds / frames,
                  run.overlap.value() / size,
                  run.overlap_at_end / size,
                  run.bilateral.value(),
                  run.excess.value() / scale,
                  rest_share,
                  run.checks.judged(),
                  run.checks.refuted_steps(),
                  std::string(status_names[static_cast<std::size_t>(run.worst)]),
                  run.reason});
      // Of a run that claims nothing there is nothing to refute.
      refuted.add(run.checks.judged() > 0 ? static_cast<double>(run.checks.refuted_steps()) : std::nan(""),
                  name);
      missed.add(static_cast<double>(run.steps - run.ok), name);
      diverged.add(run.worst == Status::diverged ? 1.0 : 0.0, name);
      overlap.add(run.overlap.value() / size, name);
      overlap_at_end.add(run.overlap_at_end / size, name);
      excess.add(run.excess.value() / scale, name);
      if (context.full()) rest.add(rest_share, name);
    }
  series.close();
  scenes.close();
  context.verdict(Basis::robustness, "figure_1.finite", "no step of the paper's three scenes diverges",
                  "scenes with one", diverged.value(), 0);
  context.verdict(Basis::code, "figure_1.claims", "no step of them that says ok is refuted",
                  "refuted steps of a scene", refuted.value(), 0);
  context.verdict(Basis::goal, "figure_1.solved", "every step of them meets its tolerance",
                  fmt::format("missed steps of a scene ({})", missed.owner()), missed.value(), 0);
  context.verdict(Basis::goal, "figure_1.overlap", "what strikes overlaps by a hundredth of a body at most",
                  fmt::format("deepest overlap over a body's least size ({})", overlap.owner()),
                  overlap.value(), 1e-2);
  context.verdict(Basis::goal, "figure_1.overlap_at_end", "what has come down overlaps by a thousandth",
                  fmt::format("overlap at the end over a body's least size ({})", overlap_at_end.owner()),
                  overlap_at_end.value(), 1e-3);
  context.verdict(Basis::robustness, "figure_1.energy",
                  "energy never rises above the start's: nothing does work on the scenes",
                  fmt::format("largest excess over m g L ({})", excess.owner()), excess.value(), 1e-6);
  if (context.full())
    context.verdict(Basis::goal, "figure_1.rest", "after 10 s the scenes are at rest",
                    fmt::format("kinetic energy over m g and a body's least size ({})", rest.owner()),
                    rest.value(), 1e-6);
}

}  // namespace pbdcheck
