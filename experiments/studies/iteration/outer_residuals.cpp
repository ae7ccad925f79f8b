#include "studies/iteration/outer_residuals.h"

#include <cmath>

#include "harness/cases.h"
#include "harness/judges.h"
#include "residual.h"
#include "scenes/standard.h"
#include "step/step.h"

namespace pbdcheck {
namespace {

using namespace pbd;

/// A tetrahedron of 1e5 Pa that is let go with its corners displaced by 0.2 of its edge in all.
Case stretched_tetrahedron(Strain strain) {
  TetMesh mesh;
  mesh.x = Points::Zero(3, 4);
  mesh.x.rightCols<3>().setIdentity();
  mesh.tets = {{0, 1, 2, 3}};
  Scene scene;
  add_solid(scene, mesh, 1000, {1e5, 0.3}, strain);
  for (Eigen::Index k = 0; k < scene.initial.x.size(); ++k)
    scene.initial.x.reshaped()[k] += 0.2 * std::sin(3 * static_cast<double>(k) + 1);
  return {strain == Strain::green ? "tetrahedron green" : "tetrahedron corotational", scene, 1.0 / 60};
}

std::vector<Case> residual_cases() {
  constexpr double lead = 1.0 / 100;  // s
  constexpr int lead_steps = 30;
  return {{"chain2", chain(2), 1.0 / 30, lead, lead_steps},
          swinging_chain(1, 1.0 / 240),
          stretched_tetrahedron(Strain::corotational),
          stretched_tetrahedron(Strain::green),
          {"cantilever", cantilever(8, {1e5, 0.3}, Strain::green), 1.0 / 60, lead, lead_steps}};
}

/// |v - v_free|_M, sqrt(J).
double correction_of(const Case& each, const State& start, const State& end) {
  Vec3 acceleration = Vec3::Zero();
  for (const Effect& effect : each.scene.effects)
    if (const auto* gravity = std::get_if<Gravity>(&effect)) acceleration += gravity->acceleration;
  double sum = 0;
  for (int node = 0; node < each.scene.nodes(); ++node)
    if (const double mass = each.scene.mass[static_cast<std::size_t>(node)]; std::isfinite(mass))
      sum += mass * (end.v.col(node) - start.v.col(node) - each.h * acceleration).squaredNorm();
  return std::sqrt(sum);
}

}  // namespace

void outer_residuals(Context& context) {
  Table table = context.table("residuals", {"scene", "step_s", "outer", "relaxation", "residual_share",
                                            "outer_iterations", "status", "reason"});
  for (const Case& each : residual_cases()) {
    const State start = start_of(each);
    for (const auto& [outer, relaxation] : {std::pair{"plain", "direct"},
                                            {"incremental", "direct"},
                                            {"incremental", "gauss_seidel"},
                                            {"frozen", "direct"}}) {
      Method method;
      method.outer = outer;
      method.relaxation = relaxation;
      method.tolerance = 1e-12;
      method.max_outer = 1000;
      Workspace workspace(each.scene, method);
      State end = start;
      const Report report = step(workspace, each.h, end);
      const double share =
          reference::residual_of(each.scene, start, each.h, end).residual / correction_of(each, start, end);
      table.row({each.name, each.h, std::string(outer), std::string(relaxation), share,
                 std::int64_t{report.outer_iterations},
                 std::string(status_names[static_cast<std::size_t>(report.status)]),
                 std::string(report.reason)});
    }
  }
  table.close();
  context.advance("residuals");
}

}  // namespace pbdcheck
