#include "studies/scenes/scene_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "harness/contact_sums.h"
#include "harness/files.h"
#include "harness/probes.h"
#include "harness/vtk.h"
#include "scenes/standard.h"

namespace pbdcheck {

using namespace pbd;

namespace {

constexpr std::int64_t shown = 6;       // steps a line of progress
constexpr double frames_a_second = 30;  // of simulated time, unless they were more than
constexpr std::int64_t most_frames = 200;

std::int64_t steps_of(const ScenePlan& plan) {
  return static_cast<std::int64_t>(std::lround(plan.duration / plan.h));
}

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

/// Frames of nodes, bodies and contacts, equally far apart but for the last step's.
class Pictures {
 public:
  Pictures(const std::filesystem::path& directory, const ScenePlan& plan)
      : scene_(plan.file.scene),
        h_(plan.h),
        nodes_(directory, "simulation", "frame", node_cells(plan.file.scene)),
        contacts_(directory, "contacts", "contacts", VtkCells{}),
        surfaces_(plan.file.scene, plan.file.bodies),
        steps_(steps_of(plan)),
        every_(
            std::max<std::int64_t>({1, std::lround(1 / (frames_a_second * plan.h)), steps_ / most_frames})) {
    if (!surfaces_.empty()) bodies_.emplace(directory, "bodies", "bodies", surfaces_.cells());
  }
  void add(std::int64_t step, const State& state, const std::vector<ContactForce>& contacts) {
    if (step % every_ != 0 && step != steps_) return;
    nodes_.add_frame(scene_, state);
    contacts_.add_contacts(state.time, h_, contacts);
    if (!bodies_) return;
    Points x, v;
    surfaces_.place(state, x, v);
    bodies_->add_frame(state.time, x, v);
  }
  void close() {
    nodes_.close();
    contacts_.close();
    if (bodies_) bodies_->close();
  }

 private:
  const Scene& scene_;
  double h_;  // s
  VtkSeries nodes_, contacts_;
  BodySurfaces surfaces_;
  std::int64_t steps_, every_;
  std::optional<VtkSeries> bodies_;
};

double bilateral_error(const Scene& scene, const State& state) {
  double most = 0;
  for (const Effect& effect : scene.effects)
    if (error_unit(effect)) most = larger(most, constraint_error(scene, effect, state));
  return most;
}

SceneRun run_scene(const ScenePlan& plan, Table* series, Context& context) {
  SceneRun run;
  const Scene& scene = plan.file.scene;
  Workspace workspace(scene, plan.file.method);
  State state = scene.initial;
  std::optional<Pictures> pictures;
  if (plan.pictured) {
    const auto directory = context.directory() / plan.name;
    require_writable(directory);
    pictures.emplace(directory, plan);
    pictures->add(0, state, {});
  }
  const double start = total_energy(scene, state);
  const std::int64_t steps = steps_of(plan);
  for (std::int64_t k = 1; k <= steps; ++k) {
    throw_if_interrupted();
    const State before = state;
    const auto clock = std::chrono::steady_clock::now();
    const Report report = step(workspace, plan.h, state);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    run.seconds += seconds;
    ++run.steps;
    run.ok += report.status == Status::ok;
    run.outer += report.outer_iterations;
    run.sweeps += report.sweeps;
    if (report.status > run.worst) run.worst = report.status, run.reason = report.reason;
    if (report.status == Status::diverged) break;
    run.checks.add(k, claim_of(scene, workspace, before, state, plan.h, report), report.status, false);
    const auto contacts = workspace.contacts();
    run.most_contacts = std::max(run.most_contacts, std::ssize(contacts));
    std::int64_t rows = 0;
    for (const EffectCost& cost : workspace.costs()) rows += cost.rows;
    run.most_rows = std::max(run.most_rows, rows);
    run.overlap_at_end = larger(0, 0 - least_gap(contacts).value_or(0));
    run.overlap.add(run.overlap_at_end);
    const double change = total_energy(scene, state) - start, bilateral = bilateral_error(scene, state);
    run.kinetic_at_end = kinetic_energy(scene, state);
    run.excess.add(larger(0, change));
    run.bilateral.add(bilateral);
    if (series != nullptr)
      series->row({std::string(plan.name), plan.h, state.time, run.kinetic_at_end, change, pressing(contacts),
                   run.overlap_at_end, bilateral, std::int64_t{report.outer_iterations}, report.sweeps,
                   report.residual(), seconds,
                   std::string(status_names[static_cast<std::size_t>(report.status)]),
                   std::string(report.reason)});
    if (pictures) pictures->add(k, state, contacts);
    if (k % shown == 0) context.advance(fmt::format("{} {:.3g} s", plan.name, state.time));
  }
  if (pictures) pictures->close();
  if (run.checks.refuted_steps() > 0) run.reason = run.checks.text();
  return run;
}

}  // namespace

std::string owned(std::string_view quantity, const Worst& worst) {
  return fmt::format("{} ({})", quantity, worst.owner());
}

ScenePlan plan_of(std::string_view name) {
  SceneFile file = read_scene_file(scenes_folder() / fmt::format("{}.toml", name));
  const double h = file.step_s, duration = static_cast<double>(file.steps) * h;
  return {name, std::move(file), h, duration, true};
}

void add_shorter(std::vector<ScenePlan>& plans, int parts) {
  const std::size_t count = plans.size();
  for (std::size_t i = 0; i < count; ++i) {
    plans.push_back(plans[i]);
    plans.back().h /= parts;
    plans.back().pictured = false;
  }
}

std::vector<std::string> series_columns() {
  return {"scene",
          "step_s",
          "time_s",
          "kinetic_energy_j",
          "energy_change_j",
          "pressing_contacts",
          "overlap_m",
          "bilateral_error_m",
          "outer_iterations",
          "sweeps",
          "residual",
          "wall_s",
          "status",
          "reason"};
}

SceneStudy::SceneStudy(Context& context, const std::vector<ScenePlan>& plans)
    : context_(context),
      table_(context.table("scenes", {"scene",
                                      "step_s",
                                      "duration_s",
                                      "bodies",
                                      "nodes",
                                      "elements",
                                      "most_contacts",
                                      "most_rows",
                                      "steps",
                                      "steps_ok",
                                      "outer_iterations",
                                      "sweeps",
                                      "frame_wall_s",
                                      "overlap_share",
                                      "overlap_share_at_end",
                                      "bilateral_error_m",
                                      "driven",
                                      "excess_share",
                                      "rest_share",
                                      "judged_steps",
                                      "refuted_steps",
                                      "status",
                                      "reason"})) {
  std::int64_t units = 0;
  for (const ScenePlan& plan : plans) units += steps_of(plan) / shown;
  context.begin(units);
}

void SceneStudy::run(const ScenePlan& plan, Table* series) {
  const Scene& scene = plan.file.scene;
  SceneRun run = run_scene(plan, series, context_);
  std::int64_t elements = 0, moving = 0;
  for (const Effect& effect : scene.effects)
    if (const auto* solid = std::get_if<TetStrain>(&effect)) elements += std::ssize(solid->node);
  for (const RigidBody& body : scene.bodies)
    moving += std::isfinite(scene.mass[static_cast<std::size_t>(body.node)]);
  const Points& x = scene.initial.x;
  const double size = body_size(plan.file), weight = finite_mass(scene) * gravity,
               length = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
  const double overlap = run.overlap.value() / size, overlap_at_end = run.overlap_at_end / size,
               excess = run.excess.value() / (weight * length), rest = run.kinetic_at_end / (weight * size);
  table_.row({std::string(plan.name),
              plan.h,
              plan.duration,
              moving,
              std::int64_t{scene.nodes()},
              elements,
              run.most_contacts,
              run.most_rows,
              run.steps,
              run.ok,
              run.outer,
              run.sweeps,
              run.seconds / static_cast<double>(run.steps),
              overlap,
              overlap_at_end,
              run.bilateral.value(),
              std::int64_t{plan.driven},
              excess,
              rest,
              run.checks.judged(),
              run.checks.refuted_steps(),
              std::string(status_names[static_cast<std::size_t>(run.worst)]),
              run.reason});
  // Of a run that claims nothing there is nothing to refute.
  refuted_.add(run.checks.judged() > 0 ? static_cast<double>(run.checks.refuted_steps()) : std::nan(""),
               plan.name);
  missed_.add(static_cast<double>(run.steps - run.ok), plan.name);
  diverged_.add(run.worst == Status::diverged ? 1.0 : 0.0, plan.name);
  overlap_.add(overlap, plan.name);
  overlap_at_end_.add(overlap_at_end, plan.name);
  bilateral_.add(run.bilateral.value(), plan.name);
  if (!plan.driven) excess_.add(excess, plan.name);
  rest_.add(rest, plan.name);
}

void SceneStudy::conclude(std::string_view experiment, std::string_view scenes) {
  table_.close();
  const auto verdict = [&](Basis basis, std::string_view id, const std::string& statement,
                           std::string_view quantity, const Worst& worst, double bound) {
    context_.verdict(basis, fmt::format("{}.{}", experiment, id), statement,
                     worst.value() == 0 ? std::string(quantity) : owned(quantity, worst), worst.value(),
                     bound);
  };
  verdict(Basis::robustness, "finite", fmt::format("no step of {} diverges", scenes), "scenes with one",
          diverged_, 0);
  verdict(Basis::code, "claims", fmt::format("no step of {} that says ok is refuted", scenes),
          "refuted steps of a scene", refuted_, 0);
  verdict(Basis::goal, "solved", fmt::format("every step of {} meets its tolerance", scenes),
          "missed steps of a scene", missed_, 0);
  verdict(Basis::goal, "overlap", "what strikes overlaps by a hundredth of a body at most",
          "deepest overlap over a body's least size", overlap_, 1e-2);
  verdict(Basis::goal, "overlap_at_end", "what has come down overlaps by a thousandth",
          "overlap at the end over a body's least size", overlap_at_end_, 1e-3);
  if (bilateral_.value() != 0)  // else no constraint gives no way, and nothing could miss
    verdict(Basis::goal, "bilateral", "constraints that give no way are met to a thousandth",
            "largest error, m, rad or 1", bilateral_, 1e-3);
}

}  // namespace pbdcheck
