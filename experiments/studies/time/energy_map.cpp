// Where does Newmark's rule blow up on stiff and hard links, and what is the smallest safe alpha? A mass
// circles on a link at its equilibrium; `circling_growth` says by how much a step multiplies a disturbance.
// The first step makes one, rounding another.
#include <cmath>

#include "circling.h"
#include "harness/integrator_rules.h"
#include "harness/measure.h"
#include "harness/probes.h"
#include "studies/time/energy.h"

namespace pbdcheck {
namespace {

using namespace pbd;

constexpr double rate = 5;                // rad/s
constexpr double circling_duration = 10;  // s
const std::vector<double> alphas{0.5, 0.5025, 0.505, 0.51, 0.515, 0.52, 0.53, 0.55, 0.6, 1};

/// 1 kg circling 1 m about the origin; the link's rest length makes that an equilibrium.
Scene circling(double compliance) {
  Scene scene;
  add_node(scene, Vec3::Zero(), infinity);
  add_node(scene, Vec3(1, 0, 0), 1, Vec3(0, rate, 0));
  scene.effects.emplace_back(
      Distance{.node = {{0, 1}}, .rest_length = {1 - rate * rate * compliance}, .compliance = {compliance}});
  return scene;
}

struct CircleCell {
  double compliance, h, alpha;
  double growth = 0;         // predicted, a step
  double energy_factor = 0;  // largest energy over the start's
  Rule rule{};
  Simulation run{};

  /// Multiplied over the whole time, rounding becomes as large as the motion.
  bool grows() const { return std::log(growth) * circling_duration / h > -std::log(0x1p-52); }
  bool decays() const { return growth <= 1 + 1e-9; }
  bool safe() const { return run.status == Status::ok; }
};

void follow_circle(CircleCell& cell) {
  const Scene scene = circling(cell.compliance);
  const double stiffness = cell.compliance > 0 ? cell.h / std::sqrt(cell.compliance) : infinity;
  cell.growth = reference::circling_growth(cell.alpha, rate * cell.h, stiffness);
  const double start = total_energy(scene, scene.initial);
  Worst factor;
  cell.run = simulate_steps(scene, cell.rule.method, cell.h,
                            static_cast<int>(std::lround(circling_duration / cell.h)),
                            [&](const State&, const State& now) {
                              factor.add(total_energy(scene, now) / start);
                              return factor.value() < 2 ? "" : "energy doubled";
                            });
  cell.energy_factor = factor.value();
}

std::vector<CircleCell> circle_cells(bool full) {
  std::vector<double> steps{1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240};
  if (full) steps = {1.0 / 30, 1.0 / 42, 1.0 / 60, 1.0 / 85, 1.0 / 120, 1.0 / 170, 1.0 / 240, 1.0 / 480};
  std::vector<CircleCell> cells;
  for (const Rule& rule : integrator_rules(alphas))
    if (rule.method.integrator == "newmark")
      for (const double compliance : {0.0, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4})
        for (const double h : steps)
          cells.push_back({.compliance = compliance, .h = h, .alpha = rule.alpha(), .rule = rule});
  return cells;
}

void write_circle_map(Context& context, const std::vector<CircleCell>& cells) {
  Table table =
      context.table("map", {"scene", "integrator", "alpha", "outer", "relaxation", "compliance_m_per_n",
                            "step_s", "predicted_growth", "energy_factor", "status", "reason"});
  Worst wrong;
  for (const CircleCell& cell : cells) {
    std::vector<Cell> row{"circling mass"};
    for (auto& each : method_cells(cell.rule)) row.push_back(std::move(each));
    row.insert(row.end(), {cell.compliance, cell.h, cell.growth, cell.energy_factor,
                           status_cell(cell.run.status), cell.run.reason});
    table.row(row);
    if (cell.grows()) wrong.add(cell.safe() ? 1 : 0);
    if (cell.decays()) wrong.add(cell.safe() ? 0 : 1);
  }
  table.close();
  context.verdict(Basis::theory, "energy.map",
                  "newmark blows up where a disturbance of the size of rounding is predicted to outgrow the "
                  "motion in 10 s, "
                  "and nowhere where disturbances are predicted to decay",
                  "1 if a cell contradicts", wrong.value(), 0);
}

/// The smallest alpha of the map from which on no larger one blows up, beside the predicted one.
void write_circle_frontier(Context& context, const std::vector<CircleCell>& cells) {
  Table table =
      context.table("frontier", {"scene", "compliance_m_per_n", "step_s", "predicted_alpha", "safe_alpha"});
  for (const CircleCell& cell : cells) {
    if (cell.alpha != alphas.front()) continue;
    double safe = std::nan("");
    for (const CircleCell& other : cells)
      if (other.compliance == cell.compliance && other.h == cell.h) {
        if (!other.safe()) safe = std::nan("");
        if (other.safe() && std::isnan(safe)) safe = other.alpha;
      }
    const double stiffness = cell.compliance > 0 ? cell.h / std::sqrt(cell.compliance) : infinity;
    table.row({"circling mass", cell.compliance, cell.h,
               reference::smallest_stable_alpha(rate * cell.h, stiffness), safe});
  }
  table.close();
}

}  // namespace

void energy_map(Context& context) {
  auto cells = circle_cells(context.full());
  context.parallel(std::ssize(cells),
                   [&](std::int64_t index) { follow_circle(cells[static_cast<std::size_t>(index)]); });
  write_circle_map(context, cells);
  write_circle_frontier(context, cells);
  context.advance("map");
}

}  // namespace pbdcheck
