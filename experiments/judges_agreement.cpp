// Do the two judges agree on every scene the experiments use? They share the energies and differ in method.
#include "judge.h"

#include <cmath>

#include "experiments.h"
#include "files.h"
#include "judges.h"
#include "measure.h"
#include "mesh_file.h"
#include "scene_file.h"
#include "scenes/standard.h"

namespace pbdcheck {
namespace {

using namespace pbd;

struct Case {
  std::string name;
  Scene scene;
  double h;
  int warm_up;  // steps of h by primal_newton before the one that is judged
};

std::vector<Case> cases(bool full) {
  std::vector<Case> all;
  for (const double h : {0.2, 0.1, 0.05}) all.push_back({"pendulum", pendulum(0.3, 2), h, 0});
  for (const int links : {10, 20, 50, 100})
    all.push_back({"chain" + std::to_string(links), chain(links), 1.0 / 60, 10});
  for (const double ratio : {1.0, 10.0, 100.0, 1000.0})
    for (const double h : {1.0 / 30, 1.0 / 240})
      all.push_back({"chain20 tip x" + std::to_string(static_cast<int>(ratio)), chain(20, ratio), h, 10});
  for (const int cells : {10, 20})
    for (const double h : {1.0 / 60, 1.0 / 120, 1.0 / 240})
      all.push_back({"cloth" + std::to_string(cells), cloth(cells), h, 5});
  for (const double young : {1e5, 1e6})
    all.push_back({"cantilever8 green E=" + std::to_string(static_cast<int>(young)) + " nu=0.30",
                   cantilever(8, {young, 0.3}, Strain::green), 1.0 / 240, 5});
  for (const Strain strain : {Strain::green, Strain::corotational, Strain::linear})
    for (const double young : {1e5, 1e6, 1e7})
      for (const double poisson : {0.3, 0.45}) {
        const std::string text = std::string(strain_names[static_cast<std::size_t>(strain)]) +
                                 " E=" + std::to_string(static_cast<int>(young)) +
                                 " nu=" + std::to_string(poisson).substr(0, 4);
        all.push_back({"cantilever8 " + text, cantilever(8, {young, poisson}, strain), 1.0 / 60, 5});
        if (full || (young == 1e6 && strain == Strain::green))
          all.push_back({"cantilever12 " + text, cantilever(12, {young, poisson}, strain), 1.0 / 60, 5});
        if (full || (young == 1e6 && poisson == 0.3))
          all.push_back(
              {"beam.msh " + text,
               clamped_solid(read_tet_mesh(scenes_folder() / "meshes/beam.msh"), {young, poisson}, strain),
               1.0 / 60, 5});
      }
  return all;
}

}  // namespace

void judges(Context& context) {
  const auto all = cases(context.full());
  context.begin(std::ssize(all));
  Table table =
      context.table("agreement", {"scene", "nodes", "step_s", "reference_a", "reference_b", "difference",
                                  "residual_a", "residual_b", "wall_s_a", "wall_s_b", "status", "reason"});
  Worst worst;
  for (const auto& each : all) {
    const State state = led_by_truth(each.scene, each.h, each.warm_up);
    const auto a = reference::find_judge("primal_newton")(each.scene, state, each.h);
    const auto b = reference::find_judge("ipopt")(each.scene, state, each.h);
    const double difference = relative_error(b.x, a.x, state.x);
    const auto& failed = a.outcome == reference::Outcome::ok ? b : a;
    table.row({each.name, std::int64_t{each.scene.nodes()}, each.h, "primal_newton", "ipopt", difference,
               a.residual, b.residual, a.seconds, b.seconds,
               std::string(reference::outcome_names[static_cast<std::size_t>(failed.outcome)]),
               failed.reason});
    const bool both = a.outcome == reference::Outcome::ok && b.outcome == reference::Outcome::ok;
    worst.add(both ? difference : infinity);
    context.advance(each.name);
  }
  context.verdict("judges.agreement", "primal_newton and ipopt find the same step on every scene",
                  "largest difference relative to the step's largest displacement", worst.value(), 1e-9);
  table.close();
}

}  // namespace pbdcheck
